// An episode that is stepped one action at a time, and goes back exactly.
#pragma once

#include "engines/load_simulator.hpp"
#include "formats/records_json.hpp"
#include "solvers/batches/batch.hpp"

#include <rddl/simulator.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::studio {

using Record = std::vector<std::byte>;

// The values of a state, an observation or an action beyond so many are not sent to the page, which
// could not show them.
inline constexpr std::size_t most_values = 2000;

// A state of the episode and, unless it is the last one, the action taken in it.
struct Moment {
    Record state, observation;  // `observation` is empty unless the problem hides its state
    std::uint8_t causes = 0;    // of the end, if the episode is over
    std::string fault;          // that has ended it
    double total = 0;           // rewards of the steps before
    Record snapshot;            // of the environment
    std::size_t bytes = 0;      // of the moments before

    Record action;  // empty: no action was taken yet
    double reward = 0;
    std::string by;       // who has chosen the action: "you", or the name of a policy
    std::string warning;  // the precondition that it violates
};

// A step that was made, and is not yet among the moments.
struct MadeStep {
    Record action;
    double reward = 0;
    std::string warning;
    Moment next;
};

class SteppedEpisode {
  public:
    // Episode number `episode` of the seed, as `rddl run` has it. The simulator must be one with
    // snapshots. `horizon` is an option of batches.
    SteppedEpisode(workbench::Simulator simulator, std::uint64_t seed, std::int64_t episode,
                   std::int64_t horizon = 0);

    const rddl_simulator& simulator() const { return *simulator_; }
    const rddl_problem& problem() const { return *simulator_->problem; }
    std::uint64_t seed() const { return seed_; }
    std::int64_t number() const { return number_; }
    std::int64_t horizon() const { return horizon_; }
    // A new environment at the beginning of the same episode.
    solvers::BatchHandle beginning() const;

    const std::vector<Moment>& moments() const { return moments_; }
    const Moment& now() const { return moments_[now_]; }
    // The number of steps made before.
    std::size_t now_at() const { return now_; }
    // How often later moments were replaced by others.
    std::uint64_t branch() const { return branch_; }
    bool is_over() const { return now().causes != RDDL_RUNNING; }

    // Makes the moment the present one; the later ones stay until another action is taken.
    void go_to(std::size_t moment);
    // The action of these values, the others being at their defaults. Throws a Failure if there is
    // no such action.
    Record read_action(const nlohmann::json& values) const;
    // Why the action is illegal at the present moment; empty if it is legal.
    std::string violation_of(const Record& action) const;
    // Takes the action at the present moment, which may take long for a large problem, and leaves
    // the moments as they are: others may read them meanwhile. Throws a Failure if the episode is
    // over, or too long to be kept.
    MadeStep make_step(const Record& action);
    // Puts the step behind the present moment, in place of what came after it before.
    void keep(MadeStep step, std::string by);
    // Makes the step and keeps it.
    void step(const Record& action, std::string by) { keep(make_step(action), std::move(by)); }

    // The values that differ from their defaults, as a JSON object.
    std::string action_json(const Record& action) const;
    // {"step", "state", "total"}; "observation" if the problem hides its state; "action" (of values
    // that differ from their defaults), "reward" and "by" if an action was taken; "warning" if that
    // was illegal; "ended" (a list of causes) and "fault" at an end. Values are as in traces.
    std::string moment_json(std::size_t moment) const;

  private:
    Moment present() const;

    workbench::Simulator simulator_;
    std::uint64_t seed_;
    std::int64_t number_, horizon_;
    workbench::RecordLayout states_, actions_, observations_;
    solvers::BatchHandle batch_;
    std::vector<Moment> moments_;
    std::size_t now_ = 0;
    std::uint64_t branch_ = 0;
};

}  // namespace rddlc::studio
