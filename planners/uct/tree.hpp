// The tree of a search: states that were met, at their steps, the actions that are legal there,
// and what came of these. States that are met again at the same step are one node.
#pragma once

#include "planners/uct/state_hash.hpp"
#include "planners/uct/uct_options.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace rddlc::planners {

using NodeId = std::uint32_t;
using EdgeId = std::uint32_t;

struct Node {
    EdgeId first_edge = 0;
    std::uint32_t edge_count = 0;
    std::int32_t draws = 0;  // that its value was found by, before it had edges with values
    std::int64_t step = 0;   // of the episode
    double value = 0;
    std::int32_t best = -1;   // the edge, from 0, whose value is the node's; -1: no such edge
    bool is_open = false;     // its edges have values
    bool has_priors = false;  // its edges have priors
    bool is_locked = false;   // whatever is done, the state and the reward stay: the value is exact
};

// An action in a state.
struct Edge {
    std::uint32_t action = 0;
    std::int32_t started = 0, done = 0;  // trials: that chose it, that were backed up
    std::int32_t estimates = 0;          // draws that its first value was found by
    double estimate = 0, value = 0;
    double rewards = 0, returns = 0;  // sums over trials
    float prior = 0;                  // of a policy: 0 .. 1
    std::int32_t first_outcome = -1, outcome_count = 0;

    std::int32_t weight() const { return started + (estimates > 0); }
};

struct Outcome {
    NodeId node;
    std::int32_t count, next;
};

class Tree {
  public:
    // Node 0 is where episodes are over, and worth nothing.
    static constexpr NodeId over = 0;

    Tree(std::size_t state_size, double discount, Backup backup)
        : state_size_(state_size), discount_(discount), backup_(backup) {}

    void clear();
    // The node of the state at that step: a new one, unless find() knows it.
    NodeId node_of(const std::byte* state, std::int64_t step);
    // Nothing: it was not met before.
    const NodeId* find(const std::byte* state, std::int64_t step) const;
    void add_edge(NodeId node, std::uint32_t action);  // of one node after the other

    Node& node(NodeId id) { return nodes_[id]; }
    const Node& node(NodeId id) const { return nodes_[id]; }
    std::span<Edge> edges(const Node& node) {
        return {edges_.data() + node.first_edge, node.edge_count};
    }
    std::span<const Edge> edges(const Node& node) const {
        return {edges_.data() + node.first_edge, node.edge_count};
    }
    Edge& edge(EdgeId id) { return edges_[id]; }
    // Asks for the memory of the node's edges, which a choice among them reads soon.
    void prefetch_edges(const Node& node) const {
        const auto* const first = reinterpret_cast<const char*>(edges_.data() + node.first_edge);
        const std::size_t size = std::min<std::size_t>(node.edge_count * sizeof(Edge), 4096);
        for (std::size_t b = 0; b < size; b += 64) __builtin_prefetch(first + b);
    }
    EdgeId id_of(const Edge& edge) const { return static_cast<EdgeId>(&edge - edges_.data()); }
    const std::byte* state(NodeId id) const { return states_.data() + id * state_size_; }
    std::size_t size() const { return nodes_.size(); }
    std::size_t bytes() const;
    // Forgets all but what may follow this action.
    void keep_below(EdgeId edge);

    // A trial went on to that node; one that was seen before, chosen by `share` of [0, 1).
    void add_outcome(EdgeId edge, NodeId node);
    NodeId seen_outcome(EdgeId edge, double share) const;
    // A trial has ended: the reward of this edge, and what came after it.
    void back_up(NodeId node, EdgeId edge, double reward, double rest);
    void value_node(Node& node);
    double discount() const { return discount_; }

  private:
    std::uint64_t key_of(const std::byte* state, std::int64_t step) const;

    std::size_t state_size_;
    double discount_;
    Backup backup_;
    std::vector<Node> nodes_;
    std::vector<Edge> edges_;
    std::vector<Outcome> outcomes_;
    std::vector<std::byte> states_;
    StateTable ids_;
};

}  // namespace rddlc::planners
