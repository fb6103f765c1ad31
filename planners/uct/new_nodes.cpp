// The values of new nodes of plan:uct, by continuations.
#include "planners/simulation/random_stream.hpp"
#include "planners/uct/uct.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rddlc::planners {

namespace {

// Draws of each action by which a state is known for one that nothing changes.
constexpr std::size_t lock_draws = 64;

}  // namespace

// Each action of each new node is tried, and the policy plays on: the actions of a node with the
// same stream. Or the policy alone plays on.
bool Uct::value_new_nodes(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter,
                          std::size_t draws) {
    asked_.clear();
    unchanged_.assign(new_nodes_.size(), 0);
    unchanged_rewards_.assign(new_nodes_.size(), 0);
    const bool by_policy = options_.initial == Initial::Rollout;
    for (std::size_t n = 0; n < new_nodes_.size(); ++n)
        for (std::size_t d = 0; d < draws; ++d) {
            const std::uint64_t draw = stream.bits();
            const Node& node = tree_.node(new_nodes_[n]);
            for (std::uint32_t e = 0; e < (by_policy ? 1 : node.edge_count); ++e)
                asked_.push_back({static_cast<NodeId>(n), node.first_edge + e, draw});
        }
    for (std::size_t first = 0; first < asked_.size(); first += continuations_.lanes()) {
        const std::size_t count = std::min(continuations_.lanes(), asked_.size() - first);
        starts_.clear();
        for (std::size_t k = first; k < first + count; ++k) {
            const NodeId id = new_nodes_[asked_[k].node];
            const Node& node = tree_.node(id);
            const std::uint32_t action = tree_.edge(asked_[k].edge).action;
            starts_.push_back(
                {tree_.state(id), step_ + node.depth, by_policy ? nullptr : actions_.record(action),
                 std::min(std::min(depth_ - node.depth, leaf_depth_),
                          std::max<std::int64_t>(
                              1, meter.steps_left() / static_cast<std::int64_t>(count))),
                 asked_[k].stream});
        }
        if (!meter.has_room(static_cast<std::int64_t>(count), 0)) return false;
        if (!continuations_.run(point, starts_, policies_[policy_], meter) &&
            continuations_.depth() == 0)
            return false;
        take_values(first, count);
    }
    for (std::size_t n = 0; n < new_nodes_.size(); ++n) {
        Node& node = tree_.node(new_nodes_[n]);
        node.is_open = true;
        if (!by_policy) tree_.value_node(node);
        if (by_policy || unchanged_[n] < draws * node.edge_count) continue;
        if (simulator_.problem->stochastic && !stays_unchanged(point, n, stream, meter)) continue;
        node.is_locked = true;
        node.value = 0;
        for (std::int64_t t = node.depth; t < depth_; ++t)
            node.value = unchanged_rewards_[n] + tree_.discount() * node.value;
    }
    return true;
}

// Whether it was no accident that no action has changed the state: each one is tried again, often.
bool Uct::stays_unchanged(const DecisionPoint& point, std::size_t n, RandomStream& stream,
                          BudgetMeter& meter) {
    const NodeId id = new_nodes_[n];
    const Node& node = tree_.node(id);
    const std::size_t all = lock_draws * node.edge_count;
    for (std::size_t first = 0; first < all; first += continuations_.lanes()) {
        starts_.clear();
        for (std::size_t k = first; k < std::min(all, first + continuations_.lanes()); ++k) {
            const auto edge = static_cast<EdgeId>(k % node.edge_count);
            starts_.push_back({tree_.state(id), step_ + node.depth,
                               actions_.record(tree_.edge(node.first_edge + edge).action), 1,
                               stream.bits()});
        }
        if (!meter.has_room(static_cast<std::int64_t>(starts_.size()), 0) ||
            !continuations_.run(point, starts_, policies_[policy_], meter))
            return false;
        for (std::size_t k = 0; k < starts_.size(); ++k)
            if (!is_unchanged(id, n, k)) return false;
    }
    return true;
}

// The value that continuation k found, which began in that node.
bool Uct::is_unchanged(NodeId id, std::size_t n, std::size_t k) const {
    return continuations_.first_reward(k) == unchanged_rewards_[n] &&
           std::memcmp(continuations_.first_state(k), tree_.state(id), state_size_) == 0;
}

void Uct::take_values(std::size_t first, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        const Asked& asked = asked_[first + k];
        const NodeId id = new_nodes_[asked.node];
        if (options_.initial == Initial::Rollout) {
            Node& node = tree_.node(id);
            node.draws += 1;
            node.value += (value_of(k) - node.value) / node.draws;
            continue;
        }
        Edge& edge = tree_.edge(asked.edge);
        edge.estimates += 1;
        edge.estimate += (value_of(k) - edge.estimate) / edge.estimates;
        edge.value = edge.estimate;
        if (id == root_) note_return(value_of(k));
        if (unchanged_[asked.node] == 0)
            unchanged_rewards_[asked.node] = continuations_.first_reward(k);
        unchanged_[asked.node] += is_unchanged(id, asked.node, k);
    }
}

// The value of continuation k. If it was cut off, the reward of its last step is assumed to
// continue.
double Uct::value_of(std::size_t k) const {
    const double value = continuations_.value(k);
    const std::int64_t made = starts_[k].depth;
    const std::int64_t left = depth_ - (starts_[k].step - step_) - made;
    if (left <= 0 || !continuations_.is_cut(k)) return value;
    double rest = 0, weight = std::pow(tree_.discount(), static_cast<double>(made));
    for (std::int64_t t = 0; t < left; ++t, weight *= tree_.discount())
        rest += weight * continuations_.last_reward(k);
    return value + rest;
}

}  // namespace rddlc::planners
