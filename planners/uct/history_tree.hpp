// A tree of what was done and observed: a node for each history, and edges for the actions that
// were tried there so far. Where states are observed in full, a state and its step are all that
// counts of a history.
#pragma once

#include "planners/uct/state_hash.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::planners {

class HistoryTree {
  public:
    using Id = std::uint32_t;  // of nodes and edges; 0 is neither
    struct Node {
        std::uint64_t key;  // of the history
        Id first_edge = 0;  // the newest one
        std::int32_t edges = 0, started = 0;
    };
    struct Edge {
        Id next = 0;                         // of the same node
        std::int32_t started = 0, done = 0;  // trials: that chose it, that ended
        double value = 0;                    // the mean return of those that ended
        Id first_outcome = 0;
        std::int32_t outcomes = 0;
    };
    struct Outcome {
        Id node, next;
        std::int32_t count;
    };

    // The bytes of a state are kept of each node if `state_size` is not 0.
    HistoryTree(std::size_t action_size, std::size_t state_size)
        : action_size_(action_size), state_size_(state_size) {
        clear();
    }

    void clear();
    // The node of a history: a new one, which has that state, or the one that it had before.
    Id node_of(std::uint64_t key, const std::byte* state);
    // 0: the history was not met.
    Id find(std::uint64_t key) const {
        const std::uint32_t* const known = ids_.find(key);
        return known ? *known : 0;
    }
    Id add_edge(Id node, const std::byte* action);
    // A trial went on to that node, or goes on to one that was met before, by `share` of [0, 1).
    void add_outcome(Id edge, Id node);
    Id seen_outcome(Id edge, double share) const;

    Node& node(Id id) { return nodes_[id]; }
    const Node& node(Id id) const { return nodes_[id]; }
    Edge& edge(Id id) { return edges_[id]; }
    const Edge& edge(Id id) const { return edges_[id]; }
    const std::byte* action(Id edge) const { return actions_.data() + edge * action_size_; }
    const std::byte* state(Id node) const { return states_.data() + node * state_size_; }
    std::size_t bytes() const;

  private:
    std::size_t action_size_, state_size_;
    std::vector<Node> nodes_;
    std::vector<Edge> edges_;
    std::vector<Outcome> outcomes_;
    std::vector<std::byte> actions_, states_;
    StateTable ids_;
};

}  // namespace rddlc::planners
