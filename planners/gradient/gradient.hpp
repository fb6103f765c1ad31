// plan:gradient: model predictive control by gradients. Plans of actions go up the exact gradient
// of their return (Wu, Say and Sanner, 2017; Bueno and others, 2019), with bools and draws relaxed
// as JaxPlan does (Gimelfarb, Taitler and Sanner, 2024). What they mean as real actions is compared
// by simulation, with no-op and a given policy.
#pragma once

#include "planners/gradient/action_parameters.hpp"
#include "planners/gradient/ascent.hpp"
#include "planners/gradient/gradient_options.hpp"
#include "planners/gradient/population.hpp"
#include "planners/planner/episode_memories.hpp"
#include "planners/planner/planner.hpp"
#include "planners/simulation/base_policy.hpp"
#include "planners/simulation/budget.hpp"
#include "planners/simulation/futures.hpp"
#include "planners/simulation/random_stream.hpp"
#include "solvers/spaces/action_repair.hpp"
#include "solvers/spaces/actions.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rddlc::planners {

class Gradient : public Planner {
  public:
    Gradient(const PlannerContext& context, const GradientOptions& options);
    void decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) override;

  private:
    // A candidate is a plan with one way to round its bools, no-op, or the policy.
    struct Candidate {
        enum class Kind { Plan, Noop, Policy } kind = Kind::Noop;
        std::size_t plan = 0;
        double threshold = 0.5;
        double value = 0, error = 0;
        bool has_action_of(const Candidate& other) const {
            return kind == other.kind && plan == other.plan && threshold == other.threshold;
        }
    };
    // The memory of an episode, from one decision to the next.
    struct Memory {
        std::vector<AscendingPlan> plans;  // the best one first; each ascent takes every n-th
        Candidate choice;                  // of the last search; its plan, if it is one, is 0
        bool is_improved = false;          // this search has moved the plans
        std::int64_t horizon = 0;          // of a search; plans have horizon_ steps
        std::int64_t steps_left = 0;       // that are made before the next search
        std::size_t steps_made = 0;  // since the last search: plans begin with their first row
    };

    Memory& memory_of(const DecisionPoint& point, RandomStream& stream);
    void disturb(AscendingPlan& plan, double spread, RandomStream& stream) const;
    void search(const DecisionPoint& point, Memory& memory, RandomStream& stream,
                BudgetMeter& meter, Explanation* explanation);
    void ascend(const DecisionPoint& point, Memory& memory, RandomStream& stream,
                BudgetMeter& meter);
    void find_candidates(const Memory& memory);
    void time_comparison(const DecisionPoint& point, const Memory& memory, std::int64_t depth,
                         RandomStream& stream, BudgetMeter& meter);
    // The steps that were made, fewer where time or steps are used up: then plans count by the
    // values of their ascents.
    std::int64_t compare(const DecisionPoint& point, const Memory& memory, std::int64_t depth,
                         RandomStream& stream, BudgetMeter& meter);
    void rank_by_ascents(const Memory& memory);
    void sort_candidates();
    void write_rows(const Memory& memory, std::int64_t step);
    void write_first(const Candidate& candidate, const Memory& memory, const DecisionPoint& point,
                     std::byte* action);
    void move_on(Memory& memory, RandomStream& stream) const;
    void note(const Memory& memory, const DecisionPoint& point, Explanation& explanation);

    const rddl_simulator& simulator_;
    GradientOptions options_;
    solvers::ActionSpace space_;
    solvers::ActionRecords records_;
    ActionParameters parameters_;
    std::vector<std::unique_ptr<solvers::StepDerivatives>> derivatives_;  // by each relaxation
    std::int64_t horizon_, first_horizon_;
    GradientPopulation population_;
    std::size_t plans_, scenarios_;  // plans: of all relaxations
    std::vector<Ascent> ascents_;    // by each relaxation
    Futures futures_;                // of the comparison
    Futures single_;                 // of the action that is made
    solvers::RepairBuffers repair_, single_repair_;
    std::optional<BasePolicy> base_;
    EpisodeMemories<Memory> memories_;

    double comparison_seconds_ = 0;  // of the last one
    std::vector<Candidate> candidates_;
    std::vector<std::size_t> order_;  // of candidates, the best first
    std::vector<std::uint64_t> seeds_, streams_;
    std::vector<std::byte> state_, actions_;
    std::vector<double> state_numbers_;
    std::vector<float> rows_;
    std::vector<std::uint8_t> by_policy_;
};

}  // namespace rddlc::planners
