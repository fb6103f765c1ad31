// The values of new nodes of plan:uct, in the determinised problem or by continuations.
#include "planners/simulation/random_stream.hpp"
#include "planners/uct/uct.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc::planners {

namespace {

// Draws of each action by which a state is known for one that nothing changes.
constexpr std::size_t lock_draws = 64;
// The part of the priors that the policy's likeliest action has by itself. A policy that learns
// still tries other actions more often than they are worth.
constexpr float likeliest_share = 0.5f;

}  // namespace

bool Uct::value_new_nodes(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter,
                          std::size_t draws) {
    const bool is_done = is_determinised() ? value_by_determinisation(point, stream, meter)
                         : state_values_   ? value_by_network(meter)
                                           : value_by_policy(point, stream, meter, draws);
    if (!is_done || options_.policy.empty()) return is_done;
    if (is_determinised())  // their edges are for the priors
        for (const NodeId id : new_nodes_)
            if (!tree().node(id).is_locked) open_edges(id);
    return find_priors(point, stream, meter);
}

template <class Judge>
bool Uct::judge_new_nodes(BudgetMeter& meter, const Judge& judge) {
    const auto lanes = static_cast<std::size_t>(judged_->count());
    judged_states_.resize(lanes * state_size_);
    judged_steps_.resize(lanes);
    for (std::size_t first = 0; first < new_nodes_.size(); first += lanes) {
        if (meter.is_late()) return false;
        const std::size_t count = std::min(lanes, new_nodes_.size() - first);
        for (std::size_t k = 0; k < count; ++k) {
            const NodeId id = new_nodes_[first + k];
            std::copy_n(tree().state(id), state_size_, judged_states_.data() + k * state_size_);
            judged_steps_[k] = tree().node(id).step;
        }
        solvers::require_done(
            simulator_, simulator_.set_state(judged_->batch(), 0, static_cast<std::int64_t>(count),
                                             judged_states_.data(), nullptr));
        judge(first, count, std::span<const std::int64_t>(judged_steps_).first(count));
    }
    return true;
}

bool Uct::value_by_network(BudgetMeter& meter) {
    judged_values_.resize(static_cast<std::size_t>(judged_->count()));
    return judge_new_nodes(
        meter, [&](std::size_t first, std::size_t count, std::span<const std::int64_t> steps) {
            state_values_(judged_->batch(), steps, judged_values_.data());
            for (std::size_t k = 0; k < count; ++k) {
                Node& node = tree().node(new_nodes_[first + k]);
                node.is_open = true;
                node.is_locked = node.step >= end_;
                node.draws = 1;
                node.value = judged_values_[k];
                if (new_nodes_[first + k] == root_) note_return(node.value);
            }
        });
}

bool Uct::find_priors(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    if (!priors_) return find_preferred(point, stream, meter);
    prior_rows_.resize(static_cast<std::size_t>(judged_->count()) * actions_.count());
    return judge_new_nodes(
        meter, [&](std::size_t first, std::size_t count, std::span<const std::int64_t> steps) {
            priors_(judged_->batch(), steps, prior_rows_.data());
            for (std::size_t k = 0; k < count; ++k)
                set_priors(tree().node(new_nodes_[first + k]),
                           prior_rows_.data() + k * actions_.count());
        });
}

// By logarithms of all actions, of which the node has some.
void Uct::set_priors(Node& node, const float* logarithms) {
    const auto edges = tree().edges(node);
    const auto firsts = tree().first_values(node);
    float most = -std::numeric_limits<float>::infinity(), sum = 0;
    std::size_t likeliest = 0;  // one alone, also where several are as likely
    for (std::size_t e = 0; e < edges.size(); ++e)
        if (e == 0 || logarithms[edges[e].action] > most) {
            likeliest = e;
            most = logarithms[edges[e].action];
        }
    for (std::size_t e = 0; e < edges.size(); ++e)
        sum += firsts[e].prior = std::exp(logarithms[edges[e].action] - most);
    for (std::size_t e = 0; e < edges.size(); ++e)
        firsts[e].prior =
            (1 - likeliest_share) * firsts[e].prior / sum + (e == likeliest ? likeliest_share : 0);
    node.has_priors = !edges.empty();
}

// The policy's action has half of the prior, and all share the rest.
bool Uct::find_preferred(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    for (std::size_t first = 0; first < new_nodes_.size(); first += continuations_.lanes()) {
        const std::size_t count = std::min(continuations_.lanes(), new_nodes_.size() - first);
        starts_.clear();
        for (std::size_t k = first; k < first + count; ++k)
            starts_.push_back({tree().state(new_nodes_[k]), tree().node(new_nodes_[k]).step,
                               nullptr, 1, stream.bits()});
        if (!meter.has_room(static_cast<std::int64_t>(count), 0) ||
            !continuations_.run(point, starts_, policies_[policy_], meter))
            return false;
        for (std::size_t k = 0; k < count; ++k) {
            Node& node = tree().node(new_nodes_[first + k]);
            const std::byte* const record = continuations_.first_action(k);
            for (const Edge& edge : tree().edges(node)) {
                const bool is_its =
                    std::equal(record, record + action_size_, actions_.record(edge.action));
                tree().first_values(node)[tree().id_of(edge) - node.first_edge].prior =
                    (1 - likeliest_share) / static_cast<float>(node.edge_count) +
                    (is_its ? likeliest_share : 0);
                node.has_priors |= is_its;
            }
        }
    }
    return true;
}

bool Uct::value_by_determinisation(const DecisionPoint& point, RandomStream& stream,
                                   BudgetMeter& meter) {
    DeterminisedProblem& determinised = memory_->determinised;
    determinised_states_.clear();
    for (const NodeId id : new_nodes_)
        determinised_states_.push_back(determinised.state_of(tree().state(id)));
    if (!determinised.open(determinised_states_, *typical_steps_, meter)) return false;
    if (!find_later_rewards(point, stream, meter)) return false;
    for (std::size_t n = 0; n < new_nodes_.size(); ++n) {
        Node& node = tree().node(new_nodes_[n]);
        node.is_open = true;
        node.state = determinised_states_[n];
        node.epoch = memory_->epoch;
        node.value = value_of_moves(node);
        lock_where_it_stays(point, n, stream, meter);
    }
    return true;
}

// As the node's edges will have it.
double Uct::value_of_moves(const Node& node) {
    double best = -std::numeric_limits<double>::infinity(), sum = 0;
    const auto moves = memory_->determinised.moves(node.state);
    for (const auto& move : moves) {
        const double value = estimate(move, node);
        best = std::max(best, value);
        sum += value;
    }
    return options_.backup == Backup::Max ? best : sum / static_cast<double>(moves.size());
}

void Uct::open_edges(NodeId id) {
    Node& node = tree().node(id);
    if (node.edge_count > 0) return;
    for (const auto& move : memory_->determinised.moves(node.state)) add_move(id, move);
    node.twins_at = twins_at(node.state);
    tree().value_node(node);
}

void Uct::add_move(NodeId id, const DeterminisedProblem::Move& move) {
    const EdgeId edge = tree().add_edge(id, move.action);
    tree().add_estimate(id, edge, estimate(move, tree().node(id)));
}

// New node n is locked if its state stays in the determinised problem, and draws confirm it. Where
// the budget does not last for these draws, a later decision may make them.
void Uct::lock_where_it_stays(const DecisionPoint& point, std::size_t n, RandomStream& stream,
                              BudgetMeter& meter) {
    DeterminisedProblem& determinised = memory_->determinised;
    const auto state = determinised_states_[n];
    if (!determinised.stays(state)) return;
    const double reward = determinised.moves(state).front().reward;
    if (simulator_.problem->stochastic && !determinised.is_confirmed(state)) {
        unchanged_rewards_.resize(new_nodes_.size());
        unchanged_rewards_[n] = reward;
        drawn_actions_.clear();
        for (const auto& moves : {determinised.moves(state), determinised.twins(state)})
            for (const auto& move : moves) drawn_actions_.push_back(move.action);
        const std::optional<bool> stays = stays_unchanged(point, n, stream, meter);
        if (!stays) return;
        determinised.confirm(state, *stays);
    }
    if (determinised.stays(state)) lock(tree().node(new_nodes_[n]), reward);
}

// A decision before may have had no budget left for it.
void Uct::confirm_root(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    if (!is_determinised() || tree().node(root_).is_locked) return;
    new_nodes_.assign(1, root_);
    determinised_states_.assign(1, memory_->determinised.state_of(tree().state(root_)));
    lock_where_it_stays(point, 0, stream, meter);
}

// The lookahead, and the mean reward of the policy from its end to that of the search.
double Uct::estimate(const DeterminisedProblem::Move& move, const Node& node) {
    DeterminisedProblem& determinised = memory_->determinised;
    const std::int64_t left = end_ - node.step;
    const std::int64_t depth = std::min(left, determinised.depth());
    const auto course = determinised.after(move, depth);
    if (course.end == DeterminisedProblem::over || left == depth) return course.value;
    return course.value + std::pow(tree().discount(), static_cast<double>(depth)) *
                              discounted_steps(left - depth) *
                              determinised.later(course.end, policy_);
}

// The discounted sum of a reward of 1 in each of so many steps.
double Uct::discounted_steps(std::int64_t steps) const {
    const double discount = tree().discount();
    return discount == 1 ? static_cast<double>(steps)
                         : (1 - std::pow(discount, static_cast<double>(steps))) / (1 - discount);
}

// The ends of lookaheads from new nodes whose later rewards are not known.
void Uct::find_ends() {
    DeterminisedProblem& determinised = memory_->determinised;
    ends_.clear();
    for (std::size_t n = 0; n < new_nodes_.size(); ++n) {
        if (end_ - tree().node(new_nodes_[n]).step <= determinised.depth()) continue;
        for (const auto& move : determinised.moves(determinised_states_[n])) {
            const auto end = determinised.after(move, determinised.depth()).end;
            if (end == DeterminisedProblem::over || !std::isnan(determinised.later(end, policy_)))
                continue;
            determinised.later(end, policy_) =
                determinised.stays(end) ? determinised.moves(end).front().reward : 0;
            if (!determinised.stays(end)) ends_.push_back(end);
        }
    }
}

bool Uct::find_later_rewards(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    find_ends();
    DeterminisedProblem& determinised = memory_->determinised;
    const std::int64_t depth = std::min(later_steps, end_ - step_);
    const std::size_t draws = simulator_.problem->stochastic ? later_draws : 1;
    const std::size_t some = std::max<std::size_t>(1, continuations_.lanes() / draws);
    for (std::size_t first = 0; first < ends_.size(); first += some) {
        const std::size_t count = std::min(some, ends_.size() - first);
        starts_.clear();
        for (std::size_t k = 0; k < count * draws; ++k)
            starts_.push_back({determinised.record(ends_[first + k / draws]), step_, nullptr, depth,
                               stream.bits()});
        if (!meter.has_room(static_cast<std::int64_t>(starts_.size()) * depth, 0) ||
            !continuations_.run(point, starts_, policies_[policy_], meter)) {
            for (std::size_t k = first; k < ends_.size(); ++k)
                determinised.later(ends_[k], policy_) = std::numeric_limits<double>::quiet_NaN();
            return false;
        }
        for (std::size_t k = 0; k < starts_.size(); ++k)
            determinised.later(ends_[first + k / draws], policy_) +=
                continuations_.value(k) / discounted_steps(depth) / static_cast<double>(draws);
    }
    return true;
}

// Each action of each new node is tried, and the policy plays on: the actions of a node with the
// same stream. Or the policy alone plays on.
bool Uct::value_by_policy(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter,
                          std::size_t draws) {
    asked_.clear();
    unchanged_.assign(new_nodes_.size(), 0);
    unchanged_rewards_.assign(new_nodes_.size(), 0);
    const bool by_policy = initial_ == Initial::Rollout;
    for (std::size_t n = 0; n < new_nodes_.size(); ++n)
        for (std::size_t d = 0; d < draws; ++d) {
            const std::uint64_t draw = stream.bits();
            const Node& node = tree().node(new_nodes_[n]);
            for (std::uint32_t e = 0; e < (by_policy ? 1 : node.edge_count); ++e)
                asked_.push_back({static_cast<NodeId>(n), node.first_edge + e, draw});
        }
    for (std::size_t first = 0; first < asked_.size(); first += continuations_.lanes()) {
        const std::size_t count = std::min(continuations_.lanes(), asked_.size() - first);
        starts_.clear();
        for (std::size_t k = first; k < first + count; ++k) {
            const NodeId id = new_nodes_[asked_[k].node];
            const Node& node = tree().node(id);
            const std::uint32_t action = tree().edge(asked_[k].edge).action;
            starts_.push_back(
                {tree().state(id), node.step, by_policy ? nullptr : actions_.record(action),
                 std::min(std::min(end_ - node.step, memory_->leaf_depth),
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
        Node& node = tree().node(new_nodes_[n]);
        node.is_open = true;
        if (!by_policy) tree().value_node(node);
        if (by_policy || unchanged_[n] < draws * node.edge_count) continue;
        drawn_actions_.clear();
        for (const Edge& edge : tree().edges(node)) drawn_actions_.push_back(edge.action);
        if (simulator_.problem->stochastic &&
            !stays_unchanged(point, n, stream, meter).value_or(false))
            continue;
        lock(node, unchanged_rewards_[n]);
    }
    return true;
}

// The value is that of this reward in each step.
void Uct::lock(Node& node, double reward) {
    node.is_locked = true;
    node.value = 0;
    for (std::int64_t t = node.step; t < end_; ++t)
        node.value = reward + tree().discount() * node.value;
}

// Whether it was no accident that no action has changed the state: each of drawn_actions_ is tried
// again, often.
// Nothing: the budget does not last.
std::optional<bool> Uct::stays_unchanged(const DecisionPoint& point, std::size_t n,
                                         RandomStream& stream, BudgetMeter& meter) {
    const NodeId id = new_nodes_[n];
    const Node& node = tree().node(id);
    const std::size_t all = lock_draws * drawn_actions_.size();
    for (std::size_t first = 0; first < all; first += continuations_.lanes()) {
        starts_.clear();
        for (std::size_t k = first; k < std::min(all, first + continuations_.lanes()); ++k) {
            const std::uint32_t action = drawn_actions_[k % drawn_actions_.size()];
            starts_.push_back(
                {tree().state(id), node.step, actions_.record(action), 1, stream.bits()});
        }
        if (!meter.has_room(static_cast<std::int64_t>(starts_.size()), 0) ||
            !continuations_.run(point, starts_, policies_[policy_], meter))
            return std::nullopt;
        for (std::size_t k = 0; k < starts_.size(); ++k)
            if (!is_unchanged(id, n, k)) return false;
    }
    return true;
}

// The value that continuation k found, which began in that node.
bool Uct::is_unchanged(NodeId id, std::size_t n, std::size_t k) const {
    return continuations_.first_reward(k) == unchanged_rewards_[n] &&
           std::memcmp(continuations_.first_state(k), tree().state(id), state_size_) == 0;
}

void Uct::take_values(std::size_t first, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        const Asked& asked = asked_[first + k];
        const NodeId id = new_nodes_[asked.node];
        if (initial_ == Initial::Rollout) {
            Node& node = tree().node(id);
            node.draws += 1;
            node.value += (value_of(k) - node.value) / node.draws;
            continue;
        }
        tree().add_estimate(id, asked.edge, value_of(k));
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
    const std::int64_t left = end_ - starts_[k].step - made;
    if (left <= 0 || !continuations_.is_cut(k)) return value;
    double rest = 0, weight = std::pow(tree().discount(), static_cast<double>(made));
    for (std::int64_t t = 0; t < left; ++t, weight *= tree().discount())
        rest += weight * continuations_.last_reward(k);
    return value + rest;
}

}  // namespace rddlc::planners
