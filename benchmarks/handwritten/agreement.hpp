// Compares the results of two simulators of one problem.
#pragma once

#include "measure/random_course.hpp"
#include "solvers/batches/batch.hpp"

#include <rddl/simulator.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

namespace handwritten {

// Relative for what is far from zero; infinite where a bool, an int or the end of an episode is not
// the same.
class Differences {
  public:
    void real(double a, double b) {
        greatest = std::max(greatest, std::fabs(a - b) / (1 + std::fabs(a)));
    }
    void exact(const void* a, const void* b, std::size_t bytes) {
        if (bytes > 0 && std::memcmp(a, b, bytes) != 0) greatest = INFINITY;
    }

    double greatest = 0;
};

inline void compare_states(const rddl_problem& problem, const std::vector<std::byte>& a,
                           const std::vector<std::byte>& b, Differences& differences) {
    const auto record_size = static_cast<std::size_t>(problem.state_size);
    for (std::size_t record = 0; record < a.size(); record += record_size) {
        for (const rddl_fluent& fluent :
             std::span(problem.fluents, static_cast<std::size_t>(problem.fluent_count))) {
            if (fluent.role != RDDL_STATE) continue;
            const std::size_t at = record + static_cast<std::size_t>(fluent.offset);
            const std::size_t bytes = static_cast<std::size_t>(fluent.count) *
                                      (fluent.scalar == RDDL_BOOL ? 1 : sizeof(double));
            if (fluent.scalar != RDDL_REAL) differences.exact(&a[at], &b[at], bytes);
            for (std::size_t i = 0; fluent.scalar == RDDL_REAL && i < bytes; i += sizeof(double)) {
                double x, y;
                std::memcpy(&x, &a[at + i], sizeof x);
                std::memcpy(&y, &b[at + i], sizeof y);
                differences.real(x, y);
            }
        }
    }
}

// The greatest difference of all states, rewards and ends of episodes, along the course.
inline double greatest_difference(const rddl_simulator& a, const rddl_simulator& b,
                                  const rddlc::workbench::RandomCourse& course) {
    struct Side {
        Side(const rddl_simulator& its_simulator, const rddlc::workbench::RandomCourse& course)
            : simulator(its_simulator),
              batch(rddlc::solvers::create_batch(
                  its_simulator, rddlc::workbench::course_options(course.environments))),
              rewards(static_cast<std::size_t>(course.environments)),
              terminated(rewards.size()),
              truncated(rewards.size()),
              states(rewards.size() * static_cast<std::size_t>(its_simulator.problem->state_size)) {
        }

        void step(const std::byte* actions) {
            rddl_transition out{};
            out.rewards = rewards.data();
            out.terminated = terminated.data();
            out.truncated = truncated.data();
            simulator.step(batch.get(), actions, &out);
            simulator.get_state(batch.get(), 0, static_cast<std::int64_t>(rewards.size()),
                                states.data());
        }

        const rddl_simulator& simulator;
        rddlc::solvers::BatchHandle batch;
        std::vector<double> rewards;
        std::vector<std::uint8_t> terminated, truncated;
        std::vector<std::byte> states;
    };

    Side left(a, course), right(b, course);
    Differences differences;
    for (std::int64_t step = 0; step < course.steps; ++step) {
        left.step(course.of_step(step));
        right.step(course.of_step(step));
        for (std::size_t i = 0; i < left.rewards.size(); ++i)
            differences.real(left.rewards[i], right.rewards[i]);
        differences.exact(left.terminated.data(), right.terminated.data(), left.terminated.size());
        differences.exact(left.truncated.data(), right.truncated.data(), left.truncated.size());
        compare_states(*a.problem, left.states, right.states, differences);
    }
    return differences.greatest;
}

}  // namespace handwritten
