// Steps of random actions, of which values are compared with the interpreter's and derivatives with
// differences.
#pragma once

#include "autodiff/evaluation.hpp"
#include "autodiff/number_layout.hpp"
#include "ir/interpreter.hpp"

#include <rddl/random/random.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace rddlc::autodiff {

struct StepCheck {
    std::int64_t steps = 0;
    std::int64_t values = 0, different_values = 0;
    std::int64_t derivatives = 0, wrong_derivatives = 0;
    std::int64_t not_smooth = 0;  // differences of two widths disagree
    std::size_t instructions = 0;
    std::string first_complaint;
};

class StepChecker {
  public:
    explicit StepChecker(const ir::Program& program)
        : interpreter_(program),
          straight_(unroll(program)),
          evaluation_(straight_, {}),
          states_(program, ir::Storage::State),
          actions_(program, ir::Storage::Action),
          state_(interpreter_.state_size()),
          next_(interpreter_.state_size()),
          action_(interpreter_.action_size()),
          scratch_(interpreter_.scratch_size()),
          observation_(interpreter_.observation_size()) {
        check_.instructions = straight_.instructions.size();
    }

    StepCheck run(std::int64_t steps) {
        std::mt19937_64 random(1);
        begin_episode(0);
        for (std::int64_t step = 0; step < steps; ++step) {
            choose_action(random);
            if (!make_step(random)) begin_episode(step + 1);
        }
        return check_;
    }

  private:
    void begin_episode(std::int64_t number) {
        const auto seed = static_cast<std::uint64_t>(number);
        key_ = rddl::stream_key(7, 0, seed);
        Context context{.key = key_, .step = 0, .fault = {}};
        interpreter_.reset(state_.data(), context);
        steps_made_ = 0;
    }

    // The default, with some values changed.
    void choose_action(std::mt19937_64& random) {
        interpreter_.default_action(action_.data());
        std::normal_distribution<double> normal;
        for (std::size_t i = 0; i < actions_.count(); ++i) {
            const double before = actions_.read(action_.data(), i);
            const bool is_real = actions_.scalar(i) == ir::Scalar::Real;
            if (is_real)
                actions_.write(before + normal(random), action_.data(), i);
            else if (actions_.scalar(i) == ir::Scalar::Bool && random() % 4 == 0)
                actions_.write(1 - before, action_.data(), i);
        }
    }

    void set_inputs() {
        for (std::size_t i = 0; i < states_.count(); ++i)
            evaluation_.state(i).fill(states_.read(state_.data(), i));
        for (std::size_t i = 0; i < actions_.count(); ++i)
            evaluation_.action(i).fill(actions_.read(action_.data(), i));
    }

    void forward() {
        const std::vector<rddl::StreamKey> keys(lanes, key_);
        evaluation_.forward(keys, steps_made_);
    }

    // False where the episode is over.
    bool make_step(std::mt19937_64& random) {
        Context context{.key = key_, .step = steps_made_ + 1, .fault = {}};
        const double reward = interpreter_.step(state_.data(), action_.data(), scratch_.data(),
                                                next_.data(), observation_.data(), context);
        set_inputs();
        forward();
        ++check_.steps;
        if (evaluation_.has_failed(0) != context.faulted())
            complain(check_.different_values, "one of the engines faults");
        if (context.faulted() || evaluation_.has_failed(0)) return false;
        for (std::size_t i = 0; i < states_.count(); ++i)
            compare("next " + std::to_string(i), states_.read(next_.data(), i),
                    evaluation_.next(i)[0]);
        compare("reward", reward, evaluation_.reward()[0]);
        Context in_next{.key = key_, .step = steps_made_ + 1, .fault = {}};
        const bool over = interpreter_.terminal(next_.data(), in_next) ||
                          interpreter_.violates_invariant(next_.data(), in_next);
        compare("end", over ? 1 : 0, evaluation_.is_over(0) ? 1 : 0);
        if (leave_thresholds(random)) compare_derivatives(random);
        state_.swap(next_);
        ++steps_made_;
        return !over;
    }

    void compare(const std::string& what, double interpreted, double value) {
        ++check_.values;
        if (std::memcmp(&interpreted, &value, sizeof value) == 0) return;
        if (std::isnan(interpreted) && std::isnan(value)) return;
        complain(check_.different_values,
                 what + ": " + std::to_string(value) + ", not " + std::to_string(interpreted));
    }

    void complain(std::int64_t& count, const std::string& what) {
        ++count;
        if (check_.first_complaint.empty())
            check_.first_complaint = "step " + std::to_string(check_.steps) + ": " + what;
    }

    // Many problems begin at 0, where signs and conditions change. A derivative holds next to these
    // only. False where the state that was chosen faults.
    bool leave_thresholds(std::mt19937_64& random) {
        std::normal_distribution<double> normal;
        for (std::size_t i = 0; i < states_.count(); ++i) {
            Lane& lane = evaluation_.state(i);
            if (states_.scalar(i) == ir::Scalar::Real)
                lane.fill(lane[0] + 1e-3 * (1 + std::abs(lane[0])) * normal(random));
        }
        forward();
        return !evaluation_.has_failed(0);
    }

    // The sum of all results with random weights, and how exact it can be.
    double weighted(const std::vector<double>& weights, std::size_t lane, double* magnitude) const {
        double sum = 0;
        const auto add = [&](double weight, double value) {
            if (!std::isfinite(value)) return;
            sum += weight * value;
            if (magnitude) *magnitude += std::abs(weight * value);
        };
        for (std::size_t i = 0; i < states_.count(); ++i)
            add(weights[i], evaluation_.next(i)[lane]);
        add(weights.back(), evaluation_.reward()[lane]);
        return sum;
    }

    void compare_derivatives(std::mt19937_64& random) {
        std::vector<double> weights(states_.count() + 1);
        for (double& weight : weights) weight = static_cast<double>(random() % 1000) / 500 - 1;
        for (std::size_t i = 0; i < states_.count(); ++i)
            weights[i] /= 1 + std::abs(evaluation_.next(i)[0]);
        weights.back() /= 1 + std::abs(evaluation_.reward()[0]);
        evaluation_.clear_adjoints();
        const auto lane_of = [](double weight) {
            Lane lane{};
            lane[0] = weight;
            return lane;
        };
        for (std::size_t i = 0; i < states_.count(); ++i)
            evaluation_.add_next_adjoint(i, lane_of(weights[i]));
        evaluation_.add_reward_adjoint(lane_of(weights.back()));
        evaluation_.backward();
        std::vector<double> derivatives;
        std::vector<std::size_t> reals;  // inputs
        const std::size_t inputs = states_.count() + actions_.count();
        for (std::size_t i = 0; i < inputs; ++i) {
            const bool is_state = i < states_.count();
            const std::size_t number = is_state ? i : i - states_.count();
            if ((is_state ? states_ : actions_).scalar(number) != ir::Scalar::Real) continue;
            reals.push_back(i);
            derivatives.push_back((is_state ? evaluation_.state_adjoint(number)
                                            : evaluation_.action_adjoint(number))[0]);
        }
        std::vector<std::size_t> order(reals.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::shuffle(order, random);
        order.resize(std::min<std::size_t>(order.size(), most_inputs));
        for (const std::size_t k : order) compare_derivative(reals[k], derivatives[k], weights);
    }

    void compare_derivative(std::size_t input, double derivative,
                            const std::vector<double>& weights) {
        Lane& lane = input < states_.count() ? evaluation_.state(input)
                                             : evaluation_.action(input - states_.count());
        const double x = lane[0];
        const double width = 1e-5 * std::max(1.0, std::abs(x));
        lane = {x, x + width, x - width, x + width / 4, x - width / 4, x, x, x};
        forward();
        double magnitude = 0;
        const double here = weighted(weights, 0, &magnitude);
        const double above = weighted(weights, 1, nullptr), below = weighted(weights, 2, nullptr);
        const double wide = (above - below) / (2 * width);
        const double narrow =
            (weighted(weights, 3, nullptr) - weighted(weights, 4, nullptr)) / (width / 2);
        lane.fill(x);
        ++check_.derivatives;
        const double noise = 1e-14 * magnitude / width;
        const double tolerance = 1e-5 * (1 + std::abs(narrow)) + 8 * noise;
        const double one_sided = (above - here) / width - (here - below) / width;
        const bool is_smooth = std::abs(wide - narrow) <= tolerance &&
                               std::abs(one_sided) <= 1e-3 * (1 + std::abs(narrow)) + 8 * noise;
        if (!is_smooth) {
            ++check_.not_smooth;
            return;
        }
        if (std::abs(derivative - narrow) <= 10 * tolerance) return;
        complain(check_.wrong_derivatives, "by input " + std::to_string(input) + ": " +
                                               std::to_string(derivative) + ", differences " +
                                               std::to_string(narrow));
    }

    static constexpr std::size_t most_inputs = 40;  // of a step

    ir::Interpreter interpreter_;
    StraightLine straight_;
    Evaluation evaluation_;
    NumberLayout states_, actions_;
    std::vector<std::byte> state_, next_, action_, scratch_, observation_;
    rddl::StreamKey key_;
    std::uint32_t steps_made_ = 0;
    StepCheck check_;
};

}  // namespace rddlc::autodiff
