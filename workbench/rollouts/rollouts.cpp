#include "rollouts/rollouts.hpp"

#include "formats/trace.hpp"
#include "learning/learned_policy.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace rddlc::workbench {

namespace {

// The trace of one batch of episodes.
class TraceRecorder : public solvers::Recorder {
  public:
    TraceRecorder(const rddl_simulator& simulator, const TraceFormat& format,
                  std::int64_t environments, const TraceSink& sink, bool at_once)
        : lines_(simulator, format, environments), sink_(sink), at_once_(at_once) {}

    void before_step(const rddl_batch& batch) override { lines_.before_step(batch); }
    void after_step(const rddl_batch& batch) override { lines_.after_step(batch); }
    void add(std::size_t i, std::int64_t episode, std::int64_t step, const std::byte* action,
             double reward, std::uint8_t causes) override {
        lines_.add(i, episode, step, action, reward, causes);
        if (at_once_) sink_(lines_.take());
    }
    void finish() override { sink_(lines_.take()); }

  private:
    TraceLines lines_;
    const TraceSink& sink_;
    bool at_once_;
};

solvers::Policy policy_of(const rddl_simulator& simulator, const RolloutOptions& options) {
    switch (options.policy) {
        case Policy::Random:
            return solvers::random_policy(simulator, options.seed);
        case Policy::Noop:
            return solvers::noop_policy(simulator);
        case Policy::Learned:
            return learned_policy(simulator, options.learned, false, options.seed,
                                  options.memory_limit);
        case Policy::Planner:
            return policy_named(simulator, options.planner, false, options.seed,
                                options.memory_limit, options.planning);
        case Policy::Rddl:
            break;
    }
    return solvers::block_policy(simulator);
}

}  // namespace

std::string_view name_of(Policy policy) {
    switch (policy) {
        case Policy::Random:
            return "random";
        case Policy::Noop:
            return "noop";
        case Policy::Learned:
            return "learned";
        case Policy::Planner:
            return "planner";
        case Policy::Rddl:
            break;
    }
    return "rddl";
}

std::string fault_line(const EpisodeFault& fault) {
    return fmt::format("episode {}, step {}: {}", fault.episode, fault.step, fault.message);
}

std::string policy_name(const RolloutOptions& options) {
    return options.policy == Policy::Planner ? options.planner
                                             : std::string(name_of(options.policy));
}

Rollouts run_episodes(const rddl_simulator& simulator, const RolloutOptions& options,
                      const TraceSink& trace, bool progress) {
    const solvers::Policy policy = policy_of(simulator, options);
    if (progress) note_plans(policy, options.episodes);
    return run_episodes(simulator, policy, options, trace, progress);
}

Rollouts run_episodes(const rddl_simulator& simulator, const solvers::Policy& policy,
                      const solvers::EpisodeOptions& options, const TraceSink& trace, bool progress,
                      const solvers::Stops& stops) {
    const std::int64_t steps = solvers::steps_at_most(simulator, options);
    Progress bar("running", options.episodes * std::max<std::int64_t>(steps, 1), progress);
    solvers::Watch watch;
    watch.stops = stops;
    watch.advance = [&](std::int64_t done) {
        bar.advance(done);
    };
    std::optional<TraceFormat> format;
    if (trace) {
        format.emplace(*simulator.problem);
        const bool at_once = options.threads == 1 && options.batch == 1;
        watch.record = [&, at_once](std::int64_t environments) {
            return std::make_unique<TraceRecorder>(simulator, *format, environments, trace,
                                                   at_once);
        };
    }
    return solvers::run_episodes(simulator, policy, options, watch);
}

}  // namespace rddlc::workbench
