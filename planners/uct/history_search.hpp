// plan:uct where actions cannot be listed, or states are hidden: trials go down a tree of histories
// (POMCP; Silver and Veness, 2010), to which actions are added as visits grow (progressive
// widening; Couetoux and others, 2011). Many trials go down side by side, each in an environment of
// one batch, and play on from their leaves.
#pragma once

#include "planners/planner/episode_memories.hpp"
#include "planners/planner/planner.hpp"
#include "planners/simulation/action_sampler.hpp"
#include "planners/simulation/base_policy.hpp"
#include "planners/simulation/budget.hpp"
#include "planners/simulation/finite_actions.hpp"
#include "planners/simulation/futures.hpp"
#include "planners/simulation/legal_actions.hpp"
#include "planners/simulation/mean_and_error.hpp"
#include "planners/simulation/random_stream.hpp"
#include "planners/uct/history_tree.hpp"
#include "planners/uct/tree_search.hpp"
#include "planners/uct/uct_options.hpp"
#include "solvers/spaces/actions.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::planners {

class HistorySearch : public TreeSearch {
  public:
    HistorySearch(const PlannerContext& context, const UctOptions& options);
    void decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) override;

  private:
    using Id = HistoryTree::Id;
    // A trial on its way.
    struct Trial {
        Id node = 0;  // 0: it has left the tree
        struct Hop {
            Id node, edge;
            double before;  // the return up to this step
        };
        std::vector<Hop> hops;
    };
    // The memory of an episode, from one decision to the next.
    struct Memory {
        HistoryTree tree;
        std::int64_t end = 0;  // the step that the tree looks ahead to
    };

    void open_root(const DecisionPoint& point);
    void choose_policy(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    std::optional<MeanAndError> return_of_policy(const DecisionPoint& point, RandomStream& stream,
                                                 BudgetMeter& meter);
    bool is_policy_better(Id best) const;
    // False where time was up, and nothing has changed but counts.
    bool run_trials(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    void begin_trials(const DecisionPoint& point, RandomStream& stream);
    void choose_actions(const DecisionPoint& point, RandomStream& stream);
    void follow(std::int64_t made, RandomStream& stream);
    void give_up();
    void back_up();
    std::uint64_t key_after(std::size_t lane, Id node, std::int64_t step) const;
    std::uint64_t key_of_state(const std::byte* state, std::int64_t step) const;
    bool may_widen(Id node) const;
    Id widen(Id node, RandomStream& stream);
    // The state after a step, or, where it is hidden, the observation.
    const std::byte* record_after(std::size_t lane) const;
    Id add_listed(Id node);
    bool has_edge(Id node, const std::byte* action) const;
    Id choose_edge(Id node);
    // 0: the node has no edge that a trial has ended on.
    Id best_edge(Id node) const;
    void note_explanation(Explanation& explanation, Id chosen, const BudgetMeter& meter);
    HistoryTree& tree() { return memory_->tree; }
    const HistoryTree& tree() const { return memory_->tree; }

    const rddl_simulator& simulator_;
    UctOptions options_;
    bool sees_state_;
    std::size_t state_size_, action_size_, observation_size_;
    solvers::ActionSpace space_;
    solvers::ActionRecords records_;
    std::optional<FiniteActions> listed_;  // where there are few enough actions
    ActionSampler sampler_;
    Futures futures_;
    LegalActions legal_;
    std::vector<BasePolicy> policies_;           // that may play on: one given, or no-op and random
    std::size_t policy_ = 0;                     // that does
    std::optional<MeanAndError> policy_return_;  // from the root, if it was played
    std::size_t most_bytes_;
    EpisodeMemories<Memory> memories_;
    Memory* memory_ = nullptr;  // of the decision
    Id root_ = 0;
    std::int64_t step_ = 0, depth_ = 0;  // of the episode; steps that are looked ahead
    std::vector<std::uint8_t> legal_at_root_;
    std::vector<Trial> trials_;
    std::vector<std::uint8_t> plays_on_;
    std::vector<std::uint64_t> streams_;
    std::vector<std::byte> actions_, records_after_, record_;
    double least_ = 0, most_ = 0;  // returns that were seen
};

}  // namespace rddlc::planners
