#include "measure/measurement.hpp"

#include "solvers/batches/batch.hpp"
#include "terminal/interrupt.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <chrono>
#include <ctime>
#include <vector>

namespace rddlc::workbench {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

// The processor time that the threads of this process have used so far. Other programs do not
// count, so that it shows on a busy machine how fast one thread is on an idle one.
double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

// The arrays that a step fills.
struct Outcomes {
    explicit Outcomes(std::int64_t environments)
        : rewards(static_cast<std::size_t>(environments)),
          terminated(rewards.size()),
          truncated(rewards.size()) {
        transition.rewards = rewards.data();
        transition.terminated = terminated.data();
        transition.truncated = truncated.data();
    }

    std::vector<double> rewards;
    std::vector<std::uint8_t> terminated, truncated;
    rddl_transition transition{};
};

std::optional<std::size_t> allocated_bytes() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
#else
    return std::nullopt;
#endif
}

}  // namespace

Measurement measure(const rddl_simulator& simulator, const RandomCourse& course,
                    const Stepping& stepping, double seconds) {
    rddl_batch_options options = course_options(course.environments);
    options.lane_count = stepping.lanes;
    options.thread_count = stepping.threads;
    Outcomes outcomes(course.environments);
    Measurement result{course.environments, stepping.lanes, stepping.threads, 0, 0, 0};
    do {
        const solvers::BatchHandle batch = solvers::create_batch(simulator, options);
        simulator.step(batch.get(), course.of_step(0), &outcomes.transition);
        // One clock within the other: a thread has no more processor time than there is time.
        const auto begin = Clock::now();
        const double processor_begin = processor_seconds();
        for (std::int64_t step = 1; step < course.steps; ++step)
            simulator.step(batch.get(), course.of_step(step), &outcomes.transition);
        result.processor_seconds += processor_seconds() - processor_begin;
        result.seconds += seconds_since(begin);
        result.steps += (course.steps - 1) * course.environments;
    } while (result.seconds < seconds && !is_interrupted());
    return result;
}

std::optional<double> memory_per_environment(const rddl_simulator& simulator,
                                             std::int64_t environments) {
    const auto bytes_of = [&](std::int64_t count) -> std::optional<double> {
        const auto before = allocated_bytes();
        const solvers::BatchHandle batch = solvers::create_batch(simulator, course_options(count));
        const auto after = allocated_bytes();
        if (!before || !after) return std::nullopt;
        return static_cast<double>(*after) - static_cast<double>(*before);
    };
    const auto all = bytes_of(environments);
    if (!all) return std::nullopt;
    return *all / static_cast<double>(environments);
}

}  // namespace rddlc::workbench
