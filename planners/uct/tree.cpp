#include "planners/uct/tree.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::planners {

void Tree::clear() {
    nodes_.assign(1, Node{});
    nodes_.front().is_open = nodes_.front().is_locked = true;
    edges_.clear();
    arms_.clear();
    first_values_.clear();
    outcomes_.clear();
    states_.assign(state_size_, std::byte{0});
    ids_.clear();
}

NodeId Tree::node_of(std::uint64_t key, const std::byte* state, std::int64_t step) {
    const auto [id, is_new] = ids_.add(key, static_cast<NodeId>(nodes_.size()));
    if (is_new) {
        Node node;
        node.step = static_cast<std::int32_t>(step);
        nodes_.push_back(node);
        states_.insert(states_.end(), state, state + state_size_);
    }
    return id;
}

EdgeId Tree::add_edge(NodeId id, std::uint32_t action) {
    Node& node = nodes_[id];
    if (node.edge_count == 0) node.first_edge = static_cast<EdgeId>(edges_.size());
    ++node.edge_count;
    ++node.untried;
    Edge edge;
    edge.action = action;
    edges_.push_back(edge);
    arms_.emplace_back();
    first_values_.emplace_back();
    return static_cast<EdgeId>(edges_.size() - 1);
}

void Tree::reopen_edges(NodeId id) {
    Node& node = nodes_[id];
    const std::size_t first = node.first_edge, count = node.edge_count;
    node.first_edge = static_cast<EdgeId>(edges_.size());
    for (std::size_t e = first; e < first + count; ++e) {
        edges_.push_back(Edge(edges_[e]));
        arms_.push_back(Arm(arms_[e]));
        first_values_.push_back(FirstValue(first_values_[e]));
    }
}

void Tree::add_weight(Node& node, EdgeId id, std::int32_t more) {
    Arm& arm = arms_[id];
    const bool was_tried = arm.weight > 0;
    arm.weight += more;
    arm.width = 1 / std::sqrt(static_cast<float>(arm.weight));
    node.weight += more;
    node.untried += was_tried - (arm.weight > 0);
}

void Tree::add_estimate(NodeId node, EdgeId id, double value) {
    FirstValue& first = first_values_[id];
    first.draws += 1;
    first.estimate += (value - first.estimate) / first.draws;
    edges_[id].rewards = arms_[id].value = first.estimate;
    if (first.draws > 1) return;
    edges_[id].known_weight = 1;
    add_weight(nodes_[node], id, 1);
}

void Tree::start(NodeId id, EdgeId edge) {
    Node& node = nodes_[id];
    if (arms_[edge].weight == 0) arms_[edge].value = node.value;  // until it is backed up
    add_weight(node, edge, 1);
}

// It lies elsewhere where the edge has had more outcomes since.
Outcome& Tree::outcome_of(const Transition& made) {
    OutcomeTable& table = edges_[made.edge].outcomes;
    return outcomes_[table.has(made.outcome) ? made.outcome : outcomes_.add(table, made.after)];
}

void Tree::cancel(const Transition& made) {
    add_weight(nodes_[made.node], made.edge, -1);
    if (arms_[made.edge].weight == 0) arms_[made.edge] = {};
}

// By how often trials came there; before any is backed up, the first one.
NodeId Tree::seen_outcome(EdgeId id, double share) const {
    const auto seen = outcomes_.places(edges_[id].outcomes);
    const auto is_node = [](const Outcome& outcome) {
        return outcome.node != no_node && outcome.node != over;
    };
    std::int64_t all = 0;
    for (const Outcome& outcome : seen) all += is_node(outcome) ? outcome.done : 0;
    auto left = static_cast<std::int64_t>(share * static_cast<double>(all));
    for (const Outcome& outcome : seen) {
        if (!is_node(outcome)) continue;
        left -= outcome.done;
        if (left < 0 || all == 0) return outcome.node;
    }
    return over;
}

std::size_t Tree::bytes() const {
    return nodes_.size() * (sizeof(Node) + state_size_) + ids_.bytes() + outcomes_.bytes() +
           edges_.size() * (sizeof(Edge) + sizeof(Arm) + sizeof(FirstValue));
}

// A tree that grows to the size of another one moves nothing on the way.
void Tree::reserve_as(const Tree& other) {
    nodes_.reserve(other.nodes_.size());
    edges_.reserve(other.edges_.size());
    arms_.reserve(other.arms_.size());
    first_values_.reserve(other.first_values_.size());
    outcomes_.reserve_as(other.outcomes_);
    states_.reserve(other.states_.size());
}

void Tree::keep_below(EdgeId edge) {
    Tree kept(state_size_, discount_, backup_);
    kept.clear();
    kept.reserve_as(*this);
    std::vector<NodeId> found;  // in this tree, by their number in the other one
    std::vector<NodeId> kept_id(size(), over);
    found.push_back(over);
    const auto keep = [&](NodeId id) {
        if (id == over || kept_id[id] != over) return kept_id[id];
        found.push_back(id);
        kept_id[id] = kept.node_of(state(id), nodes_[id].step);
        return kept_id[id];
    };
    for (const Outcome& outcome : outcomes_.places(edges_[edge].outcomes))
        if (outcome.node != no_node && nodes_[outcome.node].is_open) keep(outcome.node);
    for (NodeId id = 1; id < found.size(); ++id) {
        const Node& node = nodes_[found[id]];
        kept.nodes_[id] = node;
        kept.nodes_[id].first_edge = static_cast<EdgeId>(kept.edges_.size());
        for (const Edge& old : edges(node)) {
            Edge now = old;
            now.outcomes = {};
            for (const Outcome& outcome : outcomes_.places(old.outcomes)) {
                if (outcome.done == 0) continue;  // empty, or of trials that were cut off
                const NodeId after = keep(outcome.node);
                kept.outcomes_[kept.outcomes_.add(now.outcomes, after)] = {outcome.value, after,
                                                                           outcome.done};
            }
            kept.edges_.push_back(now);
            kept.arms_.push_back(arms_[id_of(old)]);
            kept.first_values_.push_back(first_values_[id_of(old)]);
        }
    }
    *this = std::move(kept);
}

// The outcome's node may have another value now, and has been met once more. Other outcomes have
// those of the last trials that met them by this edge: a sum over all of them costs more than it
// tells.
void Tree::add_rest(Edge& edge, Outcome& outcome, double rest) {
    if (backup_ == Backup::Mean) {
        outcome.done += 1;
        edge.rests += rest;
        return;
    }
    const double before = outcome.done * outcome.value;
    outcome.done += 1;
    outcome.value = nodes_[outcome.node].value;
    edge.rests += outcome.done * outcome.value - before;
    if (std::isfinite(edge.rests)) return;
    edge.rests = 0;  // infinite values have no difference
    for (const Outcome& one : outcomes_.places(edge.outcomes))
        if (one.done > 0) edge.rests += one.done * one.value;
}

void Tree::back_up(const Transition& made, double reward, double rest) {
    Edge& edge = edges_[made.edge];
    Arm& arm = arms_[made.edge];
    edge.known_weight += 1;
    edge.rewards += reward;
    if (made.after != over) add_rest(edge, outcome_of(made), rest);
    const double before = arm.value;
    arm.value = (edge.rewards + discount_ * edge.rests) / edge.known_weight;
    Node& node = nodes_[made.node];
    const auto best = static_cast<std::int32_t>(made.edge - node.first_edge);
    const bool is_best = best == node.best;
    if (node.best < 0 || (is_best && arm.value < before)) {
        value_node(node);
    } else if (is_best || arm.value > node.value) {
        node.best = best;
        node.value = arm.value;
    }
}

void Tree::value_node(Node& node) {
    if (backup_ == Backup::Max) {
        const auto all = arms(node);
        const auto best = std::ranges::max_element(all, {}, &Arm::value);
        if (node.weight == 0 || best == all.end()) return;
        node.best = static_cast<std::int32_t>(best - all.begin());
        node.value = best->value;
        return;
    }
    double sum = 0, mass = 0;
    for (const Edge& edge : edges(node)) {
        const double part = edge.known_weight;
        if (part == 0) continue;
        sum += part * arms_[id_of(edge)].value;
        mass += part;
    }
    if (mass > 0) node.value = sum / mass;
}

}  // namespace rddlc::planners
