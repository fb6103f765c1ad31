// Over 400 lines: one search, from what its options allow to what it explains.
#include "planners/uct/uct.hpp"

#include "planners/simulation/random_stream.hpp"
#include "planners/uct/search_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rddlc::planners {

namespace {

// The depth where new states are valued to the end of the episode, since the search ends with 0.
constexpr std::int64_t value_depth = 200;
// Steps of a lookahead in the determinised problem, at most.
constexpr std::int64_t deepest_lookahead = 100;
// A budget of steps lasts for so many lookaheads.
constexpr std::int64_t least_lookaheads = 10;
// Environments in which leaves are valued together, at most.
constexpr std::int64_t most_leaf_lanes = 1024;
// Draws that the policy is chosen by, each of all of its steps.
constexpr std::size_t policy_draws = 32;
// Steps by which new states are valued where more of them show nothing.
constexpr std::int64_t short_leaf = 2;
// Draws for each action of the root.
constexpr std::size_t root_draws = 8;
// The parts of the memory limit that the memory of an episode may have in a decision, and after it.
// They depend neither on threads nor on the batch, so that decisions do not either.
constexpr std::size_t decision_share = 16;
constexpr std::size_t kept_share = 64;

// A tree of so many bytes is freed of what the decision has made unreachable.
constexpr std::size_t most_garbage = std::size_t{64} << 20;

std::optional<FiniteActions> finite_actions(const rddl_simulator& simulator, int most) {
    return FiniteActions::of(simulator, solvers::action_space(simulator),
                             static_cast<std::size_t>(most));
}

std::int64_t affordable_lanes(const UctOptions& options, std::int64_t wanted) {
    return std::clamp<std::int64_t>(options.budget.steps.value_or(most_steps) / 160, 1, wanted);
}

// Whether the determinised problem values new states in a small part of the budget. Each action
// takes a typical step, and the draws of what follows.
bool may_determinise(const UctOptions& options, std::size_t actions) {
    constexpr std::size_t most_actions = 64;
    constexpr std::int64_t least_states = 4;
    constexpr std::int64_t steps_of_action =
        1 + static_cast<std::int64_t>(later_draws) * later_steps;
    const std::int64_t steps = static_cast<std::int64_t>(actions) * steps_of_action;
    return actions <= most_actions &&
           options.budget.steps.value_or(most_steps) >= least_states * steps;
}

Initial initial_of(const PlannerContext& context, const UctOptions& options, std::size_t actions) {
    if (options.initial) return *options.initial;
    if (context.base) return context.base->values ? Initial::Value : Initial::Lookahead;
    return may_determinise(options, actions) ? Initial::Determinised : Initial::Rollout;
}

std::int64_t leaf_lanes(const UctOptions& options, Initial initial, std::size_t actions) {
    const auto each = static_cast<std::int64_t>(initial == Initial::Lookahead ? actions : 4);
    return std::clamp<std::int64_t>(affordable_lanes(options, options.lanes) * each, 1,
                                    most_leaf_lanes);
}

}  // namespace

bool Uct::can_list_actions(const rddl_simulator& simulator, const UctOptions& options) {
    return finite_actions(simulator, options.actions).has_value();
}

Uct::Uct(const PlannerContext& context, const UctOptions& options)
    : simulator_(context.simulator),
      options_(options),
      state_size_(static_cast<std::size_t>(simulator_.problem->state_size)),
      action_size_(static_cast<std::size_t>(simulator_.problem->action_size)),
      actions_(finite_actions(simulator_, options.actions).value()),
      initial_(initial_of(context, options, actions_.count())),
      trees_(simulator_, affordable_lanes(options, options.lanes), context.horizon),
      continuations_(simulator_, leaf_lanes(options, initial_, actions_.count()), context.horizon,
                     true),
      discount_(initial_ == Initial::Value ? context.base->value_discount
                                           : simulator_.problem->discount),
      exploration_(options.exploration.value_or(initial_ == Initial::Value ? exploration_by_values
                                                                           : usual_exploration)),
      most_bytes_(static_cast<std::size_t>(context.memory_limit) / decision_share),
      most_kept_bytes_(static_cast<std::size_t>(context.memory_limit) / kept_share),
      memories_(context.environments),
      trials_(trees_.running().size()),
      streams_(trials_.size()),
      keys_(trials_.size()),
      known_(trials_.size()),
      rests_(trials_.size()),
      records_(trials_.size() * action_size_),
      states_(trials_.size() * state_size_) {
    const auto lanes = static_cast<std::int64_t>(continuations_.lanes());
    if (is_determinised()) typical_steps_.emplace(simulator_, actions_);
    if (context.base) {
        policies_.emplace_back(simulator_, *context.base, lanes);
        if (context.base->priors) priors_ = context.base->priors(lanes, actions_.records());
        if (initial_ == Initial::Value) state_values_ = context.base->values(lanes);
        if (priors_ || state_values_) judged_.emplace(simulator_, lanes, context.horizon);
    } else {
        policies_.emplace_back(simulator_, solvers::noop_policy(simulator_), lanes);
        policies_.emplace_back(simulator_, solvers::random_policy(simulator_, options.seed), lanes);
    }
}

// Chooses the one with the greatest return from here on.
void Uct::choose_policy(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    policy_ = 0;
    const std::size_t draws = std::min(policy_draws, continuations_.lanes());
    const auto cost = static_cast<std::int64_t>(draws * policies_.size()) * (end_ - step_);
    // A tenth of the budget may go there.
    if (policies_.size() == 1 || !meter.has_room(10 * cost, 0)) return;
    starts_.clear();
    for (std::size_t d = 0; d < draws; ++d)
        starts_.push_back({nullptr, step_, nullptr, end_ - step_, stream.bits()});
    double best = 0;
    for (std::size_t p = 0; p < policies_.size(); ++p) {
        if (!continuations_.run(point, starts_, policies_[p], meter)) return;
        double sum = 0;
        for (std::size_t k = 0; k < draws; ++k) sum += continuations_.value(k);
        if (p > 0 && !(sum > best)) continue;
        best = sum;
        policy_ = p;
    }
}

void Uct::add_edges(NodeId node, const Origin& origin) {
    if (tree().node(node).edge_count > 0) return;  // a decision that had no time left has done it
    actions_.find_legal(origin, legal_);
    for (std::size_t a = 0; a < actions_.count(); ++a)
        if (legal_[a]) tree().add_edge(node, static_cast<std::uint32_t>(a));
}

// The tree of the decision before is kept, if it looks far enough ahead.
void Uct::choose_memory(const DecisionPoint& point) {
    auto& memory = memories_.of(point);
    if (!memory) {
        memory = Memory{Tree(state_size_, discount_, options_.backup),
                        DeterminisedProblem(state_size_, simulator_.problem->discount)};
        memory->tree.clear();
    }
    memory_ = &*memory;
    step_ = point.step;
    const std::int64_t depth = options_.horizon.value_or(state_values_ ? value_depth : usual_depth);
    end_ = end_of_search(step_, point.left, depth, memory->end);
    if (end_ != memory->end) {
        memory->tree.clear();
        memory->deepest = 0;
    }
    memory->end = end_;
    goes_on_ = state_values_ && end_ < step_ + point.left;
}

bool Uct::open_root(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    solvers::require_done(simulator_, simulator_.get_state(point.origin.batch, point.origin.first,
                                                           1, states_.data()));
    least_ = std::numeric_limits<double>::infinity();
    most_ = -least_;
    if (is_determinised()) choose_lookahead(meter);
    const NodeId* const known = tree().find(states_.data(), step_);
    if (known && tree().node(*known).is_open && !is_stale(tree().node(*known))) {
        root_ = *known;
        if (is_determinised()) open_edges(root_);
        note_range();
        confirm_root(point, stream, meter);
        if (is_determinised()) compare_all_twins(point, stream, meter);
        return true;
    }
    root_ = tree().node_of(states_.data(), step_);
    new_nodes_.assign(1, root_);
    memory_->leaf_depth = end_ - step_;
    if (!value_root(point, stream, meter)) return false;
    note_range();
    // Where the policy shows no difference between actions, the tree has to: it grows deeper with
    // leaves that are looked at more shortly.
    if (least_ == most_) memory_->leaf_depth = short_leaf;
    return true;
}

bool Uct::value_root(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    if (is_determinised()) {
        if (value_new_nodes(point, stream, meter, 1)) {
            open_edges(root_);
            compare_all_twins(point, stream, meter);
            return true;
        }
        add_edges(root_, point.origin);
        return false;
    }
    add_edges(root_, point.origin);
    const auto edges = static_cast<std::int64_t>(tree().node(root_).edge_count);
    if (!meter.has_room(edges, 0)) return false;
    const bool is_cheap =
        meter.has_room(10 * edges * (end_ - step_) * static_cast<std::int64_t>(root_draws), 0);
    return value_new_nodes(point, stream, meter, is_cheap ? root_draws : 1);
}

// As deep as can be done often in the budget.
void Uct::choose_lookahead(BudgetMeter& meter) {
    DeterminisedProblem& determinised = memory_->determinised;
    const auto affordable = static_cast<std::size_t>(
        meter.steps_left() / (least_lookaheads * typical_steps_->cost()) + 1);
    const std::int64_t depth = determinised.affordable_depth(
        determinised.state_of(states_.data()), std::min(end_ - step_, deepest_lookahead),
        std::min(static_cast<std::size_t>(options_.lookahead), affordable), *typical_steps_, meter);
    if (depth > 0 && depth != determinised.depth()) {
        determinised.set_depth(depth);
        ++memory_->epoch;
    }
}

// The range of returns begins with the values of the root's actions.
void Uct::note_range() {
    for (const Arm& arm : tree().arms(tree().node(root_))) note_return(arm.value);
}

double Uct::bonus(std::int64_t step) const {
    const double left = static_cast<double>(end_ - step) / static_cast<double>(end_ - step_);
    return std::max(exploration_ * range_of_returns(least_, most_) * left, 1e-9);
}

// Actions without a value come first. Then the best by value and by how little it was tried (UCB1).
EdgeId Uct::choose_edge(const Node& node, double deviation, RandomStream& stream) {
    if (node.has_priors) return choose_by_prior(node, deviation);
    if (node.untried > 0) return choose_untried(node, stream);
    const auto arms = tree().arms(node);
    const double scale = deviation * root_of_logarithm(node.weight);
    std::size_t chosen = 0;
    double best = -std::numeric_limits<double>::infinity();
    // Trials that are under way count as tried, so that those beside them differ. Where all that
    // was seen is alike, the least tried action comes next. Which action is better cannot be
    // foreseen, so that there is no branch.
    for (std::size_t a = 0; a < arms.size(); ++a) {
        const double bound = arms[a].value + scale * static_cast<double>(arms[a].width);
        chosen = bound > best ? a : chosen;
        best = bound > best ? bound : best;
    }
    return node.first_edge + static_cast<EdgeId>(chosen);
}

EdgeId Uct::choose_untried(const Node& node, RandomStream& stream) {
    auto left = static_cast<std::int32_t>(stream.below(static_cast<std::uint32_t>(node.untried)));
    EdgeId chosen = node.first_edge;
    for (EdgeId edge = node.first_edge; edge < node.first_edge + node.edge_count; ++edge)
        if (tree().arm(edge).weight == 0 && left-- == 0) chosen = edge;
    return chosen;
}

// PUCT (Silver and others, 2017). An action that was not tried yet has the value of the node.
EdgeId Uct::choose_by_prior(const Node& node, double deviation) const {
    const auto first_values = tree().first_values(node);
    const double scale = deviation * std::sqrt(1.0 + node.weight);
    std::size_t chosen = 0;
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < first_values.size(); ++e) {
        const Arm& arm = tree().arms(node)[e];
        const double value = arm.weight > 0 ? arm.value : node.value;
        const double bound =
            value + scale * static_cast<double>(first_values[e].prior) / (1 + arm.weight);
        if (!(bound > best)) continue;
        best = bound;
        chosen = e;
    }
    return node.first_edge + static_cast<EdgeId>(chosen);
}

bool Uct::run_trials(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    for (std::uint64_t& each : streams_) each = stream.bits();
    trees_.begin(point.origin, streams_);
    new_nodes_.clear();
    for (Trial& trial : trials_) {
        trial.node = root_;
        trial.is_down = false;
        trial.hops = 0;
    }
    for (std::int64_t step = step_; step_trials(stream, step, meter); ++step) {
    }
    if (!new_nodes_.empty()) {
        const bool is_done = value_new_nodes(point, stream, meter, 1);
        for (const NodeId node : new_nodes_) tree().node(node).is_asked = false;
        if (!is_done) {
            cancel_trials();
            return false;
        }
    }
    ripe_.clear();
    back_up_trials();
    for (const NodeId id : ripe_)  // some are there twice
        if (tree().node(id).weight >= tree().node(id).twins_at)
            compare_twins(id, point, stream, meter);
    meter.add_iterations(static_cast<std::int64_t>(trials_.size()));
    return true;
}

void Uct::cancel_trials() {
    for (std::size_t k = 0; k < trials_.size(); ++k)
        for (std::size_t h = 0; h < trials_[k].hops; ++h) tree().cancel(hop(h, k).made);
}

// False: all have reached their leaves.
bool Uct::step_trials(RandomStream& stream, std::int64_t step, BudgetMeter& meter) {
    const auto h = static_cast<std::size_t>(step - step_);
    if (hops_.size() < (h + 1) * trials_.size()) hops_.resize((h + 1) * trials_.size());
    const std::int64_t moving = start_hops(stream, step);
    if (moving == 0) return false;
    write_actions(h);
    trees_.step(records_.data());
    meter.add_steps(moving);
    if (step + 1 < end_ || goes_on_) ask_for_nodes(h, step + 1);
    for (std::size_t k = 0; k < trials_.size(); ++k)
        if (!trials_[k].is_down) follow(h, k, stream, step + 1);
    return true;
}

std::int64_t Uct::start_hops(RandomStream& stream, std::int64_t step) {
    std::int64_t moving = 0;
    const double deviation = bonus(step);
    for (std::size_t k = 0; k < trials_.size(); ++k) {
        Trial& trial = trials_[k];
        const Node& node = tree().node(trial.node);
        trial.is_down = trial.is_down || !node.is_open || node.is_locked;
        if (trial.is_down) continue;
        if (node.edge_count == 0) open_edges(trial.node);
        const EdgeId edge = choose_edge(node, deviation, stream);
        tree().start(trial.node, edge);
        tree().prefetch_edge(edge);
        hop(trial.hops++, k).made = {trial.node, edge, Tree::over, 0};
        ++moving;
    }
    return moving;
}

// Trials that are down do anything.
void Uct::write_actions(std::size_t h) {
    for (std::size_t k = 0; k < trials_.size(); ++k) {
        const std::uint32_t action =
            trials_[k].is_down ? 0 : tree().edge(hop(h, k).made.edge).action;
        std::copy_n(actions_.record(action), action_size_, records_.data() + k * action_size_);
    }
}

// Most of the time of a trial is that of the memory which it reads, so it is asked for ahead: where
// nodes are, and then the nodes and outcomes.
void Uct::ask_for_nodes(std::size_t h, std::int64_t step) {
    solvers::require_done(simulator_,
                          simulator_.get_state(trees_.batch(), 0, trees_.count(), states_.data()));
    for (std::size_t k = 0; k < trials_.size(); ++k) {
        if (trials_[k].is_down) continue;
        keys_[k] = tree().key_of(states_.data() + k * state_size_, step);
        tree().prefetch(keys_[k]);
    }
    for (std::size_t k = 0; k < trials_.size(); ++k) {
        if (trials_[k].is_down) continue;
        const NodeId* const known = tree().find(keys_[k]);
        known_[k] = known ? *known : no_node;
        if (!known) continue;
        tree().prefetch_node(*known);
        tree().prefetch_outcome(hop(h, k).made.edge, *known);
    }
}

// Follows the trial's environment to the node where it is now.
void Uct::follow(std::size_t h, std::size_t k, RandomStream& stream, std::int64_t step) {
    Trial& trial = trials_[k];
    auto& [made, reward] = hop(h, k);
    reward = trees_.reward(k);
    if (trees_.is_running(k) && (step < end_ || goes_on_)) {
        made.after = node_after(made.edge, k, stream, step);
        ask_for_value(made.after);
        tree().prefetch_arms(tree().node(made.after));
        made.outcome = tree().add_outcome(made.edge, made.after);
    }
    trial.node = made.after;
}

NodeId Uct::node_after(EdgeId edge, std::size_t k, RandomStream& stream, std::int64_t step) {
    if (known_[k] != no_node) return known_[k];
    // Another trial may have made it since.
    if (const NodeId* const known = tree().find(keys_[k])) return *known;
    if (is_full(edge)) {
        // Progressive widening: the trial goes on from an outcome that was seen before.
        const NodeId seen = tree().seen_outcome(edge, stream.unit());
        if (seen != Tree::over) {
            solvers::require_done(
                simulator_, simulator_.set_state(trees_.batch(), static_cast<std::int64_t>(k), 1,
                                                 tree().state(seen), &step));
            return seen;
        }
    }
    const NodeId made = tree().node_of(keys_[k], states_.data() + k * state_size_, step);
    if (!is_determinised())  // otherwise it knows what is legal
        add_edges(made, {trees_.batch(), static_cast<std::int64_t>(k)});
    return made;
}

// If it has none.
void Uct::ask_for_value(NodeId id) {
    Node& node = tree().node(id);
    if (is_stale(node)) node.is_open = false;
    if (node.is_open || node.is_asked) return;
    node.is_asked = true;
    new_nodes_.push_back(id);
}

// Whether the edge has as many outcomes as its trials may distinguish.
bool Uct::is_full(EdgeId edge) const {
    return has_all_outcomes(options_, tree().arm(edge).weight, tree().edge(edge).outcomes.count);
}

// One depth after the other, so that nodes have the values of all trials before these are seen from
// above.
void Uct::back_up_trials() {
    std::size_t deepest = 0;
    for (std::size_t k = 0; k < trials_.size(); ++k) {
        rests_[k] = tree().node(trials_[k].node).value;
        deepest = std::max(deepest, trials_[k].hops);
    }
    memory_->deepest = std::max(memory_->deepest, step_ + static_cast<std::int64_t>(deepest));
    for (std::size_t h = deepest; h-- > 0;)
        for (std::size_t k = 0; k < trials_.size(); ++k) {
            if (h >= trials_[k].hops) continue;
            const auto& [made, reward] = hop(h, k);
            tree().back_up(made, reward, rests_[k]);
            const Node& node = tree().node(made.node);
            if (node.weight >= node.twins_at) ripe_.push_back(made.node);
            rests_[k] = reward + tree().discount() * rests_[k];
        }
    for (const double value : rests_) note_return(value);
}

void Uct::note_return(double value) {
    if (!std::isfinite(value)) return;
    least_ = std::min(least_, value);
    most_ = std::max(most_, value);
}

EdgeId Uct::best_edge() const {
    const Node& node = tree().node(root_);
    std::int32_t most = 0;
    EdgeId chosen = node.first_edge;
    float likeliest = 0;  // is taken where there were no trials
    for (const Edge& edge : tree().edges(node)) {
        most = std::max(most, edge.known_weight);
        const float prior = tree().first_value(tree().id_of(edge)).prior;
        if (prior <= likeliest) continue;
        likeliest = prior;
        chosen = tree().id_of(edge);
    }
    double best = -std::numeric_limits<double>::infinity();
    for (const Edge& edge : tree().edges(node)) {
        const EdgeId id = tree().id_of(edge);
        const std::int32_t weight = edge.known_weight;
        if (weight == 0 || weight < least_tried * most || !(tree().arm(id).value > best)) continue;
        best = tree().arm(id).value;
        chosen = id;
    }
    return chosen;
}

void Uct::decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) {
    RandomStream stream(options_.seed, point.episode, point.step);
    BudgetMeter meter(options_.budget, point.stops, point.share, point.steps_spent);
    try {
        const EdgeId chosen = search(point, stream, meter);
        std::copy_n(actions_.record(tree().edge(chosen).action), action_size_, action);
        const Node& root = tree().node(root_);
        found_ = {tree().arm(chosen).value, end_ - step_, false,
                  !root.is_locked && root.edge_count > 1};
        if (explanation) note_explanation(*explanation, chosen, meter);
        keep_below(chosen);
    } catch (...) {
        memories_.of(point).reset();  // nodes may be half made
        throw;
    }
}

EdgeId Uct::search(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    choose_memory(point);
    choose_policy(point, stream, meter);
    if (policy_ != memory_->policy) {
        memory_->policy = policy_;
        ++memory_->epoch;
    }
    const bool is_open = open_root(point, stream, meter);
    const Node& root = tree().node(root_);
    if (is_open && !root.is_locked && root.edge_count > 1)
        while (
            meter.has_room(static_cast<std::int64_t>(trials_.size()) * steps_of_next_trial(), 0) &&
            memory_->bytes() <= most_bytes_ && run_trials(point, stream, meter)) {
        }
    return best_edge();
}

// At most: a trial ends one step behind all that were made before.
std::int64_t Uct::steps_of_next_trial() const {
    return std::min(end_, std::max(memory_->deepest, step_) + 1) - step_;
}

// Keeps what the next decision may use, if it is small enough.
void Uct::keep_below(EdgeId edge) {
    // A tree of which all may come again is not copied in each step.
    const std::size_t most =
        std::max(std::min(most_garbage, most_kept_bytes_ / 2), 2 * memory_->tree_kept);
    if (tree().bytes() > most || memory_->bytes() > most_kept_bytes_) {
        tree().keep_below(edge);
        memory_->tree_kept = tree().bytes();
    }
    if (memory_->bytes() <= most_kept_bytes_) return;
    if (tree().bytes() > most_kept_bytes_ / 2) tree().clear();
    if (memory_->determinised.bytes() > most_kept_bytes_ / 2) {
        memory_->determinised.clear();
        ++memory_->epoch;
    }
}

void Uct::note_explanation(Explanation& explanation, EdgeId chosen, const BudgetMeter& meter) {
    explanation.depth = end_ - step_;
    explanation.iterations = meter.iterations();
    explanation.steps = meter.steps();
    const Node& root = tree().node(root_);
    if (root.is_locked)
        explanation.note = "no action changes the state or the reward any more";
    else if (root.edge_count == 1)
        explanation.note = "only one action is legal, or all have the same outcome";
    else if (meter.iterations() == 0)
        explanation.note = "the budget did not last for a trial";
    explanation.chosen = chosen - root.first_edge;
    for (const Edge& edge : tree().edges(root)) {
        const std::byte* const record = actions_.record(edge.action);
        const std::int32_t draws = tree().first_value(tree().id_of(edge)).draws;
        const std::int32_t trials = edge.known_weight + std::max(0, draws - 1);
        const double value = trials > 0 ? tree().arm(tree().id_of(edge)).value : 0;
        explanation.candidates.push_back(
            {"action", {record, record + action_size_}, value, 0, trials});
    }
}

}  // namespace rddlc::planners
