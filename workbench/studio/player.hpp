// An episode on the page, stepped by hand and by policies.
#pragma once

#include "studio/drawing.hpp"
#include "studio/edited_problem.hpp"
#include "studio/job.hpp"
#include "studio/policy_actor.hpp"
#include "studio/stepped_episode.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace rddlc::studio {

struct PlayerOptions {
    // The file with the policy block that the problem was loaded with; empty: the texts' own.
    std::string policy_block;
    std::uint64_t seed = 0;
    std::int64_t episode = 0;
    std::int64_t horizon = 0;  // an option of batches
};

// Threads may use it at once: the page asks while a policy runs.
class Player : public std::enable_shared_from_this<Player> {
  public:
    Player(workbench::LoadedProblem problem, const PlayerOptions& options);

    // The facts of the problem that the page shows: action-fluents with their ranges, ...
    Json description() const;

    // Each stops what runs, and throws a Failure for a wrong request. A policy is named as
    // users do, and refused if it is another policy block than the problem was loaded with.
    void go_to(std::size_t moment);
    // Returns why the action is illegal, and takes it only if `force`; empty: it was taken.
    std::string step(const nlohmann::json& action, bool force);
    // The action that the policy would take at the moment, as JSON of the values that differ from
    // their defaults.
    std::string advice(const Workers& workers, const std::string& policy, std::size_t moment);
    // So many steps, or fewer if the episode ends, in the background.
    void run(const std::shared_ptr<Workers>& workers, const std::string& policy,
             std::int64_t steps);
    void stop();
    // The same without waiting for the end of the step that runs.
    void stop_soon();

    // The moments from `since` on, at most so many as fit into a message, and the state of the run.
    // `branch` counts how often moments were replaced: where it is not the page's, all are sent.
    std::string updates(std::uint64_t branch, std::size_t since) const;
    std::string picture(std::size_t moment, const std::string& visualizer, PictureSize size) const;

  private:
    PolicyActor& actor_named(const std::string& policy);
    void halt();  // with run_mutex_
    void require_block(const std::string& policy) const;
    Json run_steps(Job& job, const std::string& policy, std::int64_t steps);

    const workbench::LoadedProblem problem_;
    const std::string policy_block_;
    // The lock for the moments of the episode and for run_. A step that takes long is made outside
    // it, by the run or by the holder of run_mutex_: nothing else changes the episode.
    mutable std::mutex mutex_;
    SteppedEpisode episode_;
    std::mutex run_mutex_;
    std::unique_ptr<PolicyActor> actor_;
    std::shared_ptr<Job> run_;
};

}  // namespace rddlc::studio
