#include "planners/cem/cem.hpp"

#include <algorithm>
#include <numeric>

namespace rddlc::planners {

namespace {

// Steps of a plan, until something is better than doing nothing, if the user gives no horizon.
constexpr std::int64_t first_horizon = 40;

std::size_t scenarios_of(const rddl_problem& problem, const CemOptions& options) {
    if (options.scenarios) return static_cast<std::size_t>(*options.scenarios);
    return problem.stochastic ? 4 : 1;
}

// So many that some populations fit into the budget, and into memory, beside the part of both that
// near plans take.
std::size_t population_of(const PlannerContext& context, const CemOptions& options,
                          std::size_t scenarios, double near_part) {
    constexpr std::int64_t least_populations = 5, least = 16;
    const auto lanes = static_cast<std::int64_t>(scenarios);
    const std::int64_t each = solvers::bytes_per_environment(context.simulator) * lanes;
    const std::int64_t memory = NearSearch::rest(near_part, context.memory_limit);
    std::int64_t population =
        std::min<std::int64_t>(options.population, std::max<std::int64_t>(1, memory / 4 / each));
    if (const auto steps = NearSearch::rest(near_part, options.budget.steps)) {
        const std::int64_t row = options.horizon.value_or(first_horizon) * lanes;
        population = std::min(population, std::max(least, *steps / (least_populations * row)));
        population = std::min(population, std::max<std::int64_t>(1, *steps / lanes));
    }
    // An engine takes as long for a block of environments as for a part of it.
    constexpr std::int64_t block = 16;
    const std::int64_t plans = block / std::gcd(block, lanes);  // of whole blocks
    if (population >= 2 * plans) population -= population % plans;
    return static_cast<std::size_t>(population);
}

// Fewer draws of luck where a decision has too few steps for them.
std::size_t affordable(std::size_t scenarios, std::optional<std::int64_t> steps) {
    if (!steps) return scenarios;
    return std::clamp<std::size_t>(static_cast<std::size_t>(*steps) / 16, 1, scenarios);
}

}  // namespace

Cem::Cem(const PlannerContext& context, const CemOptions& options)
    : simulator_(context.simulator),
      loops_(plan_loops()),
      options_(options),
      batch_horizon_(context.horizon),
      space_(solvers::action_space(simulator_)),
      near_part_(NearSearch::part_of(options, space_)),
      memory_limit_(NearSearch::rest(near_part_, context.memory_limit)),
      steps_limit_(NearSearch::rest(near_part_, options.budget.steps)),
      records_(simulator_),
      scenarios_(affordable(scenarios_of(*simulator_.problem, options), steps_limit_)),
      lanes_(0),
      futures_(simulator_,
               static_cast<std::int64_t>(scenarios_ *
                                         population_of(context, options, scenarios_, near_part_)),
               context.horizon),
      legal_(simulator_, space_, records_, futures_.count()),
      memories_(context.environments),
      fresh_(space_, Spread{options.spread}),
      plans_(static_cast<std::size_t>(futures_.count()) / scenarios_, space_.real_count(),
             space_.index_count()),
      noise_(plans_.plans(), space_, correlations_of(options_)),
      plan_actions_(space_, records_, plans_.plans()) {
    lanes_ = static_cast<std::size_t>(futures_.count());
    population_ = plans_.plans();
    if (context.base) {
        base_.emplace(simulator_, *context.base, futures_.count());
        recorder_.emplace(simulator_, *context.base, 1);
        recording_.emplace(simulator_, 1, context.horizon);
    }
    if (options.tail == Tail::Value) tail_.emplace(*context.base, futures_.count());
    default_numbers_.resize(static_cast<std::size_t>(space_.real_count()));
    default_indices_.resize(static_cast<std::size_t>(space_.index_count()));
    read_plan_action(space_, space_.defaults.data(), default_numbers_.data(),
                     default_indices_.data());

    near_numbers_ = default_numbers_;
    near_indices_ = default_indices_;
    if (near_part_ > 0) near_.emplace(context, options_, near_part_);

    origins_.resize(population_);
    values_.resize(population_);
    errors_.resize(population_);
    order_.resize(population_);
    is_ordered_.resize(population_);
    firsts_.resize(population_ * records_.record_size());
    streams_.resize(lanes_);
    row_.resize(static_cast<std::size_t>(space_.column_count));
    actions_.resize(lanes_ * records_.record_size());
    by_policy_.resize(lanes_);
}

Cem::Memory& Cem::memory_of(const DecisionPoint& point) {
    auto& memory = memories_.of(point);
    if (memory) return *memory;
    memory.emplace(space_, Spread{options_.spread});
    memory->horizon = options_.horizon.value_or(first_horizon);
    memory->distribution.restart(memory->horizon);
    // At most half of a population comes again.
    memory->kept.resize(std::min(static_cast<std::size_t>(options_.kept),
                                 std::max<std::size_t>(1, population_ / 2)));
    memory->kept_values.resize(memory->kept.size());
    return *memory;
}

namespace {

// Gives `all` `count` rows; those from `first` on are copies of `row`.
template <class Number>
void fill_rows(std::vector<Number>& all, std::size_t first, std::size_t count,
               const std::vector<Number>& row) {
    all.resize(count * row.size());
    for (std::size_t t = first; t < count; ++t)
        std::ranges::copy(row, all.begin() + static_cast<std::ptrdiff_t>(t * row.size()));
}

}  // namespace

// The plan gets so many steps; those from `first` on do nothing.
void Cem::end_by_noop(Plan& plan, std::int64_t first, std::int64_t steps) const {
    const auto begin = static_cast<std::size_t>(first), end = static_cast<std::size_t>(steps);
    fill_rows(plan.numbers, begin, end, default_numbers_);
    fill_rows(plan.indices, begin, end, default_indices_);
}

// Plans of as many steps as plans_ has.
void Cem::make_population(Memory& memory, const DecisionPoint& point, RandomStream& stream,
                          BudgetMeter& meter) {
    if (is_fresh(memory)) {
        fresh_.extend(memory.horizon);
        fresh_.draw(stream, noise_, plans_);
    } else {
        memory.distribution.draw(stream, noise_, plans_);
    }
    std::ranges::fill(origins_, Origin::Sample);
    std::size_t next = 0;
    // At least a quarter is drawn, also of few plans.
    const std::size_t drawn = population_ == 1 ? 0 : std::max<std::size_t>(1, population_ / 4);
    const auto take = [&](Origin origin) {
        if (next + drawn == population_) return false;
        origins_[next] = origin;
        return true;
    };
    for (std::size_t k = 0; k < memory.kept_count && take(Origin::Kept); ++k)
        plans_.put(next++, memory.kept[k]);
    if (base_ && take(Origin::Policy)) {
        record_policy(point, meter);
        plans_.put(next++, plan_);
    }
    if (take(Origin::Noop)) {
        end_by_noop(plan_, 0, memory.horizon);
        plans_.put(next++, plan_);
    }
    if (take(Origin::Middle)) {
        end_by_noop(plan_, 0, memory.horizon);
        memory.distribution.middle(plan_);
        plans_.put(next++, plan_);
    }
    if (near_ && take(Origin::Near)) {
        begin_near(memory, plan_);
        plans_.put(next++, plan_);
    }
}

void Cem::record_policy(const DecisionPoint& point, BudgetMeter& meter) {
    const std::size_t rows = plans_.steps();
    end_by_noop(plan_, 0, static_cast<std::int64_t>(rows));
    recording_->begin(point.origin, std::span(streams_).first(1));
    recorder_->begin(point.episode, point.step, point.horizon, std::span(streams_).first(1));
    constexpr std::uint8_t wanted[] = {1};
    for (std::size_t t = 0; t < rows && recording_->any_running(); ++t) {
        recorder_->act(*recording_, wanted, actions_.data(), point.stops);
        records_.read(actions_.data(), row_.data());
        read_plan_action(space_, row_.data(), plan_.numbers.data() + t * default_numbers_.size(),
                         plan_.indices.data() + t * default_indices_.size());
        if (t + 1 == rows) return;  // no action follows, which would need the next state
        recording_->step(actions_.data());
        meter.add_steps(1);
    }
}

// New random streams. So many lanes in turn have the same one, so that only their plans differ.
void Cem::draw_streams(RandomStream& stream, std::size_t plans) {
    for (std::size_t begin = 0; begin < lanes_; begin += plans)
        std::fill_n(streams_.begin() + static_cast<std::ptrdiff_t>(begin),
                    std::min(plans, lanes_ - begin), stream.bits());
}

// The plans once, and copies of these for their other draws of luck.
void Cem::write_actions(std::span<const std::uint32_t> plans, std::size_t step) {
    plan_actions_.write(plans_, step, plans, actions_.data());
    const std::size_t count = plans.empty() ? population_ : plans.size();
    const std::size_t written = count * records_.record_size();
    for (std::size_t begin = written; begin < actions_.size(); begin += written)
        std::copy_n(actions_.data(), std::min(written, actions_.size() - begin),
                    actions_.data() + begin);
}

std::int64_t Cem::play(const DecisionPoint& point, std::span<const std::uint32_t> plans,
                       std::int64_t steps, BudgetMeter& meter) {
    const bool has_policy = std::ranges::find(by_policy_, 1) != by_policy_.end();
    futures_.begin(point.origin, streams_);
    if (has_policy) base_->begin(point.episode, point.step, point.horizon, streams_);
    for (std::int64_t t = 0; t < steps && futures_.any_running(); ++t) {
        write_actions(plans, static_cast<std::size_t>(t));
        if (has_policy) base_->act(futures_, by_policy_, actions_.data(), point.stops);
        legal_.make_legal(futures_.batch(), actions_.data());
        if (t == 0) note_first_actions(plans);
        if (t % 4 == 0 && meter.is_late()) return t;
        futures_.step(actions_.data());
        meter.add_steps(futures_.stepped());
    }
    if (tail_) tail_->add(futures_, point.step + steps);
    return steps;
}

// All draws of luck of a plan begin in the same state, so that they have the same first action.
void Cem::note_first_actions(std::span<const std::uint32_t> plans) {
    const std::size_t size = records_.record_size();
    if (plans.empty()) std::copy_n(actions_.data(), firsts_.size(), firsts_.data());
    for (std::size_t k = 0; k < plans.size(); ++k)
        std::copy_n(actions_.data() + k * size, size, firsts_.data() + plans[k] * size);
}

const std::byte* Cem::first_action(std::size_t plan) const {
    return firsts_.data() + plan * records_.record_size();
}

void Cem::decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) {
    RandomStream stream(options_.seed, point.episode, point.step);
    BudgetMeter meter(options_.budget, point.stops, point.share, point.steps_spent);
    Memory& memory = memory_of(point);
    const bool compares = simulator_.problem->stochastic || base_;
    const auto lanes = static_cast<std::int64_t>(lanes_);
    const std::int64_t played = lanes + (base_ ? 1 : 0);  // with the policy's plan
    const auto comparison = [&](std::int64_t depth) {     // its steps
        const bool has_tail = base_ && !tail_ && point.left != no_end;
        return compares ? lanes * (has_tail ? point.left : depth) : 0;
    };
    if (near_) look_near(point, meter);
    std::int64_t depth = 0;
    double seconds = 0;
    bool has_found = false;  // a plan that no population has played
    do {
        const double before = meter.seconds();
        const std::int64_t affordable_steps =
            std::max<std::int64_t>(1, meter.steps_left() / played);
        const std::int64_t wanted = std::min({point.left, memory.horizon, affordable_steps});
        plans_.set_steps(wanted);
        draw_streams(stream, population_);
        make_population(memory, point, stream, meter);
        const std::int64_t made = play(point, {}, wanted, meter);
        if (made < wanted && depth > 0) {
            rank_kept(memory);
            break;
        }
        depth = made;
        rank();
        if (depth == 0) break;
        const bool is_fruitful = values_[order_.front()] > noop_value_;
        if (is_fruitful && is_fresh(memory)) memory.distribution.restart(memory.horizon);
        if (is_fruitful || !is_fresh(memory)) refit(memory);
        keep_best(memory);
        meter.add_iterations();
        seconds = meter.seconds() - before;
        memory.fruitless = is_fruitful ? 0 : memory.fruitless + 1;
        has_found = !is_fruitful && look_elsewhere(memory, point, stream, meter);
    } while (has_found ||
             meter.has_room(played * depth + comparison(depth), compares ? seconds : 0));

    add_others();
    Choice chosen{order_.front(), values_[order_.front()], errors_[order_.front()],
                  static_cast<std::int64_t>(scenarios_)};
    if (compares && depth > 0 && !meter.is_late() && meter.steps_left() >= comparison(depth)) {
        chosen = compare(point, depth, stream, meter);
        const auto place = std::ranges::find(order_, chosen.plan);
        std::rotate(order_.begin(), place, place + 1);
        keep_best(memory);
    }
    std::copy_n(first_action(chosen.plan), records_.record_size(), action);
    if (explanation) {
        explanation->depth = depth;
        explanation->iterations = meter.iterations();
        explanation->steps = meter.steps();
        note_candidates(*explanation, chosen);
    }
    move_on(memory, point.left);
}

// A step is made: what was found for the steps after it is where the next decision begins. Plans
// get no longer than what is left of the episode.
void Cem::move_on(Memory& memory, std::int64_t left) {
    const std::int64_t before = memory.horizon;
    memory.horizon = std::clamp<std::int64_t>(left - 1, 1, before);
    memory.distribution.shift();
    memory.distribution.shorten(memory.horizon);
    for (std::size_t k = 0; k < memory.kept_count; ++k) {
        Plan& plan = memory.kept[k];
        std::shift_left(plan.numbers.begin(), plan.numbers.end(),
                        static_cast<std::ptrdiff_t>(default_numbers_.size()));
        std::shift_left(plan.indices.begin(), plan.indices.end(),
                        static_cast<std::ptrdiff_t>(default_indices_.size()));
        end_by_noop(plan, before - 1, memory.horizon);
    }
}

}  // namespace rddlc::planners
