#include "measure/random_course.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/policies/random_actions.hpp"
#include "terminal/interrupt.hpp"

#include <algorithm>
#include <chrono>

namespace rddlc::workbench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t least_steps = 2;
constexpr std::int64_t most_bytes = 64 << 20;

// A processor's branch predictor memorises a short course that is stepped again and again. This
// many steps of all environments are too long for it: twice as many take as long
// (docs/benchmarks.md).
constexpr std::int64_t steps_of_all_environments = 1 << 18;
constexpr std::int64_t least_steps_of_batches = 2048;

std::int64_t most_steps(std::int64_t environments) {
    return std::max(least_steps_of_batches, steps_of_all_environments / environments);
}

void count_ends(const std::vector<std::uint8_t>& causes, RandomCourse& course) {
    for (const std::uint8_t cause : causes) {
        course.episodes += cause != RDDL_RUNNING;
        course.faulted += (cause & RDDL_FAULTED) != 0;
    }
}

}  // namespace

rddl_batch_options course_options(std::int64_t environments) {
    rddl_batch_options options{};
    options.environment_count = environments;
    options.thread_count = 1;
    options.autoreset = RDDL_AUTORESET_SAME_STEP;
    return options;
}

RandomCourse draw_course(const rddl_simulator& simulator, std::int64_t environments,
                         double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    const std::int64_t step_bytes = environments * simulator.problem->action_size;
    const std::int64_t limit = std::clamp(most_bytes / std::max<std::int64_t>(step_bytes, 1),
                                          least_steps, most_steps(environments));

    // One thread: several that have to share a processor wait for each other, and the course is
    // short.
    const solvers::BatchHandle batch =
        solvers::create_batch(simulator, course_options(environments));
    solvers::RandomPolicy policy(*simulator.problem, 0);
    solvers::RandomActions random(simulator, policy, environments);
    std::vector<std::uint8_t> causes(static_cast<std::size_t>(environments));
    rddl_transition ends{};
    ends.causes = causes.data();

    RandomCourse course;
    course.environments = environments;
    while (course.steps < limit &&
           (course.steps < least_steps || (Clock::now() < end && !is_interrupted()))) {
        const std::size_t used = course.actions.size();
        course.actions.resize(used + static_cast<std::size_t>(step_bytes));
        random.draw(
            batch.get(), course.actions.data() + used, [](std::size_t) { return true; },
            [](std::size_t i) { return static_cast<std::int64_t>(i); },
            [&](std::size_t) { return course.steps; });
        simulator.step(batch.get(), course.actions.data() + used, &ends);
        count_ends(causes, course);
        ++course.steps;
    }
    return course;
}

}  // namespace rddlc::workbench
