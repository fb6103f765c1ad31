#include "planners/uct/tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rddlc::planners {

void Tree::clear() {
    nodes_.assign(1, Node{});
    nodes_.front().is_open = nodes_.front().is_locked = true;
    edges_.clear();
    arms_.clear();
    outcomes_.clear();
    states_.assign(state_size_, std::byte{0});
    ids_.clear();
    places_.clear();
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
    return static_cast<EdgeId>(edges_.size() - 1);
}

void Tree::reopen_edges(NodeId id) {
    Node& node = nodes_[id];
    const std::size_t first = node.first_edge, count = node.edge_count;
    node.first_edge = static_cast<EdgeId>(edges_.size());
    for (std::size_t e = first; e < first + count; ++e) {
        const auto now = static_cast<EdgeId>(edges_.size());
        edges_.push_back(Edge(edges_[e]));
        arms_.push_back(Arm(arms_[e]));
        if (edges_[now].outcome_count > few_outcomes) list_outcomes(now, edges_[now]);
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
    Edge& edge = edges_[id];
    edge.estimates += 1;
    edge.estimate += (value - edge.estimate) / edge.estimates;
    arms_[id].value = edge.estimate;
    if (edge.estimates == 1) add_weight(nodes_[node], id, 1);
}

void Tree::start(NodeId id, EdgeId edge) {
    Node& node = nodes_[id];
    if (arms_[edge].weight == 0) arms_[edge].value = node.value;  // until it is backed up
    add_weight(node, edge, 1);
}

void Tree::cancel(NodeId node, EdgeId edge, std::uint32_t outcome) {
    add_weight(nodes_[node], edge, -1);
    if (arms_[edge].weight == 0) arms_[edge] = {};
    --outcomes_[edges_[edge].first_outcome + outcome].started;
}

std::uint32_t Tree::add_outcome(EdgeId id, NodeId after) {
    Edge& edge = edges_[id];
    Node& node = nodes_[after];
    if (node.edge_before == no_edge) {
        node.outcome = append_outcome(id, edge, {after, 0, 0, 0});
    } else if (node.edge_before != id) {
        node.outcome = place_of(id, after);
    }
    node.edge_before = id;
    ++outcomes_[edge.first_outcome + node.outcome].started;
    return node.outcome;
}

std::uint32_t Tree::place_of(EdgeId id, NodeId after) {
    Edge& edge = edges_[id];
    const auto seen = outcomes(edge);
    if (seen.size() <= few_outcomes) {
        const auto found = std::ranges::find(seen, after, &Outcome::node);
        if (found != seen.end()) return static_cast<std::uint32_t>(found - seen.begin());
    } else if (const std::uint32_t* const known = places_.find(outcome_key(id, after))) {
        return *known - 1;
    }
    return append_outcome(id, edge, {after, 0, 0, 0});
}

void Tree::list_outcomes(EdgeId id, const Edge& edge) {
    for (std::uint32_t place = 0; place < edge.outcome_count; ++place)
        list_outcome(id, outcomes(edge)[place].node, place);
}

// Its place. A full block moves to the end, with as much room again.
std::uint32_t Tree::append_outcome(EdgeId id, Edge& edge, const Outcome& outcome) {
    const std::size_t count = edge.outcome_count;
    if (count == few_outcomes) list_outcomes(id, edge);
    if (count >= few_outcomes) list_outcome(id, outcome.node, static_cast<std::uint32_t>(count));
    if (count == 0 || std::has_single_bit(count)) {
        const std::size_t first = outcomes_.size();
        outcomes_.resize(first + std::max<std::size_t>(1, 2 * count));
        std::copy_n(outcomes_.data() + edge.first_outcome, count, outcomes_.data() + first);
        edge.first_outcome = static_cast<std::uint32_t>(first);
    }
    outcomes_[edge.first_outcome + count] = outcome;
    return edge.outcome_count++;
}

NodeId Tree::seen_outcome(EdgeId id, double share) const {
    const auto seen = outcomes(edges_[id]);
    std::int64_t all = 0;
    for (const Outcome& outcome : seen) all += outcome.node == over ? 0 : outcome.started;
    auto left = static_cast<std::int64_t>(share * static_cast<double>(all));
    for (const Outcome& outcome : seen) {
        if (outcome.node == over) continue;
        left -= outcome.started;
        if (left < 0) return outcome.node;
    }
    return over;
}

std::size_t Tree::bytes() const {
    return nodes_.size() * (sizeof(Node) + state_size_) + ids_.bytes() + places_.bytes() +
           edges_.size() * (sizeof(Edge) + sizeof(Arm)) + outcomes_.size() * sizeof(Outcome);
}

// A tree that grows to the size of another one moves nothing on the way.
void Tree::reserve_as(const Tree& other) {
    nodes_.reserve(other.nodes_.size());
    edges_.reserve(other.edges_.size());
    arms_.reserve(other.arms_.size());
    outcomes_.reserve(other.outcomes_.size());
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
    for (const Outcome& outcome : outcomes(edges_[edge]))
        if (nodes_[outcome.node].is_open) keep(outcome.node);
    for (NodeId id = 1; id < found.size(); ++id) {
        const Node& node = nodes_[found[id]];
        Node& copy = kept.nodes_[id];
        const auto [edge_before, outcome_before] = std::pair(copy.edge_before, copy.outcome);
        copy = node;
        copy.first_edge = static_cast<EdgeId>(kept.edges_.size());
        copy.edge_before = edge_before;  // of the nodes that lead here, which come first
        copy.outcome = outcome_before;
        for (const Edge& old : edges(node)) {
            Edge now = old;
            now.outcome_count = 0;
            for (Outcome outcome : outcomes(old)) {
                if (outcome.done == 0) continue;  // trials that were cut off have met it
                outcome.node = keep(outcome.node);
                Node& after = kept.nodes_[outcome.node];
                after.edge_before = static_cast<EdgeId>(kept.edges_.size());
                after.outcome = kept.append_outcome(after.edge_before, now, outcome);
            }
            kept.edges_.push_back(now);
            kept.arms_.push_back(arms_[id_of(old)]);
        }
    }
    *this = std::move(kept);
}

// The outcome's node may have another value now, and has been met once more. Other outcomes have
// those of the last trials that met them by this edge: a sum over all of them costs more than it
// tells.
void Tree::add_value_after(Edge& edge, Outcome& outcome) {
    const double before = outcome.done * outcome.value;
    outcome.done += 1;
    outcome.value = nodes_[outcome.node].value;
    edge.rests += outcome.done * outcome.value - before;
    if (std::isfinite(edge.rests)) return;
    edge.rests = 0;  // infinite values have no difference
    for (const Outcome& one : outcomes(edge))
        if (one.done > 0) edge.rests += one.done * one.value;
}

void Tree::back_up(NodeId id, EdgeId edge_id, std::uint32_t place, double reward, double rest) {
    Edge& edge = edges_[edge_id];
    Arm& arm = arms_[edge_id];
    Outcome& outcome = outcomes_[edge.first_outcome + place];
    edge.done += 1;
    edge.rewards += reward;
    if (backup_ == Backup::Max) {
        add_value_after(edge, outcome);
    } else {
        outcome.done += 1;
        edge.rests += rest;
    }
    const double before = arm.value, mass = edge.known_weight();
    const double sum = edge.rewards + discount_ * edge.rests;
    arm.value = (edge.estimates > 0 ? edge.estimate + sum : sum) / mass;
    Node& node = nodes_[id];
    const auto best = static_cast<std::int32_t>(edge_id - node.first_edge);
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
        const double part = edge.known_weight();
        if (part == 0) continue;
        sum += part * arms_[id_of(edge)].value;
        mass += part;
    }
    if (mass > 0) node.value = sum / mass;
}

}  // namespace rddlc::planners
