#include "planners/uct/tree.hpp"

#include "planners/simulation/random_stream.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace rddlc::planners {

void Tree::clear() {
    nodes_.assign(1, Node{});
    nodes_.front().is_open = nodes_.front().is_locked = true;
    edges_.clear();
    outcomes_.clear();
    states_.assign(state_size_, std::byte{0});
    ids_.clear();
}

// Two states of 10^6 have the same key with a chance of 10^-7; such are taken for one.
std::uint64_t Tree::key_of(const std::byte* state, std::int64_t depth) const {
    std::uint64_t key = scrambled(static_cast<std::uint64_t>(depth) + 1);
    std::size_t b = 0;
    for (; b + 8 <= state_size_; b += 8) {
        std::uint64_t word;
        std::memcpy(&word, state + b, 8);
        key = scrambled(key ^ word) + 0x9E3779B97F4A7C15u;
    }
    std::uint64_t rest = 0;
    if (b < state_size_) std::memcpy(&rest, state + b, state_size_ - b);
    return scrambled(key ^ rest);
}

const NodeId* Tree::find(const std::byte* state, std::int64_t depth) const {
    const auto found = ids_.find(key_of(state, depth));
    return found == ids_.end() ? nullptr : &found->second;
}

NodeId Tree::node_of(const std::byte* state, std::int64_t depth) {
    const auto [found, is_new] =
        ids_.try_emplace(key_of(state, depth), static_cast<NodeId>(nodes_.size()));
    if (is_new) {
        Node node;
        node.depth = depth;
        nodes_.push_back(node);
        states_.insert(states_.end(), state, state + state_size_);
    }
    return found->second;
}

void Tree::add_edge(NodeId id, std::uint32_t action) {
    Node& node = nodes_[id];
    if (node.edge_count == 0) node.first_edge = static_cast<EdgeId>(edges_.size());
    ++node.edge_count;
    Edge edge;
    edge.action = action;
    edges_.push_back(edge);
}

void Tree::add_outcome(EdgeId id, NodeId node) {
    Edge& edge = edges_[id];
    for (std::int32_t o = edge.first_outcome; o >= 0;
         o = outcomes_[static_cast<std::size_t>(o)].next) {
        if (outcomes_[static_cast<std::size_t>(o)].node != node) continue;
        ++outcomes_[static_cast<std::size_t>(o)].count;
        return;
    }
    outcomes_.push_back({node, 1, edge.first_outcome});
    edge.first_outcome = static_cast<std::int32_t>(outcomes_.size() - 1);
    ++edge.outcome_count;
}

NodeId Tree::seen_outcome(EdgeId id, double share) const {
    std::int64_t all = 0;
    const auto for_each = [&](const auto& take) {
        for (std::int32_t o = edges_[id].first_outcome; o >= 0;
             o = outcomes_[static_cast<std::size_t>(o)].next)
            if (outcomes_[static_cast<std::size_t>(o)].node != over)
                take(outcomes_[static_cast<std::size_t>(o)]);
    };
    for_each([&](const Outcome& outcome) { all += outcome.count; });
    auto left = static_cast<std::int64_t>(share * static_cast<double>(all));
    NodeId chosen = over;
    for_each([&](const Outcome& outcome) {
        if (left >= 0) chosen = outcome.node;
        left -= outcome.count;
    });
    return chosen;
}

void Tree::back_up(NodeId id, EdgeId edge_id, double reward, double rest) {
    Edge& edge = edges_[edge_id];
    edge.done += 1;
    edge.rewards += reward;
    edge.returns += reward + discount_ * rest;
    const double done = edge.done;
    double mean = edge.returns / done;
    if (backup_ == Backup::Max) {  // by the values that states have now
        double after = 0, count = 0;
        for (std::int32_t o = edge.first_outcome; o >= 0;) {
            const Outcome& outcome = outcomes_[static_cast<std::size_t>(o)];
            after += outcome.count * nodes_[outcome.node].value;
            count += outcome.count;
            o = outcome.next;
        }
        mean = edge.rewards / done + discount_ * after / count;
    }
    const double weight = edge.estimates > 0 ? 1 : 0;
    edge.value = (weight * edge.estimate + done * mean) / (weight + done);
    value_node(nodes_[id]);
}

void Tree::value_node(Node& node) {
    double best = -std::numeric_limits<double>::infinity(), sum = 0, count = 0;
    for (const Edge& edge : edges(node)) {
        const double weight = edge.done + (edge.estimates > 0 ? 1 : 0);
        if (weight == 0) continue;
        best = std::max(best, edge.value);
        sum += weight * edge.value;
        count += weight;
    }
    if (count > 0) node.value = backup_ == Backup::Max ? best : sum / count;
}

}  // namespace rddlc::planners
