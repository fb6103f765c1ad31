// plan:rollout: a step of policy improvement (Tesauro and Galperin, 1996; Bertsekas, Tsitsiklis and
// Wu, 1997). Each action is tried, and the policy plays on: all with the same stream. Those that
// are behind drop out by halves (Karnin, Koren and Somekh, 2013).
#pragma once

#include "planners/planner/planner.hpp"
#include "planners/rollout/rollout_options.hpp"
#include "planners/simulation/continuations.hpp"
#include "planners/simulation/finite_actions.hpp"
#include "planners/simulation/random_stream.hpp"
#include "solvers/spaces/action_repair.hpp"
#include "solvers/spaces/actions.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace rddlc::planners {

class Rollout : public Planner {
  public:
    Rollout(const PlannerContext& context, const RolloutOptions& options);
    void decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) override;

  private:
    // An action, and by how much it was better than the policy's, draw by draw.
    struct Candidate {
        const std::byte* action;
        double sum = 0, difference = 0, squares = 0;
        std::int64_t draws = 0;

        double mean() const { return difference / static_cast<double>(draws); }
        double error() const;
    };

    void find_candidates(const DecisionPoint& point, RandomStream& stream);
    void draw_actions(const DecisionPoint& point, RandomStream& stream);
    bool try_all(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    void halve();
    std::size_t best() const;
    void note_explanation(Explanation& explanation, std::size_t chosen,
                          const BudgetMeter& meter) const;

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
    solvers::RepairBuffers repair_;
    std::vector<std::byte> drawn_;
    std::vector<float> rows_, base_row_;
    std::vector<std::uint64_t> streams_;
    std::unordered_set<std::string_view> known_;  // records of candidates
    std::vector<Candidate> candidates_;           // the first one is the policy's action
    std::vector<std::size_t> left_;               // of them, the policy's first
    std::vector<Start> starts_;
    std::vector<double> values_;  // of starts
    std::int64_t depth_ = 0;
};

}  // namespace rddlc::planners
