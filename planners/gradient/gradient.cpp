// Over 400 lines: one search, from its options to its explanation.
#include "planners/gradient/gradient.hpp"

#include "planners/simulation/mean_and_error.hpp"
#include "support/failure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rddlc::planners {

namespace {

constexpr std::int64_t default_horizon = 40, least_horizon = 5;
// Bools change if they are likelier to than this; the second one is for where several share what is
// allowed for one.
constexpr std::array thresholds{0.5, 0.2};

// A plan of several steps waits so many seconds for its comparison with no-op, also after Ctrl-C:
// it may be worse.
constexpr double comparison_patience = 5;
// Steps by which the time of the first comparison is estimated.
constexpr std::int64_t timed_steps = 4;

std::size_t scenarios_of(const rddl_problem& problem, const GradientOptions& options) {
    return static_cast<std::size_t>(options.scenarios.value_or(problem.stochastic ? 4 : 1));
}

std::vector<solvers::Relaxation> relaxations_of(const GradientOptions& options) {
    using Mode = solvers::Relaxation::Mode;
    std::vector<Mode> modes;
    const auto takes = [&](Relaxed one) {
        return options.relaxed == Relaxed::All || options.relaxed == one;
    };
    if (takes(Relaxed::Exact)) modes.push_back(Mode::Exact);
    if (takes(Relaxed::Straight)) modes.push_back(Mode::StraightThrough);
    if (takes(Relaxed::Soft)) modes.push_back(Mode::Soft);
    std::vector<solvers::Relaxation> relaxations;
    for (const Mode mode : modes)
        relaxations.push_back({.mode = mode, .sharpness = options.sharpness});
    return relaxations;
}

std::vector<std::unique_ptr<solvers::StepDerivatives>> derivatives_of(
    const PlannerContext& context, const GradientOptions& options) {
    if (!context.derivatives)
        throw Failure(
            "plan:gradient needs the RDDL text of the problem, from which derivatives are made",
            "act by rddl or Python, which have it, or by plan:cem");
    std::vector<std::unique_ptr<solvers::StepDerivatives>> derivatives;
    for (const solvers::Relaxation& relaxation : relaxations_of(options)) {
        derivatives.push_back(context.derivatives(relaxation));
        if (!derivatives.back()->can_be_relaxed()) break;  // they are all the same
    }
    return derivatives;
}

// Where steps are few, short plans that go up some gradients are better than long ones that hardly
// move.
std::int64_t horizon_at_first(const PlannerContext& context, const GradientOptions& options,
                              std::size_t relaxations) {
    if (options.horizon || !options.budget.steps) return options.horizon.value_or(default_horizon);
    constexpr std::size_t least_ascents = 10;
    const GradientPopulation population = usual_population(context, options);
    const std::size_t plans = relaxations * population.plans;
    const std::size_t scenarios = scenarios_of(*context.simulator.problem, options);
    const auto each = static_cast<std::int64_t>(least_ascents * plans * scenarios +
                                                population.draws * (plans * thresholds.size() + 2));
    const std::int64_t horizon =
        std::clamp(*options.budget.steps / each, least_horizon, default_horizon);
    return std::clamp(options.replan, horizon, default_horizon);
}

}  // namespace

Gradient::Gradient(const PlannerContext& context, const GradientOptions& options)
    : simulator_(context.simulator),
      options_(options),
      space_(solvers::action_space(simulator_)),
      records_(simulator_),
      parameters_(simulator_, space_),
      derivatives_(derivatives_of(context, options)),
      horizon_(options.horizon.value_or(default_horizon)),
      first_horizon_(horizon_at_first(context, options, derivatives_.size())),
      population_(population_of(context, options, horizon_, derivatives_, thresholds.size())),
      plans_(population_.plans * derivatives_.size()),
      scenarios_(scenarios_of(*simulator_.problem, options)),
      futures_(simulator_,
               static_cast<std::int64_t>(population_.draws * (plans_ * thresholds.size() + 2)),
               context.horizon),
      single_(simulator_, 1, context.horizon),
      repair_(simulator_, space_, futures_.count()),
      single_repair_(simulator_, space_, 1),
      memories_(context.environments) {
    if (!parameters_.any_moves() || derivatives_.front()->action_count() != parameters_.count())
        throw Failure(
            "plan:gradient moves reals, ints between bounds and bools, and this problem "
            "has no such actions",
            "plan:cem and plan:uct choose objects");
    for (const auto& derivatives : derivatives_)
        ascents_.emplace_back(parameters_, *derivatives, scenarios_, simulator_.problem->discount);
    const auto lanes = static_cast<std::size_t>(futures_.count());
    if (context.base) base_.emplace(simulator_, *context.base, futures_.count());
    seeds_.resize(scenarios_);
    streams_.resize(lanes);
    state_.resize(static_cast<std::size_t>(simulator_.problem->state_size));
    state_numbers_.resize(derivatives_.front()->state_count());
    actions_.resize(lanes * records_.record_size());
    rows_.resize(lanes * static_cast<std::size_t>(space_.column_count));
    by_policy_.resize(lanes);
}

Gradient::Memory& Gradient::memory_of(const DecisionPoint& point, RandomStream& stream) {
    auto& memory = memories_.of(point);
    if (memory) return *memory;
    memory.emplace();
    memory->horizon = first_horizon_;
    memory->choice.kind = base_ ? Candidate::Kind::Policy : Candidate::Kind::Noop;
    const std::size_t count = static_cast<std::size_t>(horizon_) * parameters_.count();
    for (std::size_t p = 0; p < plans_; ++p) {
        AscendingPlan plan;
        while (plan.parameters.size() < count)
            plan.parameters.insert(plan.parameters.end(), parameters_.defaults().begin(),
                                   parameters_.defaults().end());
        if (p > 0) disturb(plan, options_.spread, stream);
        memory->plans.push_back(std::move(plan));
    }
    return *memory;
}

// Adds noise whose correlation from step to step is 0.9.
void Gradient::disturb(AscendingPlan& plan, double spread, RandomStream& stream) const {
    constexpr double correlation = 0.9;
    const std::size_t count = parameters_.count();
    std::vector<double> noise(count);
    for (double& each : noise) each = spread * static_cast<double>(stream.bell());
    for (std::size_t j = 0; j < plan.parameters.size(); ++j) {
        double& each = noise[j % count];
        plan.parameters[j] += each;
        each = correlation * each + std::sqrt(1 - correlation * correlation) * spread *
                                        static_cast<double>(stream.bell());
    }
    for (std::size_t begin = 0; begin < plan.parameters.size(); begin += count)
        parameters_.project(std::span(plan.parameters).subspan(begin, count));
}

void Gradient::decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) {
    RandomStream stream(options_.seed, point.episode, point.step);
    BudgetMeter meter(options_.budget, point.stops);
    Memory& memory = memory_of(point, stream);
    if (memory.steps_left == 0) {
        search(point, memory, stream, meter, explanation);
        memory.steps_left = std::min(options_.replan, horizon_);
    } else if (explanation) {
        explanation->note = "goes on by the plan of an earlier step";
    }
    write_first(memory.choice, memory, point, action);
    if (explanation) {
        explanation->iterations = meter.iterations();
        explanation->steps = meter.steps();
        if (explanation->candidates.empty())
            explanation->candidates.push_back(
                {"plan", {action, action + records_.record_size()}, 0, 0, 0});
    }
    --memory.steps_left;
    move_on(memory, stream);
}

void Gradient::search(const DecisionPoint& point, Memory& memory, RandomStream& stream,
                      BudgetMeter& meter, Explanation* explanation) {
    for (AscendingPlan& plan : memory.plans) {
        plan.mean.assign(plan.parameters.size(), 0.0);
        plan.square.assign(plan.parameters.size(), 0.0);
    }
    memory.is_improved = false;
    const std::int64_t depth = std::min(memory.horizon, point.left);
    find_candidates(memory);
    if (comparison_seconds_ == 0 && meter.has_clock()) {
        time_comparison(point, memory, depth, stream, meter);
        find_candidates(memory);
    }
    ascend(point, memory, stream, meter);
    std::int64_t compared = 0;
    const std::int64_t affordable = std::min(depth, meter.steps_left() / futures_.count());
    if (affordable > 0)
        compared = compare(point, memory, affordable, stream, meter);
    else
        rank_by_ascents(memory);
    const Candidate& best = candidates_[order_.front()];
    if (explanation) {
        explanation->depth = compared;
        note(memory, point, *explanation);
    }
    if (best.kind == Candidate::Kind::Plan)
        std::rotate(memory.plans.begin(),
                    memory.plans.begin() + static_cast<std::ptrdiff_t>(best.plan),
                    memory.plans.begin() + static_cast<std::ptrdiff_t>(best.plan) + 1);
    memory.choice = best;
    memory.choice.plan = 0;
    // Where nothing is better than doing nothing, a better plan may need more steps. A horizon that
    // leaves no room for a gradient is too long.
    const auto noop = std::ranges::find(candidates_, Candidate::Kind::Noop, &Candidate::kind);
    if (!memory.is_improved)
        memory.horizon = first_horizon_;
    else if (!(best.value > noop->value))
        memory.horizon = std::min(2 * memory.horizon, horizon_);
}

// The time of the first comparison is not known yet: its first steps tell.
void Gradient::time_comparison(const DecisionPoint& point, const Memory& memory, std::int64_t depth,
                               RandomStream& stream, BudgetMeter& meter) {
    const std::int64_t steps = std::min(timed_steps, depth);
    if (!meter.has_room(2 * futures_.count() * depth, 0)) return;
    compare(point, memory, steps, stream, meter);
    comparison_seconds_ *= static_cast<double>(depth) / static_cast<double>(steps);
}

// Leaves room for the comparison.
void Gradient::ascend(const DecisionPoint& point, Memory& memory, RandomStream& stream,
                      BudgetMeter& meter) {
    solvers::require_done(
        simulator_, simulator_.get_state(point.origin.batch, point.origin.first, 1, state_.data()));
    derivatives_.front()->read_state(state_.data(), state_numbers_);
    const std::int64_t depth = std::min(memory.horizon, point.left);
    const auto cost = static_cast<std::int64_t>(plans_ * scenarios_) * depth;
    const std::int64_t comparison = futures_.count() * depth;
    std::int64_t iteration = 0;
    double seconds = 0;
    while (meter.has_room(cost + comparison, seconds + 1.5 * comparison_seconds_)) {
        const double before = meter.seconds();
        for (std::uint64_t& seed : seeds_) seed = stream.bits();
        for (std::size_t a = 0; a < ascents_.size(); ++a) {
            std::vector<AscendingPlan*> its;
            for (std::size_t p = a; p < plans_; p += ascents_.size())
                its.push_back(&memory.plans[p]);
            if (!ascents_[a].improve(its, state_numbers_, point.step, depth, seeds_, options_.rate,
                                     iteration, point.stops))
                return;
        }
        ++iteration;
        memory.is_improved = true;
        meter.add_steps(cost);
        meter.add_iterations();
        seconds = meter.seconds() - before;
    }
}

void Gradient::find_candidates(const Memory& memory) {
    candidates_.clear();
    bool any_bool = false;
    for (std::size_t i = 0; i < parameters_.count(); ++i)
        any_bool = any_bool || parameters_.is_bool(i);
    for (std::size_t p = 0; p < memory.plans.size(); ++p) {
        candidates_.push_back({.kind = Candidate::Kind::Plan, .plan = p});
        if (any_bool)
            candidates_.push_back(
                {.kind = Candidate::Kind::Plan, .plan = p, .threshold = thresholds[1]});
    }
    candidates_.push_back({.kind = Candidate::Kind::Noop});
    if (base_) candidates_.push_back({.kind = Candidate::Kind::Policy});
    order_.resize(candidates_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
}

void Gradient::write_rows(const Memory& memory, std::int64_t step) {
    const auto columns = static_cast<std::size_t>(space_.column_count);
    const std::size_t count = parameters_.count();
    for (std::size_t k = 0; k < streams_.size(); ++k) {
        const Candidate& candidate = candidates_[k % candidates_.size()];
        float* const row = rows_.data() + k * columns;
        if (k >= candidates_.size()) {  // the same as in the first draw
            std::copy_n(row - candidates_.size() * columns, columns, row);
        } else if (candidate.kind == Candidate::Kind::Plan) {
            const std::span all(memory.plans[candidate.plan].parameters);
            parameters_.write(all.subspan(static_cast<std::size_t>(step) * count, count),
                              candidate.threshold, row);
        } else {
            std::ranges::copy(space_.defaults, row);
        }
    }
}

std::int64_t Gradient::compare(const DecisionPoint& point, const Memory& memory, std::int64_t depth,
                               RandomStream& stream, BudgetMeter& meter) {
    const std::size_t lanes = streams_.size(), count = candidates_.size();
    const std::size_t columns = static_cast<std::size_t>(space_.column_count);
    const std::size_t size = records_.record_size();
    for (std::size_t k = 0; k < lanes; ++k) {
        streams_[k] = k % count == 0 ? stream.bits() : streams_[k - 1];
        by_policy_[k] = candidates_[k % count].kind == Candidate::Kind::Policy;
    }
    const double before = meter.seconds();
    const double patience = options_.replan > 1 && memory.is_improved ? comparison_patience : 0;
    futures_.begin(point.origin, streams_);
    if (base_) base_->begin(point.episode, point.step, point.horizon, streams_);
    std::int64_t t = 0;
    const auto gives_up = [&] {
        return solvers::is_stopped(point.stops) ? meter.seconds() - before >= patience
                                                : meter.is_late();
    };
    for (; t < depth && futures_.any_running(); ++t) {
        if (t > 0 && t % 4 == 0 && gives_up()) break;
        write_rows(memory, t);
        for (std::size_t k = 0; k < lanes; ++k)
            records_.write(rows_.data() + k * columns, actions_.data() + k * size);
        if (base_) {
            base_->act(futures_, by_policy_, actions_.data(), point.stops);
            for (std::size_t k = 0; k < lanes; ++k)
                if (by_policy_[k])
                    records_.read(actions_.data() + k * size, rows_.data() + k * columns);
        }
        if (space_.may_be_illegal)
            solvers::repair_actions(simulator_, space_, records_, futures_.batch(), rows_.data(),
                                    actions_.data(), repair_);
        futures_.step(actions_.data());
        meter.add_steps(futures_.stepped());
    }
    comparison_seconds_ = (meter.seconds() - before) * static_cast<double>(depth) /
                          static_cast<double>(std::max<std::int64_t>(t, 1));
    if (t < depth && futures_.any_running()) {
        rank_by_ascents(memory);
        return t;
    }
    const std::size_t draws = lanes / count;
    for (std::size_t c = 0; c < count; ++c) {
        const auto found =
            mean_and_error(draws, [&](std::size_t d) { return futures_.value(d * count + c); });
        candidates_[c].value = found.mean;
        candidates_[c].error = found.error;
    }
    sort_candidates();
    return t;
}

// Plans count by their return in the last ascent, if that was exact. Without an ascent the choice
// of the search before is kept, at first no-op or the policy.
void Gradient::rank_by_ascents(const Memory& memory) {
    constexpr double worst = -std::numeric_limits<double>::infinity();
    const bool is_mixed = options_.relaxed == Relaxed::All;
    for (Candidate& candidate : candidates_) {
        candidate.error = 0;
        if (!memory.is_improved) {
            candidate.value = candidate.has_action_of(memory.choice) ? 0 : worst;
            continue;
        }
        const bool is_plan = candidate.kind == Candidate::Kind::Plan;
        const bool is_exact = !is_mixed || candidate.plan % ascents_.size() == 0;
        const bool counts = is_plan && is_exact && candidate.threshold == thresholds[0];
        candidate.value = counts ? memory.plans[candidate.plan].value : worst;
    }
    sort_candidates();
}

void Gradient::sort_candidates() {
    std::ranges::stable_sort(order_, [&](std::size_t a, std::size_t b) {
        return candidates_[a].value > candidates_[b].value;
    });
}

void Gradient::write_first(const Candidate& candidate, const Memory& memory,
                           const DecisionPoint& point, std::byte* action) {
    if (candidate.kind == Candidate::Kind::Policy && point.base_action) {
        std::copy_n(point.base_action, records_.record_size(), action);
        return;
    }
    float* const row = rows_.data();
    if (candidate.kind == Candidate::Kind::Plan)
        parameters_.write(
            std::span(memory.plans[candidate.plan].parameters)
                .subspan(memory.steps_made * parameters_.count(), parameters_.count()),
            candidate.threshold, row);
    else
        std::ranges::copy(space_.defaults, row);
    records_.write(row, action);
    if (!space_.may_be_illegal) return;
    const std::uint64_t seed = 0;
    single_.begin(point.origin, {&seed, 1});
    solvers::repair_actions(simulator_, space_, records_, single_.batch(), row, action,
                            single_repair_);
}

// A step is made. Before the next search plans move on to the present, and end with copies of their
// last step. Each ascent gets the best plan, and the worse half of the plans becomes the best one,
// disturbed.
void Gradient::move_on(Memory& memory, RandomStream& stream) const {
    ++memory.steps_made;
    if (memory.steps_left > 0) return;
    const std::size_t count = parameters_.count(), rows = static_cast<std::size_t>(horizon_);
    const auto last = static_cast<std::size_t>(memory.horizon - 1);
    for (AscendingPlan& plan : memory.plans)
        for (std::size_t t = 0; t < rows; ++t) {
            const std::size_t from = std::min(t + memory.steps_made, last);
            std::copy_n(plan.parameters.data() + from * count, count,
                        plan.parameters.data() + t * count);
        }
    memory.steps_made = 0;
    const auto& best = memory.plans.front().parameters;
    for (std::size_t p = 1; p < memory.plans.size(); ++p) {
        const bool is_first = p < ascents_.size();
        if (!is_first && 2 * p < memory.plans.size()) continue;
        memory.plans[p].parameters = best;
        if (!is_first) disturb(memory.plans[p], options_.spread, stream);
    }
}

void Gradient::note(const Memory& memory, const DecisionPoint& point, Explanation& explanation) {
    constexpr std::size_t most = 5;
    for (std::size_t k = 0; k < order_.size(); ++k) {
        const Candidate& candidate = candidates_[order_[k]];
        const bool is_plan = candidate.kind == Candidate::Kind::Plan;
        if (is_plan && k >= most) continue;
        std::vector<std::byte> action(records_.record_size());
        write_first(candidate, memory, point, action.data());
        explanation.candidates.push_back({is_plan                                   ? "plan"
                                          : candidate.kind == Candidate::Kind::Noop ? "noop"
                                                                                    : "policy",
                                          std::move(action), candidate.value, candidate.error,
                                          static_cast<std::int64_t>(population_.draws)});
    }
}

}  // namespace rddlc::planners
