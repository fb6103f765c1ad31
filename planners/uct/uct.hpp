// plan:uct: tree search by trials (UCT; Kocsis and Szepesvari, 2006), as the family THTS describes
// it (Keller and Helmert, 2013). Many trials go down the tree side by side, each in an environment
// of one batch, and the leaves that they reach are valued together in another one.
#pragma once

#include "planners/planner/episode_memories.hpp"
#include "planners/planner/planner.hpp"
#include "planners/simulation/continuations.hpp"
#include "planners/simulation/finite_actions.hpp"
#include "planners/simulation/futures.hpp"
#include "planners/simulation/random_stream.hpp"
#include "planners/uct/determinised_problem.hpp"
#include "planners/uct/tree.hpp"
#include "planners/uct/tree_search.hpp"
#include "planners/uct/typical_steps.hpp"
#include "planners/uct/uct_options.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::planners {

// Steps and draws by which a policy values what comes after a lookahead.
inline constexpr std::int64_t later_steps = 20;
inline constexpr std::size_t later_draws = 4;

class Uct : public TreeSearch {
  public:
    Uct(const PlannerContext& context, const UctOptions& options);
    // Whether the problem has no more actions than options allow.
    static bool can_list_actions(const rddl_simulator& simulator, const UctOptions& options);
    void decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) override;

  private:
    // A trial on its way down.
    struct Trial {
        NodeId node;
        bool is_down;      // it has reached its leaf
        std::size_t hops;  // that it has made
    };
    struct Hop {
        Transition made;
        double reward;
    };

    // The memory of an episode, from one decision to the next.
    struct Memory {
        Tree tree;
        DeterminisedProblem determinised;
        std::int64_t end = 0;      // the step that the tree looks ahead to
        std::int64_t deepest = 0;  // the step that trials have come to
        // Changes with all that values in the determinised problem depend on: its depth, the policy
        // that plays on, and whether its states are still known.
        std::uint32_t epoch = 0;
        std::size_t policy = 0;       // that did so in the decision before
        std::size_t tree_kept = 0;    // bytes of the tree when it was freed of garbage last
        std::int64_t leaf_depth = 0;  // steps by which a policy values a new state, at most
        std::size_t bytes() const { return tree.bytes() + determinised.bytes(); }
    };

    bool is_determinised() const { return initial_ == Initial::Determinised; }
    void choose_memory(const DecisionPoint& point);
    void choose_lookahead(BudgetMeter& meter);
    std::int64_t steps_of_next_trial() const;
    EdgeId search(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    void keep_below(EdgeId edge);
    Tree& tree() { return memory_->tree; }
    const Tree& tree() const { return memory_->tree; }
    void choose_policy(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    bool open_root(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    bool value_root(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    void confirm_root(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    // The trials of one round; false where time was up, and nothing has changed but counts.
    bool run_trials(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    bool step_trials(RandomStream& stream, std::int64_t depth, BudgetMeter& meter);
    void cancel_trials();
    // Hop number h of trial k.
    Hop& hop(std::size_t h, std::size_t k) { return hops_[h * trials_.size() + k]; }
    // Each trial that is not down takes an action. So many do.
    std::int64_t start_hops(RandomStream& stream, std::int64_t step);
    void write_actions(std::size_t h);
    void ask_for_nodes(std::size_t h, std::int64_t step);
    void follow(std::size_t h, std::size_t k, RandomStream& stream, std::int64_t step);
    // The node of trial k's state after that edge.
    NodeId node_after(EdgeId edge, std::size_t k, RandomStream& stream, std::int64_t step);
    void ask_for_value(NodeId node);
    EdgeId choose_edge(const Node& node, double deviation, RandomStream& stream);
    EdgeId choose_untried(const Node& node, RandomStream& stream);
    EdgeId choose_by_prior(const Node& node, double deviation) const;
    // The deviation of values that counts as much as a lack of trials, in nodes of that step.
    double bonus(std::int64_t step) const;
    // The actions that are legal there.
    void add_edges(NodeId node, const Origin& origin);
    bool value_new_nodes(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter,
                         std::size_t draws);
    // The priors of new nodes by the policy's logits, or by its action alone.
    bool find_priors(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    // As in AlphaZero: by the policy's value network alone.
    bool value_by_network(BudgetMeter& meter);
    // Places new nodes in judged_, some at a time, and calls judge(first, count, steps) for them.
    template <class Judge>
    bool judge_new_nodes(BudgetMeter& meter, const Judge& judge);
    bool find_preferred(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    void set_priors(Node& node, const float* logarithms);
    bool value_by_determinisation(const DecisionPoint& point, RandomStream& stream,
                                  BudgetMeter& meter);
    // The mean rewards of the policy where lookaheads from new nodes end.
    bool find_later_rewards(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    void find_ends();
    double discounted_steps(std::int64_t steps) const;
    double estimate(const DeterminisedProblem::Move& move, const Node& node);
    bool value_by_policy(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter,
                         std::size_t draws);
    void add_move(NodeId node, const DeterminisedProblem::Move& move);
    double value_of_moves(const Node& node);
    // Most nodes are met once, and need no edges. Adds those of a node that trials go on from.
    void open_edges(NodeId node);
    // Whether its edges would have other values than it was valued by.
    bool is_stale(const Node& node) const {
        return is_determinised() && node.edge_count == 0 && node.epoch != memory_->epoch;
    }
    // The weight of a node from which on draws compare twins of its state.
    std::int32_t twins_at(DeterminisedProblem::StateId state) const;
    void compare_twins(NodeId node, const DecisionPoint& point, RandomStream& stream,
                       BudgetMeter& meter);
    void add_late_moves(NodeId node, DeterminisedProblem::StateId state);
    void compare_all_twins(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    bool draw_twins(NodeId node, DeterminisedProblem::StateId state, std::int32_t draws,
                    const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter);
    // The outcomes of two steps that continuations have made.
    bool has_same_outcome(std::size_t k, std::size_t j) const;
    void lock(Node& node, double reward);
    void take_values(std::size_t first, std::size_t count);
    std::optional<bool> stays_unchanged(const DecisionPoint& point, std::size_t n,
                                        RandomStream& stream, BudgetMeter& meter);
    void lock_where_it_stays(const DecisionPoint& point, std::size_t n, RandomStream& stream,
                             BudgetMeter& meter);
    bool is_unchanged(NodeId id, std::size_t n, std::size_t k) const;
    void note_range();
    bool is_full(EdgeId edge) const;
    void back_up_trials();
    void note_return(double value);
    double value_of(std::size_t k) const;
    EdgeId best_edge() const;
    void note_explanation(Explanation& explanation, EdgeId chosen, const BudgetMeter& meter);

    const rddl_simulator& simulator_;
    UctOptions options_;
    std::size_t state_size_, action_size_;
    FiniteActions actions_;
    Initial initial_;
    Futures trees_;  // trials
    Continuations continuations_;
    std::vector<BasePolicy> policies_;   // that may play on
    std::size_t policy_ = 0;             // that does
    solvers::ActionPriors priors_;       // of the user's policy; may be empty
    solvers::StateValues state_values_;  // of Initial::Value
    double discount_;  // the problem's, or that of the values, which rewards are added to
    double exploration_;
    bool goes_on_ = false;           // the network values what comes after the end of the search
    std::optional<Futures> judged_;  // new nodes, for these two
    std::optional<TypicalSteps> typical_steps_;  // of Initial::Determinised
    std::size_t most_bytes_, most_kept_bytes_;   // of a memory: in a decision, and after it
    EpisodeMemories<Memory> memories_;
    Memory* memory_ = nullptr;  // of the decision
    NodeId root_ = 0;
    std::int64_t step_ = 0;  // of the episode
    std::int64_t end_ = 0;   // the step that the search looks ahead to
    std::vector<Trial> trials_;
    std::vector<Hop> hops_;  // of one depth after the other, each of all trials
    std::vector<std::uint64_t> streams_;
    std::vector<std::uint64_t> keys_;  // of the nodes where trials are
    std::vector<NodeId> known_;        // these nodes; no_node: they are new
    std::vector<double> rests_;        // what trials were worth, from a hop on
    std::vector<std::byte> records_, states_, judged_states_;
    std::vector<std::int64_t> judged_steps_;
    std::vector<float> prior_rows_;
    std::vector<double> judged_values_;
    std::vector<std::uint8_t> legal_;
    std::vector<NodeId> new_nodes_;
    std::vector<NodeId> ripe_;           // of the round: nodes whose twins are compared next
    std::vector<std::uint8_t> differs_;  // by twin
    std::vector<std::uint32_t> drawn_actions_;
    // The requests to continuations, and the node and edge of each.
    struct Asked {
        NodeId node;
        EdgeId edge;
        std::uint64_t stream;
    };
    std::vector<Asked> asked_;
    std::vector<Start> starts_;
    // Edges of new nodes whose action has changed nothing, as a count for each node.
    std::vector<std::uint32_t> unchanged_;
    std::vector<double> unchanged_rewards_;
    std::vector<DeterminisedProblem::StateId>
        ends_;  // of lookaheads, whose later rewards are sought
    std::vector<DeterminisedProblem::StateId> determinised_states_;  // of new nodes
    double least_ = 0, most_ = 0;                                    // returns that were seen
};

}  // namespace rddlc::planners
