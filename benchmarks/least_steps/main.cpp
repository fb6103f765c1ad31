// Checks the kernel of a step against the emitted simulator of the same instance, and measures
// both.
//
//     least_steps SIMULATOR.so KERNEL.so [SECONDS]
//
// prints a line of JSON: the nanoseconds of a step for one environment, of the kernel and of the
// simulator in a batch of its best size, and how many values were compared. It fails if one is not
// the same. KERNEL.so is made of kernel.cpp.
#include "benchmarks/shared_function.hpp"
#include "interface.hpp"
#include "measure/measurement.hpp"
#include "solvers/batches/batch.hpp"

#include <rddl/random/random.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using benchmarks::load;
using least_steps::Kernel;
using rddlc::workbench::RandomCourse;

// A batch that plays a course, and for each environment what a kernel has to be told.
class Play {
  public:
    Play(const rddl_simulator& simulator, const RandomCourse& course)
        : simulator_(simulator),
          course_(course),
          options_(rddlc::workbench::course_options(course.environments)),
          batch_(rddlc::solvers::create_batch(simulator, options_)),
          count_(static_cast<std::size_t>(course.environments)),
          state_size_(static_cast<std::size_t>(simulator.problem->state_size)),
          states_(count_ * state_size_),
          next_states_(states_.size()),
          rewards_(count_),
          terminated_(count_),
          truncated_(count_),
          episodes_(count_),
          steps_(count_),
          keys_low_(count_),
          keys_high_(count_) {
        read(states_);
        for (std::size_t i = 0; i < count_; ++i) begin_episode(i);
    }

    // The environments before step k of the course.
    least_steps::Environments environments(std::int64_t k) const {
        const auto action_size = static_cast<std::size_t>(simulator_.problem->action_size);
        return {count_,           state_size_,        action_size,
                states_.data(),   course_.of_step(k), steps_.data(),
                keys_low_.data(), keys_high_.data()};
    }

    // Makes step k, and compares it with that of the kernel. Returns how many numbers it compared.
    std::int64_t compare_step(std::int64_t k, const Kernel& kernel) {
        std::vector<std::byte> expected(states_.size());
        std::vector<double> expected_rewards(count_);
        kernel.step(environments(k), expected.data(), expected_rewards.data());
        rddl_transition out{};
        out.rewards = rewards_.data();
        out.terminated = terminated_.data();
        out.truncated = truncated_.data();
        simulator_.step(batch_.get(), course_.of_step(k), &out);
        read(next_states_);
        std::int64_t compared = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            require(expected_rewards[i] == rewards_[i], "a reward");
            ++compared;
            if (terminated_[i] || truncated_[i])
                begin_episode(i, 1);
            else
                compared +=
                    compare_states(&next_states_[i * state_size_], &expected[i * state_size_]);
        }
        states_.swap(next_states_);
        for (std::uint64_t& step : steps_) ++step;
        return compared;
    }

  private:
    void read(std::vector<std::byte>& states) const {
        simulator_.get_state(batch_.get(), 0, course_.environments, states.data());
    }
    // The next step will be the first one.
    void begin_episode(std::size_t i, std::uint64_t after = 0) {
        episodes_[i] += after;
        steps_[i] = 1 - after;
        const auto key = rddl::stream_key(options_.seed, i, episodes_[i]);
        keys_low_[i] = key.low;
        keys_high_[i] = key.high;
    }
    std::int64_t compare_states(const std::byte* ours, const std::byte* theirs) const {
        std::int64_t compared = 0;
        const rddl_problem& problem = *simulator_.problem;
        for (const rddl_fluent& fluent :
             std::span(problem.fluents, static_cast<std::size_t>(problem.fluent_count))) {
            if (fluent.role != RDDL_STATE) continue;
            for (std::int64_t k = 0; k < fluent.count; ++k, ++compared) {
                const std::size_t size = fluent.scalar == RDDL_BOOL ? 1 : sizeof(double);
                const std::size_t at =
                    static_cast<std::size_t>(fluent.offset) + static_cast<std::size_t>(k) * size;
                require(are_same(fluent.scalar == RDDL_REAL, ours + at, theirs + at, size),
                        fluent.name);
            }
        }
        return compared;
    }
    // Zeros with another sign are the same.
    static bool are_same(bool are_reals, const std::byte* a, const std::byte* b, std::size_t size) {
        if (!are_reals) return std::memcmp(a, b, size) == 0;
        double x, y;
        std::memcpy(&x, a, sizeof x);
        std::memcpy(&y, b, sizeof y);
        return x == y;
    }
    static void require(bool is_same, const std::string& what) {
        if (!is_same) throw std::runtime_error("the kernel has another value of " + what);
    }

    const rddl_simulator& simulator_;
    const RandomCourse& course_;
    rddl_batch_options options_;
    rddlc::solvers::BatchHandle batch_;
    std::size_t count_, state_size_;
    std::vector<std::byte> states_, next_states_;
    std::vector<double> rewards_;
    std::vector<std::uint8_t> terminated_, truncated_;
    std::vector<std::uint64_t> episodes_, steps_, keys_low_, keys_high_;
};

double nanoseconds_of(const rddl_simulator& simulator, double seconds) {
    double best = 1e9;
    for (const std::int64_t environments : {256, 1024, 4096}) {
        const RandomCourse course = rddlc::workbench::draw_course(simulator, environments, 1);
        for (int round = 0; round < 5; ++round) {
            const auto m = rddlc::workbench::measure(simulator, course, {0, 1}, seconds / 10);
            best = std::min(best, 1e9 * m.processor_seconds / static_cast<double>(m.steps));
        }
    }
    return best;
}

}  // namespace

int main(int count, char** arguments) try {
    if (count < 3) throw std::runtime_error("usage: least_steps SIMULATOR.so KERNEL.so [SECONDS]");
    const double seconds = count > 3 ? std::atof(arguments[3]) : 0.5;
    const rddl_simulator& simulator =
        *load<const rddl_simulator*()>(arguments[1], "rddl_simulator_entry")();
    const Kernel kernel = load<Kernel()>(arguments[2], "least_step")();

    constexpr std::int64_t environments = 128, steps = 300;
    const RandomCourse course = rddlc::workbench::draw_course(simulator, environments, 1);
    Play play(simulator, course);
    std::int64_t compared = 0;
    const std::int64_t last = std::min(course.steps, steps) - 1;
    for (std::int64_t k = 0; k < last; ++k) compared += play.compare_step(k, kernel);

    const nlohmann::json figures{{"kernel", kernel.nanoseconds(play.environments(last), seconds)},
                                 {"step", nanoseconds_of(simulator, seconds)},
                                 {"compared", compared}};
    std::cout << figures.dump() << "\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << "least_steps: " << error.what() << "\n";
    return 1;
}
