#include "planners/uct/history_tree.hpp"

namespace rddlc::planners {

void HistoryTree::clear() {
    nodes_.assign(1, {});
    edges_.assign(1, {});
    outcomes_.assign(1, {});
    actions_.assign(action_size_, {});
    states_.assign(state_size_, {});
    ids_.clear();
}

HistoryTree::Id HistoryTree::node_of(std::uint64_t key, const std::byte* state) {
    const auto [id, is_new] = ids_.add(key, static_cast<Id>(nodes_.size()));
    if (is_new) {
        nodes_.push_back({key});
        states_.insert(states_.end(), state, state + state_size_);
    }
    return id;
}

HistoryTree::Id HistoryTree::add_edge(Id node, const std::byte* action) {
    const auto id = static_cast<Id>(edges_.size());
    edges_.push_back({nodes_[node].first_edge});
    actions_.insert(actions_.end(), action, action + action_size_);
    nodes_[node].first_edge = id;
    nodes_[node].edges += 1;
    return id;
}

void HistoryTree::add_outcome(Id edge, Id node) {
    Edge& of = edges_[edge];
    for (Id o = of.first_outcome; o != 0; o = outcomes_[o].next)
        if (outcomes_[o].node == node) {
            outcomes_[o].count += 1;
            return;
        }
    outcomes_.push_back({node, of.first_outcome, 1});
    of.first_outcome = static_cast<Id>(outcomes_.size() - 1);
    of.outcomes += 1;
}

HistoryTree::Id HistoryTree::seen_outcome(Id edge, double share) const {
    std::int64_t all = 0;
    for (Id o = edges_[edge].first_outcome; o != 0; o = outcomes_[o].next)
        all += outcomes_[o].count;
    auto left = static_cast<std::int64_t>(share * static_cast<double>(all));
    for (Id o = edges_[edge].first_outcome; o != 0; o = outcomes_[o].next) {
        left -= outcomes_[o].count;
        if (left < 0) return outcomes_[o].node;
    }
    return 0;
}

std::size_t HistoryTree::bytes() const {
    return nodes_.size() * (sizeof(Node) + state_size_ + 2 * sizeof(std::uint64_t)) +
           edges_.size() * (sizeof(Edge) + action_size_) + outcomes_.size() * sizeof(Outcome);
}

}  // namespace rddlc::planners
