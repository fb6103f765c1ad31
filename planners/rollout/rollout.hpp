// plan:rollout: a step of policy improvement (Tesauro and Galperin, 1996; Bertsekas, Tsitsiklis and
// Wu, 1997). Each action is tried, and the policy plays on: all with the same luck. Those that are
// behind drop out by halves (Karnin, Koren and Somekh, 2013).
#pragma once

#include "planners/planner/planner.hpp"
#include "planners/rollout/rollout_options.hpp"
#include "planners/simulation/continuations.hpp"
#include "planners/simulation/finite_actions.hpp"
#include "planners/simulation/luck.hpp"
#include "solvers/spaces/actions.hpp"
#include "solvers/spaces/mending.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::planners {

class Rollout : public Planner {
  public:
    Rollout(const Surroundings& surroundings, const RolloutOptions& options);
    void decide(const Situation& situation, std::byte* action, Thoughts* thoughts) override;

  private:
    // An action, and by how much it was better than the policy's, draw by draw.
    struct Candidate {
        const std::byte* action;
        double sum = 0, difference = 0, squares = 0;
        std::int64_t draws = 0;

        double mean() const { return difference / static_cast<double>(draws); }
        double error() const;
    };

    void find_candidates(const Situation& situation, Luck& luck);
    void draw_actions(const Situation& situation, Luck& luck);
    bool try_all(const Situation& situation, Luck& luck, Meter& meter);
    void halve();
    std::size_t best() const;
    void note_thoughts(Thoughts& thoughts, std::size_t chosen, const Meter& meter) const;

    const rddl_simulator& simulator_;
    RolloutOptions options_;
    solvers::ActionSpace space_;
    solvers::ActionRecords records_;
    std::size_t action_size_;
    std::optional<FiniteActions> actions_;
    Continuations continuations_;
    BasePolicy policy_, random_;
    std::vector<std::uint8_t> legal_;
    // Actions that are drawn, where not all are taken.
    std::optional<Futures> sampling_;
    solvers::MendingRoom mending_;
    std::vector<std::byte> drawn_;
    std::vector<float> rows_, base_row_;
    std::vector<std::uint64_t> lucks_;
    std::vector<Candidate> candidates_;  // the first one is the policy's action
    std::vector<std::size_t> left_;      // of them, the policy's first
    std::vector<Start> starts_;
    std::vector<double> values_;  // of starts
    std::int64_t depth_ = 0;
};

}  // namespace rddlc::planners
