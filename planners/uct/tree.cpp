#include "planners/uct/tree.hpp"

#include <algorithm>
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

std::uint64_t Tree::key_of(const std::byte* state, std::int64_t step) const {
    return hash_of(state, state_size_, static_cast<std::uint64_t>(step));
}

const NodeId* Tree::find(const std::byte* state, std::int64_t step) const {
    return ids_.find(key_of(state, step));
}

NodeId Tree::node_of(const std::byte* state, std::int64_t step) {
    const auto [id, is_new] = ids_.add(key_of(state, step), static_cast<NodeId>(nodes_.size()));
    if (is_new) {
        Node node;
        node.step = step;
        nodes_.push_back(node);
        states_.insert(states_.end(), state, state + state_size_);
    }
    return id;
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

std::size_t Tree::bytes() const {
    return nodes_.size() * (sizeof(Node) + state_size_) + ids_.bytes() +
           edges_.size() * sizeof(Edge) + outcomes_.size() * sizeof(Outcome);
}

void Tree::keep_below(EdgeId edge) {
    Tree kept(state_size_, discount_, backup_);
    kept.clear();
    std::vector<NodeId> found;  // in this tree, by their number in the other one
    std::vector<NodeId> kept_id(size(), over);
    found.push_back(over);
    const auto keep = [&](NodeId id) {
        if (id == over || kept_id[id] != over || !nodes_[id].is_open) return kept_id[id];
        found.push_back(id);
        kept_id[id] = kept.node_of(state(id), nodes_[id].step);
        return kept_id[id];
    };
    const auto keep_outcomes = [&](const Edge& from, Edge* to) {
        std::int32_t last = -1;
        for (std::int32_t o = from.first_outcome; o >= 0;) {
            const Outcome& outcome = outcomes_[static_cast<std::size_t>(o)];
            o = outcome.next;
            const NodeId node = keep(outcome.node);
            if (!to || (node == over && outcome.node != over)) continue;
            const auto place = static_cast<std::int32_t>(kept.outcomes_.size());
            kept.outcomes_.push_back({node, outcome.count, -1});
            (last < 0 ? to->first_outcome : kept.outcomes_[static_cast<std::size_t>(last)].next) =
                place;
            last = place;
            ++to->outcome_count;
        }
    };
    keep_outcomes(edges_[edge], nullptr);
    for (NodeId id = 1; id < found.size(); ++id) {
        const Node& node = nodes_[found[id]];
        kept.nodes_[id] = node;
        kept.nodes_[id].first_edge = static_cast<EdgeId>(kept.edges_.size());
        for (const Edge& old : edges(node)) {
            Edge copy = old;
            copy.started = copy.done;  // trials that were cut off leave nothing
            copy.first_outcome = -1;
            copy.outcome_count = 0;
            keep_outcomes(old, &copy);
            kept.edges_.push_back(copy);
        }
    }
    *this = std::move(kept);
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
    const double weight = edge.estimates > 0 ? 1 : 0, before = edge.value;
    edge.value = (weight * edge.estimate + done * mean) / (weight + done);
    Node& node = nodes_[id];
    const auto place = static_cast<std::int32_t>(edge_id - node.first_edge);
    const bool is_best = place == node.best;
    if (node.best < 0 || (is_best && edge.value < before)) {
        value_node(node);
    } else if (is_best || edge.value > node.value) {
        node.best = place;
        node.value = edge.value;
    }
}

void Tree::value_node(Node& node) {
    double best = -std::numeric_limits<double>::infinity(), sum = 0, count = 0;
    for (const Edge& edge : edges(node)) {
        const double weight = edge.done + (edge.estimates > 0 ? 1 : 0);
        if (weight == 0) continue;
        if (backup_ == Backup::Max && (count == 0 || edge.value > best)) {
            best = edge.value;
            node.best = static_cast<std::int32_t>(id_of(edge) - node.first_edge);
        }
        sum += weight * edge.value;
        count += weight;
    }
    if (count > 0) node.value = backup_ == Backup::Max ? best : sum / count;
}

}  // namespace rddlc::planners
