#include "planners/cem/plan_distribution.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rddlc::planners {

using solvers::ActionSpace;
using solvers::CategoryHead;
using solvers::RealHead;

namespace {

// A distribution never forgets a value altogether: that of a fit has so much of all of them.
constexpr float least_share = 0.02f;
// And so much that of a step before.
constexpr float shifted_share = 0.1f;
// The chance that a first sub-action stops.
constexpr float first_stop = 0.2f;

bool is_changed(const ActionSpace& space, const std::int32_t* sub_actions, int count, int column) {
    for (int p = 0; p < count; ++p)
        if (space.choices[static_cast<std::size_t>(sub_actions[p])].column == column) return true;
    return false;
}

}  // namespace

Distribution::Distribution(const ActionSpace& space, Spread spread)
    : loops_(plan_loops()),
      space_(space),
      spread_(spread),
      first_probabilities_(logits()),
      fitted_(logits()),
      defaults_(indices()),
      usual_(indices()) {
    for (std::size_t k = 0; k < repetitions * reals(); ++k) {
        const auto [least, most] = number_limits(space.reals[k % reals()]);
        least_.push_back(least);
        most_.push_back(most);
    }
    for (const RealHead& head : space.reals) first_means_.push_back(middle_number(head.range));
    repeated_means_.resize(most_.size());
    repeated_deviations_.resize(most_.size());
    sums_.resize(reals());
    squares_.resize(reals());
    std::vector<float> numbers(reals());
    solvers::read_action(space_, space_.defaults.data(), numbers.data(), defaults_.data());
    if (space.max_sub_actions > 0 && logits() > 1) {
        std::ranges::fill(first_probabilities_,
                          (1 - first_stop) / static_cast<float>(logits() - 1));
        first_probabilities_.front() = first_stop;
    } else if (space.max_sub_actions > 0) {
        first_probabilities_.front() = 1;
    }
    for (const CategoryHead& head : space.categories)
        std::fill_n(first_probabilities_.begin() + head.first_logit, head.count,
                    1 / static_cast<float>(head.count));
}

void Distribution::restart(std::int64_t steps) {
    steps_ = 0;
    extend(steps);
}

void Distribution::extend(std::int64_t steps) {
    const std::int64_t before = steps_;
    if (steps <= before) return;
    steps_ = steps;
    const auto rows = static_cast<std::size_t>(steps);
    means_.resize(rows * reals());
    deviations_.resize(means_.size());
    probabilities_.resize(rows * logits());
    begin_steps(before);
}

void Distribution::shorten(std::int64_t steps) {
    if (steps >= steps_) return;
    steps_ = steps;
    const auto rows = static_cast<std::size_t>(steps);
    means_.resize(rows * reals());
    deviations_.resize(means_.size());
    probabilities_.resize(rows * logits());
}

void Distribution::begin_steps(std::int64_t from) {
    for (auto t = static_cast<std::size_t>(from); t < static_cast<std::size_t>(steps_); ++t) {
        std::ranges::copy(first_means_, means_.begin() + t * reals());
        std::ranges::copy(first_probabilities_, probabilities_.begin() + t * logits());
    }
    std::fill(deviations_.begin() + from * space_.real_count(), deviations_.end(),
              static_cast<float>(spread_.first));
}

void Distribution::shift() {
    std::shift_left(means_.begin(), means_.end(), space_.real_count());
    std::shift_left(deviations_.begin(), deviations_.end(), space_.real_count());
    std::shift_left(probabilities_.begin(), probabilities_.end(), space_.logit_count);
    widen();
    begin_steps(steps_ - 1);
}

// Toward that of a new episode.
void Distribution::widen() {
    const auto least = static_cast<float>(spread_.shifted * spread_.first);
    for (float& deviation : deviations_) deviation = std::max(deviation, least);
    for (std::size_t k = 0; k < probabilities_.size(); ++k)
        probabilities_[k] +=
            shifted_share * (first_probabilities_[k % logits()] - probabilities_[k]);
}

void Distribution::centre_on(const Plan& plan) {
    Population population(1, space_.real_count(), space_.index_count());
    population.set_steps(steps_);
    population.put(0, plan);
    constexpr std::size_t first[] = {0};
    constexpr double weight[] = {1};
    fit(population, first, weight, 0, false);
    widen();
}

void Distribution::draw(RandomStream& stream, PlanNoise& noise, Population& population) {
    const std::size_t plans = population.plans();
    noise.restart(stream);
    for (std::size_t t = 0; t < population.steps(); ++t) {
        if (reals() > 0) draw_reals(t, stream, noise, population.numbers(t));
        if (indices() == 0) continue;
        noise.next_ranks(stream);
        write_usual(t, usual_.data());
        for (std::size_t h = 0; h < space_.categories.size(); ++h)
            draw_index(t, space_.categories[h].first_logit, space_.categories[h].count, usual_[h],
                       noise, noise.ranks(h), plans, population.indices(t, h));
        const auto positions = static_cast<std::size_t>(space_.max_sub_actions);
        for (std::size_t p = 0; p < positions; ++p)
            draw_index(t, 0, space_.logit_count, usual_[p], noise, noise.ranks(p), plans,
                       population.indices(t, p));
        if (positions > 1) leave_out_repetitions(t, population);
    }
}

void Distribution::draw_reals(std::size_t step, RandomStream& stream, PlanNoise& noise,
                              float* numbers) {
    repeat(means_.data() + step * reals(), reals(), repeated_means_.data());
    repeat(deviations_.data() + step * reals(), reals(), repeated_deviations_.data());
    noise.next_numbers(stream,
                       {most_.size(), repeated_means_.data(), repeated_deviations_.data(),
                        least_.data(), most_.data()},
                       numbers);
}

void Distribution::draw_index(std::size_t step, int first_logit, int count, std::int32_t usual,
                              const PlanNoise& noise, const std::int32_t* ranks, std::size_t plans,
                              std::int32_t* chosen) {
    const float* const probabilities =
        probabilities_.data() + step * logits() + static_cast<std::size_t>(first_logit);
    double sum = 0, below = 0;
    for (int k = 0; k < count; ++k) sum += static_cast<double>(probabilities[k]);
    thresholds_.clear();
    for (int k = 0; k + 1 < count; ++k) {
        below += static_cast<double>(probabilities[k]);
        thresholds_.push_back(static_cast<std::int32_t>(below / sum * rank_count));
    }
    // No rank reaches those that fill up the halves.
    thresholds_.resize(std::bit_ceil(thresholds_.size() + 1) - 1, rank_count);
    stretched_.resize(plans);
    loops_.stretch(noise.habits(), noise.stretches(), ranks, plans, stretched_.data());
    loops_.count_reached(thresholds_.data(), thresholds_.size(), stretched_.data(), plans, chosen);
    loops_.keep_habits(noise.habits(), ranks, usual, plans, chosen);
}

// The first sub-action that stops is the last one, and a sub-action that changes the same value as
// one before it is left out.
void Distribution::leave_out_repetitions(std::size_t step, Population& population) const {
    const auto positions = static_cast<std::size_t>(space_.max_sub_actions);
    const auto column_of = [&](std::size_t position, std::size_t plan) {
        const std::int32_t choice = population.indices(step, position)[plan];
        return space_.choices[static_cast<std::size_t>(choice)].column;
    };
    for (std::size_t plan = 0; plan < population.plans(); ++plan) {
        std::size_t count = 0;
        for (std::size_t p = 0; p < positions; ++p) {
            const std::int32_t choice = population.indices(step, p)[plan];
            if (choice == 0) break;
            const int column = column_of(p, plan);
            std::size_t same = 0;
            while (same < count && column_of(same, plan) != column) ++same;
            if (same == count) population.indices(step, count++)[plan] = choice;
        }
        for (std::size_t p = count; p < positions; ++p) population.indices(step, p)[plan] = 0;
    }
}

void Distribution::middle(Plan& plan) const {
    std::copy_n(means_.begin(), means_.size(), plan.numbers.begin());
    for (std::size_t t = 0; t < static_cast<std::size_t>(steps_); ++t)
        write_usual(t, plan.indices.data() + t * indices());
}

void Distribution::write_usual(std::size_t step, std::int32_t* chosen) const {
    const float* const row = probabilities_.data() + step * logits();
    for (std::size_t h = 0; h < space_.categories.size(); ++h) {
        const float* const first = row + space_.categories[h].first_logit;
        const auto best = std::max_element(first, first + space_.categories[h].count);
        chosen[h] =
            first[defaults_[h]] == *best ? defaults_[h] : static_cast<std::int32_t>(best - first);
    }
    // The likeliest sub-actions, down to where it is likelier to stop.
    int count = 0;
    for (; count < space_.max_sub_actions; ++count) {
        std::int32_t best = 0;
        for (std::size_t c = 1; c < logits(); ++c)
            if (row[c] > row[best] && !is_changed(space_, chosen, count, space_.choices[c].column))
                best = static_cast<std::int32_t>(c);
        if (best == 0) break;
        chosen[count] = best;
    }
    if (space_.max_sub_actions > 0) std::fill(chosen + count, chosen + space_.max_sub_actions, 0);
}

void Distribution::fit(const Population& population, std::span<const std::size_t> plans,
                       std::span<const double> weights, double memory, bool keeps_deviations) {
    for (std::size_t t = 0; t < population.steps(); ++t) {
        fit_reals(population, t, plans, weights, memory, keeps_deviations);
        if (logits() > 0) fit_indices(population, t, plans, weights, memory);
    }
}

void Distribution::fit_reals(const Population& population, std::size_t step,
                             std::span<const std::size_t> plans, std::span<const double> weights,
                             double memory, bool keeps_deviations) {
    float *const means = means_.data() + step * reals(), *const deviations =
                                                             deviations_.data() + step * reals();
    // Sums of what is more than the best: no plan need be near the mean before.
    const float *const all = population.numbers(step), *const best = all + plans[0] * reals();
    loops_.add_moments({all, reals(), plans.size(), plans.data(), weights.data()}, best,
                       sums_.data(), squares_.data());
    for (std::size_t r = 0; r < reals(); ++r) {
        // The sum of the weights is 1.
        const double mean = static_cast<double>(best[r]) + sums_[r];
        const double square = std::max(squares_[r] - sums_[r] * sums_[r], 0.0);
        means[r] = static_cast<float>(memory * static_cast<double>(means[r]) + (1 - memory) * mean);
        if (keeps_deviations) continue;
        const double deviation =
            memory * static_cast<double>(deviations[r]) + (1 - memory) * std::sqrt(square);
        deviations[r] = static_cast<float>(std::max(deviation, spread_.least * spread_.first));
    }
}

void Distribution::fit_indices(const Population& population, std::size_t step,
                               std::span<const std::size_t> plans, std::span<const double> weights,
                               double memory) {
    std::ranges::fill(fitted_, 0.0f);
    for (std::size_t h = 0; h < space_.categories.size(); ++h) {
        const std::int32_t* const chosen = population.indices(step, h);
        float* const shares = fitted_.data() + space_.categories[h].first_logit;
        for (std::size_t c = 0; c < plans.size(); ++c)
            shares[chosen[plans[c]]] += static_cast<float>(weights[c]);
    }
    // A plan's sub-actions, down to the one that stops.
    for (std::size_t c = 0; c < plans.size(); ++c)
        for (int p = 0; p < space_.max_sub_actions; ++p) {
            const auto chosen = static_cast<std::size_t>(
                population.indices(step, static_cast<std::size_t>(p))[plans[c]]);
            fitted_[chosen] += static_cast<float>(weights[c]);
            if (chosen == 0) break;
        }
    float sub_actions = 0;  // on average, with the one that stops
    if (space_.max_sub_actions > 0)
        for (const float share : fitted_) sub_actions += share;
    float* const probabilities = probabilities_.data() + step * logits();
    for (std::size_t k = 0; k < logits(); ++k) {
        const float share = space_.max_sub_actions > 0 ? fitted_[k] / sub_actions : fitted_[k];
        const float fit = share + least_share * (first_probabilities_[k] - share);
        const auto part = static_cast<float>(memory);
        probabilities[k] = part * probabilities[k] + (1 - part) * fit;
    }
}

}  // namespace rddlc::planners
