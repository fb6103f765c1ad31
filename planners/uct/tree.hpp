// The tree of a search: states that were met, at their steps, the actions that are legal there,
// and what came of these. States that are met again at the same step are one node.
#pragma once

#include "planners/uct/large_pages.hpp"
#include "planners/uct/outcome_tables.hpp"
#include "planners/uct/state_hash.hpp"
#include "planners/uct/uct_options.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace rddlc::planners {

using EdgeId = std::uint32_t;

// A node has a cache line.
struct alignas(64) Node {
    double value = 0;
    EdgeId first_edge = 0;
    std::uint32_t edge_count = 0;
    std::int32_t step = 0;     // of the episode
    std::int32_t best = -1;    // the edge, from 0, whose value is the node's; -1: no such edge
    std::int32_t draws = 0;    // that its value was found by, before it had edges with values
    std::int32_t weight = 0;   // the sum of those of its edges
    std::int32_t untried = 0;  // edges of weight 0
    // The weight from which on twins of its actions are looked at (again).
    std::int32_t twins_at = std::numeric_limits<std::int32_t>::max();
    // The state in the determinised problem, and what its value was found by: for a node that has
    // this value, but no edges yet.
    std::uint32_t state = 0, epoch = 0;
    bool is_open = false;     // it has a value, and its edges have
    bool is_asked = false;    // its value is on the way
    bool has_priors = false;  // its edges have priors
    // No trial goes on from here: whatever is done, the state and the reward stay, so that the
    // value is exact; or the search ends, and the value is that of a network.
    bool is_locked = false;
};

// An action in a state.
struct alignas(32) Edge {
    double rewards = 0;  // the sum over trials, with the first value as that of one
    double rests = 0;    // the sum over trials of the values of what came after the action
    std::int32_t known_weight = 0;  // trials that were backed up; a first value counts as one
    std::uint32_t action = 0;
    OutcomeTable outcomes;
};

// Values of an edge from before its trials.
struct FirstValue {
    double estimate = 0;
    std::int32_t draws = 0;  // that it was found by
    float prior = 0;         // of a policy: 0 .. 1
};

// An arm of a bandit: all that a choice among the actions of a node reads of one of them.
struct Arm {
    double value = -std::numeric_limits<double>::infinity();  // of an edge that has one
    std::int32_t weight = 0;                                  // with trials that are under way
    float width = 0;                                          // 1 / sqrt(weight)
};

// A step of a trial: an action in a node, and its outcome by the node and by its place among the
// outcomes of all edges.
struct Transition {
    NodeId node;
    EdgeId edge;
    NodeId after;
    std::uint32_t outcome;
};

class Tree {
  public:
    // Node 0 is where episodes are over, and worth nothing.
    static constexpr NodeId over = 0;

    Tree(std::size_t state_size, double discount, Backup backup)
        : state_size_(state_size), discount_(discount), backup_(backup) {}

    void clear();
    // States at their steps have keys.
    std::uint64_t key_of(const std::byte* state, std::int64_t step) const {
        return hash_of(state, state_size_, static_cast<std::uint64_t>(step));
    }
    // Nothing: it was not met before.
    const NodeId* find(std::uint64_t key) const { return ids_.find(key); }
    const NodeId* find(const std::byte* state, std::int64_t step) const {
        return find(key_of(state, step));
    }
    // The node of the state at that step: a new one, unless find() knows it.
    NodeId node_of(std::uint64_t key, const std::byte* state, std::int64_t step);
    NodeId node_of(const std::byte* state, std::int64_t step) {
        return node_of(key_of(state, step), state, step);
    }
    EdgeId add_edge(NodeId node, std::uint32_t action);  // of one node after the other
    // Edges may be added to that node again. Those that it has get other numbers, so that no trial
    // may be under way.
    void reopen_edges(NodeId node);

    Node& node(NodeId id) { return nodes_[id]; }
    const Node& node(NodeId id) const { return nodes_[id]; }
    std::span<Edge> edges(const Node& node) {
        return {edges_.data() + node.first_edge, node.edge_count};
    }
    std::span<const Edge> edges(const Node& node) const {
        return {edges_.data() + node.first_edge, node.edge_count};
    }
    std::span<const Arm> arms(const Node& node) const {
        return {arms_.data() + node.first_edge, node.edge_count};
    }
    std::span<FirstValue> first_values(const Node& node) {
        return {first_values_.data() + node.first_edge, node.edge_count};
    }
    std::span<const FirstValue> first_values(const Node& node) const {
        return {first_values_.data() + node.first_edge, node.edge_count};
    }
    Edge& edge(EdgeId id) { return edges_[id]; }
    const Edge& edge(EdgeId id) const { return edges_[id]; }
    const Arm& arm(EdgeId id) const { return arms_[id]; }
    const FirstValue& first_value(EdgeId id) const { return first_values_[id]; }
    // Each asks for memory that is read soon: by find(), by what is done with a node, an edge or an
    // outcome, and by a choice among the node's edges.
    void prefetch(std::uint64_t key) const { ids_.prefetch(key); }
    void prefetch_outcome(EdgeId id, NodeId node) const {
        outcomes_.prefetch(edges_[id].outcomes, node);
    }
    void prefetch_node(NodeId id) const { __builtin_prefetch(nodes_.data() + id); }
    void prefetch_edge(EdgeId id) const { __builtin_prefetch(edges_.data() + id); }
    void prefetch_arms(const Node& node) const {
        const auto* const first = reinterpret_cast<const char*>(arms_.data() + node.first_edge);
        const std::size_t size = std::min<std::size_t>(node.edge_count * sizeof(Arm), 2048);
        for (std::size_t b = 0; b < size; b += 64) __builtin_prefetch(first + b);
        __builtin_prefetch(first + size - 1);
    }
    EdgeId id_of(const Edge& edge) const { return static_cast<EdgeId>(&edge - edges_.data()); }
    const std::byte* state(NodeId id) const { return states_.data() + id * state_size_; }
    std::size_t size() const { return nodes_.size(); }
    std::size_t bytes() const;
    // Forgets all but what may follow this action.
    void keep_below(EdgeId edge);

    // A further draw of what the edge is worth, before trials.
    void add_estimate(NodeId node, EdgeId edge, double value);
    // A trial takes that edge.
    void start(NodeId node, EdgeId edge);
    // It was cut off after that.
    void cancel(const Transition& made);
    // The trial went on to that node. The place of the outcome. Ends of episodes need none.
    std::uint32_t add_outcome(EdgeId edge, NodeId node) {
        return outcomes_.add(edges_[edge].outcomes, node);
    }
    // A node that was seen before, chosen by `share` of [0, 1).
    NodeId seen_outcome(EdgeId edge, double share) const;
    // A trial has ended: the reward of this edge, and the value of what came after it.
    void back_up(const Transition& made, double reward, double rest);
    // By its edges as they are now.
    void value_node(Node& node);
    double discount() const { return discount_; }

  private:
    Outcome& outcome_of(const Transition& made);
    void reserve_as(const Tree& other);
    void add_weight(Node& node, EdgeId edge, std::int32_t more);
    void add_rest(Edge& edge, Outcome& outcome, double rest);

    std::size_t state_size_;
    double discount_;
    Backup backup_;
    LargeVector<Node> nodes_;
    LargeVector<Edge> edges_;
    LargeVector<Arm> arms_;  // of edges
    LargeVector<FirstValue> first_values_;
    OutcomeTables outcomes_;
    LargeVector<std::byte> states_;
    StateTable ids_;
};

}  // namespace rddlc::planners
