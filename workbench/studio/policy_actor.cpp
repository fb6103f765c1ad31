#include "studio/policy_actor.hpp"

#include "support/failure.hpp"

#include <utility>

namespace rddlc::studio {

PolicyActor::PolicyActor(const SteppedEpisode& episode, solvers::Policy policy, bool is_planner)
    : policy_(std::move(policy)), is_planner_(is_planner), batch_(nullptr, nullptr) {
    solvers::require_spaces(policy_, episode.simulator());
    begin(episode);
}

void PolicyActor::begin(const SteppedEpisode& episode) {
    batch_ = episode.beginning();
    actor_ = policy_.start(1);
    branch_ = episode.branch();
    steps_ = 0;
    has_decided_ = false;
}

// Whether batch_ is the episode up to some moment, and there was no decision at the present one.
bool PolicyActor::follows(const SteppedEpisode& episode) const {
    return branch_ == episode.branch() && steps_ + (has_decided_ ? 1 : 0) <= episode.now_at();
}

Record PolicyActor::act(const SteppedEpisode& episode, const solvers::Stops& stops) {
    if (!follows(episode)) begin(episode);
    while (steps_ < episode.now_at()) {
        if (!has_decided_ && !is_planner_) decide(episode, stops);
        const Record& action = episode.moments()[steps_].action;
        const rddl_transition out{};
        const rddl_simulator& simulator = episode.simulator();
        solvers::require_done(simulator, simulator.step(batch_.get(), action.data(), &out));
        ++steps_;
        has_decided_ = false;
    }
    decide(episode, stops);
    std::uint8_t causes = RDDL_RUNNING;
    solvers::require_done(episode.simulator(),
                          episode.simulator().get_causes(batch_.get(), 0, 1, &causes));
    if (causes & RDDL_FAULTED) throw Failure(solvers::fault_text(episode.simulator(), *batch_, 0));
    return decision_;
}

void PolicyActor::decide(const SteppedEpisode& episode, const solvers::Stops& stops) {
    const std::uint8_t running[] = {1};
    const std::int64_t episodes[] = {episode.number()};
    const std::int64_t steps[] = {static_cast<std::int64_t>(steps_)};
    std::int32_t violated[] = {-1};
    decision_.resize(static_cast<std::size_t>(episode.problem().action_size));
    solvers::Decision decision{batch_.get(), running,          episodes,
                               steps,        decision_.data(), violated,
                               false,        &stops,           episode.horizon()};
    actor_(decision);
    has_decided_ = true;
}

}  // namespace rddlc::studio
