// A policy that acts in an episode which others also act in.
#pragma once

#include "solvers/batches/stops.hpp"
#include "solvers/policies/policy.hpp"
#include "studio/stepped_episode.hpp"

namespace rddlc::studio {

// Policies may remember what they have seen of an episode: recurrent networks, policy blocks. So
// the policy is shown the episode from its beginning, in an environment of its own, where its
// decisions before the present are dropped and the actions that were really taken are taken again.
// Planners remember at most where their last search has ended: they begin at the present.
class PolicyActor {
  public:
    // The simulator must outlive it.
    PolicyActor(const SteppedEpisode& episode, solvers::Policy policy, bool is_planner);

    const std::string& name() const { return policy_.name; }
    // The action at the present moment. The same episode as before, which may have gone on or back.
    // A stop makes it end early with any valid action.
    Record act(const SteppedEpisode& episode, const solvers::Stops& stops);

  private:
    bool follows(const SteppedEpisode& episode) const;
    void begin(const SteppedEpisode& episode);
    void decide(const SteppedEpisode& episode, const solvers::Stops& stops);

    solvers::Policy policy_;
    bool is_planner_;
    solvers::BatchHandle batch_;
    solvers::Actor actor_;
    std::uint64_t branch_ = 0;  // of the episode that batch_ has followed
    std::size_t steps_ = 0;     // that batch_ has made
    bool has_decided_ = false;  // at the state of batch_
    Record decision_;
};

}  // namespace rddlc::studio
