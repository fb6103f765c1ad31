#include "planners/uct/history_search.hpp"

#include "planners/planner/beliefs.hpp"
#include "planners/simulation/record_hash.hpp"
#include "planners/uct/search_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rddlc::planners {

using solvers::require_done;

namespace {

// The part of the memory limit that the tree of an episode may take.
constexpr std::size_t memory_share = 32;
// Deviations of actions near the best one, in half widths of bounds: one after the other.
constexpr double near_spreads[] = {0.5, 0.1};

std::int64_t affordable_trials(const UctOptions& options) {
    constexpr std::int64_t least_rounds = 4;
    return std::clamp<std::int64_t>(
        options.budget.steps.value_or(most_steps) / (least_rounds * usual_depth), 1, options.lanes);
}

}  // namespace

HistorySearch::HistorySearch(const PlannerContext& context, const UctOptions& options)
    : simulator_(context.simulator),
      options_(options),
      sees_state_(context.sees_state),
      state_size_(static_cast<std::size_t>(simulator_.problem->state_size)),
      action_size_(static_cast<std::size_t>(simulator_.problem->action_size)),
      observation_size_(static_cast<std::size_t>(simulator_.problem->observation_size)),
      space_(solvers::action_space(simulator_)),
      records_(simulator_),
      listed_(FiniteActions::of(simulator_, space_, static_cast<std::size_t>(options.actions))),
      sampler_(space_, records_),
      futures_(simulator_, affordable_trials(options), context.horizon),
      legal_(simulator_, space_, records_, futures_.count()),
      most_bytes_(static_cast<std::size_t>(context.memory_limit) / memory_share),
      memories_(context.environments),
      trials_(futures_.running().size()),
      plays_on_(trials_.size()),
      streams_(trials_.size()),
      actions_(trials_.size() * action_size_),
      records_after_(trials_.size() * (sees_state_ ? state_size_ : observation_size_)),
      record_(std::max(action_size_, state_size_)) {
    if (context.base) {
        policies_.emplace_back(simulator_, *context.base, futures_.count());
    } else {
        policies_.emplace_back(simulator_, solvers::noop_policy(simulator_), futures_.count());
        policies_.emplace_back(simulator_, solvers::random_policy(simulator_, options.seed),
                               futures_.count());
    }
}

void HistorySearch::decide(const DecisionPoint& point, std::byte* action,
                           Explanation* explanation) {
    RandomStream stream(options_.seed, point.episode, point.step);
    BudgetMeter meter(options_.budget, point.stops, point.share, point.steps_spent);
    try {
        open_root(point);
        choose_policy(point, stream, meter);
        const auto lanes = static_cast<std::int64_t>(trials_.size());
        while (meter.has_room(lanes * depth_, 0) && tree().bytes() <= most_bytes_ &&
               run_trials(point, stream, meter)) {
        }
        const Id best = best_edge(root_), chosen = is_policy_better(best) ? 0 : best;
        const std::byte* const without =
            point.base_action ? point.base_action : records_.default_record().data();
        std::copy_n(chosen ? tree().action(chosen) : without, action_size_, actions_.data());
        streams_.front() = stream.bits();
        futures_.begin(point.origin, streams_);
        legal_.make_legal(futures_.batch(), actions_.data());
        std::copy_n(actions_.data(), action_size_, action);
        found_ = {chosen != 0      ? tree().edge(chosen).value
                  : policy_return_ ? policy_return_->mean
                                   : 0,
                  depth_, chosen == 0 && policies_.size() > 1, best != 0};
        if (explanation) note_explanation(*explanation, chosen, meter);
        if (tree().bytes() > most_bytes_ / 2) tree().clear();
    } catch (...) {
        memories_.of(point).reset();  // the tree may be half made
        throw;
    }
}

// The tree of the decision before is kept, if it looks far enough ahead.
void HistorySearch::open_root(const DecisionPoint& point) {
    auto& memory = memories_.of(point);
    if (!memory) memory = Memory{HistoryTree(action_size_, sees_state_ ? state_size_ : 0)};
    memory_ = &*memory;
    step_ = point.step;
    const std::int64_t wanted = options_.horizon.value_or(usual_depth);
    const std::int64_t end = end_of_search(step_, point.left, wanted, memory->end);
    if (end != memory->end) tree().clear();
    memory->end = end;
    depth_ = end - step_;
    std::uint64_t key = point.history;
    if (sees_state_) {
        require_done(simulator_, simulator_.get_state(point.origin.batch, point.origin.first, 1,
                                                      record_.data()));
        key = key_of_state(record_.data(), step_);
    }
    root_ = tree().node_of(key, record_.data());
    if (listed_) listed_->find_legal(point.origin, legal_at_root_);
    least_ = std::numeric_limits<double>::infinity();
    most_ = -least_;
}

// The one with the greatest return from here on plays on from leaves.
void HistorySearch::choose_policy(const DecisionPoint& point, RandomStream& stream,
                                  BudgetMeter& meter) {
    policy_ = 0;
    policy_return_.reset();
    // Not more than a part of the budget goes there.
    constexpr std::int64_t parts = 7;
    const auto lanes = static_cast<std::int64_t>(trials_.size());
    const auto count = static_cast<std::int64_t>(policies_.size());
    if (!meter.has_room(parts * lanes * depth_ * count, 0)) return;
    std::size_t chosen = 0;
    for (policy_ = 0; policy_ < policies_.size(); ++policy_) {
        const auto found = return_of_policy(point, stream, meter);
        if (!found) break;
        if (policy_return_ && found->mean <= policy_return_->mean) continue;
        policy_return_ = found;
        chosen = policy_;
    }
    policy_ = chosen;
}

// Nothing where time is up.
std::optional<MeanAndError> HistorySearch::return_of_policy(const DecisionPoint& point,
                                                            RandomStream& stream,
                                                            BudgetMeter& meter) {
    begin_trials(point, stream);
    for (Trial& trial : trials_) trial.node = 0;
    for (std::int64_t t = 0; t < depth_ && futures_.any_running(); ++t) {
        choose_actions(point, stream);
        if (meter.is_late()) return std::nullopt;
        futures_.step(actions_.data());
        meter.add_steps(futures_.stepped());
    }
    return mean_and_error(trials_.size(), [&](std::size_t k) { return futures_.value(k); });
}

// The means of actions are of all that was tried after them. Where each costs something, they are
// worse than what no-op or the given policy returns.
bool HistorySearch::is_policy_better(Id best) const {
    const bool is_random = policy_ == 1;
    return best != 0 && policy_return_ && !is_random &&
           policy_return_->mean - policy_return_->error > tree().edge(best).value;
}

void HistorySearch::begin_trials(const DecisionPoint& point, RandomStream& stream) {
    for (std::uint64_t& each : streams_) each = stream.bits();
    futures_.begin(point.origin, streams_);
    policies_[policy_].begin(point.episode, step_, point.horizon, streams_);
    for (Trial& trial : trials_) {
        trial.node = root_;
        trial.hops.clear();
    }
}

bool HistorySearch::run_trials(const DecisionPoint& point, RandomStream& stream,
                               BudgetMeter& meter) {
    begin_trials(point, stream);
    for (std::int64_t t = 0; t < depth_ && futures_.any_running(); ++t) {
        choose_actions(point, stream);
        if (t % 4 == 0 && meter.is_late()) {
            give_up();
            return false;
        }
        futures_.step(actions_.data());
        meter.add_steps(futures_.stepped());
        follow(t + 1, stream);
    }
    back_up();
    meter.add_iterations(static_cast<std::int64_t>(trials_.size()));
    return true;
}

// Trials in the tree act by its values, the others by the policy.
void HistorySearch::choose_actions(const DecisionPoint& point, RandomStream& stream) {
    for (std::size_t k = 0; k < trials_.size(); ++k) plays_on_[k] = trials_[k].node == 0;
    policies_[policy_].act(futures_, plays_on_, actions_.data(), point.stops);
    for (std::size_t k = 0; k < trials_.size(); ++k) {
        Trial& trial = trials_[k];
        if (trial.node == 0) continue;
        const Id edge = may_widen(trial.node) ? widen(trial.node, stream) : choose_edge(trial.node);
        tree().node(trial.node).started += 1;
        tree().edge(edge).started += 1;
        trial.hops.push_back({trial.node, edge, futures_.value(k)});
        std::copy_n(tree().action(edge), action_size_, actions_.data() + k * action_size_);
    }
    legal_.make_legal(futures_.batch(), actions_.data());
}

// Follows the environments of trials in the tree to the nodes where they are now.
void HistorySearch::follow(std::int64_t made, RandomStream& stream) {
    if (std::ranges::all_of(trials_, [](const Trial& trial) { return trial.node == 0; })) return;
    require_done(simulator_, (sees_state_ ? simulator_.get_state : simulator_.get_observation)(
                                 futures_.batch(), 0, futures_.count(), records_after_.data()));
    const std::int64_t step = step_ + made;
    for (std::size_t k = 0; k < trials_.size(); ++k) {
        Trial& trial = trials_[k];
        if (trial.node == 0) continue;
        const Id edge = trial.hops.back().edge;
        const std::uint64_t key = key_after(k, trial.node, step);
        trial.node = 0;
        if (!futures_.is_running(k)) continue;
        const Id known = tree().find(key);
        const HistoryTree::Edge& of = tree().edge(edge);
        const bool is_full = has_all_outcomes(options_, of.started, of.outcomes);
        if (known != 0) {
            trial.node = known;
        } else if (is_full) {
            trial.node = tree().seen_outcome(edge, stream.unit());
            if (sees_state_ && trial.node != 0)
                require_done(simulator_,
                             simulator_.set_state(futures_.batch(), static_cast<std::int64_t>(k), 1,
                                                  tree().state(trial.node), &step));
        } else {
            // A leaf: what follows is played by the policy.
            tree().add_outcome(edge, tree().node_of(key, record_after(k)));
            continue;
        }
        if (trial.node != 0) tree().add_outcome(edge, trial.node);
    }
}

std::uint64_t HistorySearch::key_of_state(const std::byte* state, std::int64_t step) const {
    return hash_of(state, state_size_, static_cast<std::uint64_t>(step));
}

std::uint64_t HistorySearch::key_after(std::size_t lane, Id node, std::int64_t step) const {
    if (sees_state_) return key_of_state(record_after(lane), step);
    return next_history(*simulator_.problem, tree().node(node).key,
                        actions_.data() + lane * action_size_, record_after(lane));
}

const std::byte* HistorySearch::record_after(std::size_t lane) const {
    return records_after_.data() + lane * (sees_state_ ? state_size_ : observation_size_);
}

// Time was up: the trials count for nothing.
void HistorySearch::give_up() {
    for (const Trial& trial : trials_)
        for (const Trial::Hop& hop : trial.hops) {
            tree().node(hop.node).started -= 1;
            tree().edge(hop.edge).started -= 1;
        }
}

void HistorySearch::back_up() {
    for (std::size_t k = 0; k < trials_.size(); ++k) {
        const Trial& trial = trials_[k];
        const double all = futures_.value(k);
        double weight = 1;
        for (const Trial::Hop& hop : trial.hops) {
            HistoryTree::Edge& edge = tree().edge(hop.edge);
            const double value = std::max((all - hop.before) / weight, -1e300);
            edge.done += 1;
            edge.value += (value - edge.value) / edge.done;
            weight *= simulator_.problem->discount;
        }
        if (!std::isfinite(all)) continue;
        least_ = std::min(least_, all);
        most_ = std::max(most_, all);
    }
}

// As many actions as are listed, or so many as visits allow.
bool HistorySearch::may_widen(Id id) const {
    const HistoryTree::Node& node = tree().node(id);
    if (listed_) return static_cast<std::size_t>(node.edges) < listed_->count();
    return node.edges < std::ceil(options_.width * std::pow(node.started + 1, options_.widening));
}

HistorySearch::Id HistorySearch::widen(Id node, RandomStream& stream) {
    if (listed_) return add_listed(node);
    const std::int32_t number = tree().node(node).edges;
    const Id best = best_edge(node);
    if (number == 0)
        std::ranges::copy(records_.default_record(), record_.begin());
    else if (number % 2 == 0 && best != 0)
        sampler_.draw_near(tree().action(best), near_spreads[number / 2 % std::size(near_spreads)],
                           stream, record_.data());
    else
        sampler_.draw(stream, record_.data());
    return tree().add_edge(node, record_.data());
}

// The next one of the list, which begins at another place in each node. At the root, which was
// another node before, it is the first legal one that the root does not have: a repair makes others
// of those that are illegal.
HistorySearch::Id HistorySearch::add_listed(Id node) {
    const std::size_t count = listed_->count();
    const auto number = static_cast<std::size_t>(tree().node(node).edges);
    std::size_t action = (tree().node(node).key + number) % count;
    if (node == root_) {
        for (action = 0; action < count; ++action)
            if (legal_at_root_[action] && !has_edge(node, listed_->record(action))) break;
        if (action == count) return choose_edge(node);
    }
    return tree().add_edge(node, listed_->record(action));
}

bool HistorySearch::has_edge(Id node, const std::byte* action) const {
    for (Id edge = tree().node(node).first_edge; edge != 0; edge = tree().edge(edge).next)
        if (std::equal(action, action + action_size_, tree().action(edge))) return true;
    return false;
}

// UCB1, where trials under way count as tried.
HistorySearch::Id HistorySearch::choose_edge(Id id) {
    const HistoryTree::Node& node = tree().node(id);
    const double range = range_of_returns(least_, most_);
    const double scale = std::max(options_.exploration.value_or(usual_exploration) * range, 1e-9) *
                         std::sqrt(std::log(static_cast<double>(node.started) + 1));
    Id chosen = node.first_edge;
    double best = -std::numeric_limits<double>::infinity();
    for (Id e = node.first_edge; e != 0; e = tree().edge(e).next) {
        const HistoryTree::Edge& edge = tree().edge(e);
        if (edge.started == 0) return e;
        const double bound = edge.value + scale / std::sqrt(edge.started);
        if (!(bound > best)) continue;
        best = bound;
        chosen = e;
    }
    return chosen;
}

HistorySearch::Id HistorySearch::best_edge(Id node) const {
    std::int32_t most = 0;
    for (Id e = tree().node(node).first_edge; e != 0; e = tree().edge(e).next)
        most = std::max(most, tree().edge(e).done);
    Id chosen = 0;
    for (Id e = tree().node(node).first_edge; e != 0; e = tree().edge(e).next) {
        const HistoryTree::Edge& edge = tree().edge(e);
        if (edge.done == 0 || edge.done < least_tried * most) continue;
        if (chosen == 0 || edge.value > tree().edge(chosen).value) chosen = e;
    }
    return chosen;
}

void HistorySearch::note_explanation(Explanation& explanation, Id chosen,
                                     const BudgetMeter& meter) {
    explanation.depth = depth_;
    explanation.iterations = meter.iterations();
    explanation.steps = meter.steps();
    if (chosen == 0) {
        explanation.candidates.push_back(
            {policies_.size() == 1 ? "policy" : "noop",
             {actions_.begin(), actions_.begin() + static_cast<std::ptrdiff_t>(action_size_)}});
        if (policy_return_) {
            explanation.candidates.back().value = policy_return_->mean;
            explanation.candidates.back().error = policy_return_->error;
            explanation.candidates.back().trials = static_cast<std::int64_t>(trials_.size());
        }
        if (best_edge(root_) == 0) {
            explanation.note = "the budget did not last for a trial";
            return;
        }
    }
    for (Id e = tree().node(root_).first_edge; e != 0; e = tree().edge(e).next) {
        if (e == chosen) explanation.chosen = explanation.candidates.size();
        const std::byte* const record = tree().action(e);
        explanation.candidates.push_back({"action",
                                          {record, record + action_size_},
                                          tree().edge(e).value,
                                          0,
                                          tree().edge(e).done});
    }
}

}  // namespace rddlc::planners
