#include "native/derivatives.hpp"

#include "engines/load_simulator.hpp"
#include "solvers/gradients/step_derivatives.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

using workbench::LoadedProblem;

constexpr std::size_t lanes = solvers::derivative_lanes;

using Numbers = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
using Results = nb::ndarray<double, nb::c_contig, nb::device::cpu>;
using Whole = nb::ndarray<const std::uint64_t, nb::c_contig, nb::device::cpu>;

// Rows of numbers, one an environment. The caller has seen to their sizes.
class Derivatives {
  public:
    Derivatives(const LoadedProblem& problem, const std::string& relax, double sharpness) {
        using Mode = solvers::Relaxation::Mode;
        solvers::Relaxation relaxation{.sharpness = sharpness};
        if (relax == "straight") relaxation.mode = Mode::StraightThrough;
        if (relax == "soft") relaxation.mode = Mode::Soft;
        step_ = problem.derivatives(relaxation);
        state_.resize(step_->state_count());
        next_.resize(state_.size());
        state_adjoint_.resize(state_.size());
        action_.resize(step_->action_count());
        action_adjoint_.resize(action_.size());
    }

    // Writes the next states and the rewards; both are nan where a step faults.
    void step(const Numbers& states, const Numbers& actions, const Whole& seeds,
              std::int64_t steps_made, const Results& next, const Results& rewards) {
        const nb::gil_scoped_release released;
        const std::scoped_lock lock(mutex_);
        for (std::size_t first = 0; first < rewards.size(); first += lanes) {
            const std::size_t count = std::min(lanes, rewards.size() - first);
            play(states.data(), actions.data(), seeds.data(), steps_made, first, count);
            step_->read_next(next_);
            const solvers::LaneNumbers reward = step_->reward();
            for (std::size_t k = 0; k < count; ++k) {
                const bool failed = step_->has_failed(k);
                for (std::size_t i = 0; i < next_.size(); ++i)
                    next.data()[(first + k) * next_.size() + i] = failed ? nan : next_[i][k];
                rewards.data()[first + k] = failed ? nan : reward[k];
            }
        }
    }

    // Derivatives of the sum of all results, each times its adjoint.
    void pull_back(const Numbers& states, const Numbers& actions, const Whole& seeds,
                   std::int64_t steps_made, const Numbers& next_adjoints,
                   const Numbers& reward_adjoints, const Results& state_adjoints,
                   const Results& action_adjoints) {
        const nb::gil_scoped_release released;
        const std::scoped_lock lock(mutex_);
        for (std::size_t first = 0; first < reward_adjoints.size(); first += lanes) {
            const std::size_t count = std::min(lanes, reward_adjoints.size() - first);
            play(states.data(), actions.data(), seeds.data(), steps_made, first, count);
            solvers::LaneNumbers reward_adjoint{};
            std::ranges::fill(next_, solvers::LaneNumbers{});
            for (std::size_t k = 0; k < count; ++k) {
                if (step_->has_failed(k)) continue;
                for (std::size_t i = 0; i < next_.size(); ++i)
                    next_[i][k] = next_adjoints.data()[(first + k) * next_.size() + i];
                reward_adjoint[k] = reward_adjoints.data()[first + k];
            }
            step_->pull_back(next_, reward_adjoint, state_adjoint_, action_adjoint_);
            for (std::size_t k = 0; k < count; ++k) {
                const bool failed = step_->has_failed(k);
                write(state_adjoint_, k, failed, state_adjoints.data(), first + k);
                write(action_adjoint_, k, failed, action_adjoints.data(), first + k);
            }
        }
    }

    std::size_t state_count() const { return state_.size(); }
    std::size_t action_count() const { return action_.size(); }

  private:
    static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    // Lanes from `count` on repeat the last one.
    void play(const double* states, const double* actions, const std::uint64_t* seeds,
              std::int64_t steps_made, std::size_t first, std::size_t count) {
        std::array<std::uint64_t, lanes> lane_seeds;
        for (std::size_t k = 0; k < lanes; ++k) {
            const std::size_t row = first + std::min(k, count - 1);
            lane_seeds[k] = seeds[row];
            for (std::size_t i = 0; i < state_.size(); ++i)
                state_[i][k] = states[row * state_.size() + i];
            for (std::size_t i = 0; i < action_.size(); ++i)
                action_[i][k] = actions[row * action_.size() + i];
        }
        step_->set_seeds(lane_seeds);
        step_->step(steps_made, state_, action_);
    }

    static void write(const std::vector<solvers::LaneNumbers>& from, std::size_t lane, bool failed,
                      double* to, std::size_t row) {
        for (std::size_t i = 0; i < from.size(); ++i)
            to[row * from.size() + i] = failed ? nan : from[i][lane];
    }

    std::mutex mutex_;
    std::unique_ptr<solvers::StepDerivatives> step_;
    std::vector<solvers::LaneNumbers> state_, action_, next_, state_adjoint_, action_adjoint_;
};

}  // namespace

void add_derivatives(nb::module_& module) {
    nb::class_<Derivatives>(module, "Derivatives")
        .def(nb::init<const LoadedProblem&, const std::string&, double>(), nb::arg("simulator"),
             nb::arg("relax"), nb::arg("sharpness"))
        .def_prop_ro("state_count", &Derivatives::state_count)
        .def_prop_ro("action_count", &Derivatives::action_count)
        .def("step", &Derivatives::step)
        .def("pull_back", &Derivatives::pull_back);
}

}  // namespace rddlc::python
