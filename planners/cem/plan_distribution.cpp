#include "planners/cem/plan_distribution.hpp"

#include <algorithm>
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

// The share of the normal distribution below x, within a hundredth.
float share_below(float x) {
    return 1 / (1 + std::exp(-1.702f * x));
}

std::int32_t place_in(const float* cumulative, std::size_t count, float share) {
    const float* const end = cumulative + count;
    const float* const found = std::upper_bound(cumulative, end, share * end[-1]);
    return static_cast<std::int32_t>(
        std::min<std::ptrdiff_t>(found - cumulative, static_cast<std::ptrdiff_t>(count) - 1));
}

bool is_changed(const ActionSpace& space, const std::int32_t* sub_actions, int count, int column) {
    for (int p = 0; p < count; ++p)
        if (space.choices[static_cast<std::size_t>(sub_actions[p])].column == column) return true;
    return false;
}

}  // namespace

Distribution::Distribution(const ActionSpace& space, Spread spread)
    : space_(space),
      spread_(spread),
      first_means_(reals(), 0.0f),
      first_probabilities_(logits()),
      fitted_(logits()),
      latent_(reals() + indices()) {
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
    cumulative_.resize(probabilities_.size());
    begin_steps(before);
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
    const auto least = static_cast<float>(spread_.shifted * spread_.first);
    for (float& deviation : deviations_) deviation = std::max(deviation, least);
    for (std::size_t k = 0; k < probabilities_.size(); ++k)
        probabilities_[k] +=
            shifted_share * (first_probabilities_[k % logits()] - probabilities_[k]);
    begin_steps(steps_ - 1);
}

void Distribution::prepare() {
    const auto add_up = [&](std::size_t first, std::size_t count) {
        float sum = 0;
        for (std::size_t k = first; k < first + count; ++k)
            cumulative_[k] = sum += probabilities_[k];
    };
    for (std::size_t t = 0; t < static_cast<std::size_t>(steps_); ++t) {
        if (space_.max_sub_actions > 0) add_up(t * logits(), logits());
        for (const CategoryHead& head : space_.categories)
            add_up(t * logits() + static_cast<std::size_t>(head.first_logit),
                   static_cast<std::size_t>(head.count));
    }
}

void Distribution::draw(RandomStream& stream, double correlation, Plan& plan) const {
    const auto old = static_cast<float>(correlation);
    const auto fresh = static_cast<float>(std::sqrt(1 - correlation * correlation));
    float* const latent = latent_.data();
    for (std::size_t t = 0; t < static_cast<std::size_t>(steps_); ++t) {
        for (float& noise : latent_)
            noise = t == 0 ? stream.bell() : old * noise + fresh * stream.bell();
        const std::size_t row = t * reals();
        for (std::size_t r = 0; r < reals(); ++r) {
            float number = means_[row + r] + deviations_[row + r] * latent[r];
            if (space_.reals[r].range == RealHead::Range::Bounded)
                number = std::clamp(number, -1.0f, 1.0f);
            plan.numbers[row + r] = number;
        }
        const float* const cumulative = cumulative_.data() + t * logits();
        std::int32_t* const chosen = plan.indices.data() + t * indices();
        if (space_.max_sub_actions > 0)
            draw_sub_actions(latent + reals(), cumulative, chosen);
        else
            draw_categories(latent + reals(), cumulative, chosen);
    }
}

void Distribution::draw_categories(const float* latent, const float* cumulative,
                                   std::int32_t* chosen) const {
    for (std::size_t h = 0; h < space_.categories.size(); ++h) {
        const CategoryHead& head = space_.categories[h];
        chosen[h] = place_in(cumulative + head.first_logit, static_cast<std::size_t>(head.count),
                             share_below(latent[h]));
    }
}

// A sub-action that changes the same value as one before it is left out.
void Distribution::draw_sub_actions(const float* latent, const float* cumulative,
                                    std::int32_t* chosen) const {
    int count = 0;
    for (int p = 0; p < space_.max_sub_actions; ++p) {
        const std::int32_t choice =
            place_in(cumulative, logits(), share_below(latent[static_cast<std::size_t>(p)]));
        if (choice == 0) break;
        const int column = space_.choices[static_cast<std::size_t>(choice)].column;
        if (!is_changed(space_, chosen, count, column)) chosen[count++] = choice;
    }
    std::fill(chosen + count, chosen + space_.max_sub_actions, 0);
}

void Distribution::middle(Plan& plan) const {
    std::copy_n(means_.begin(), means_.size(), plan.numbers.begin());
    for (std::size_t t = 0; t < static_cast<std::size_t>(steps_); ++t) {
        const float* const row = probabilities_.data() + t * logits();
        std::int32_t* const chosen = plan.indices.data() + t * indices();
        for (std::size_t h = 0; h < space_.categories.size(); ++h) {
            const float* const first = row + space_.categories[h].first_logit;
            chosen[h] = static_cast<std::int32_t>(
                std::max_element(first, first + space_.categories[h].count) - first);
        }
        // The likeliest sub-actions, down to where it is likelier to stop.
        int count = 0;
        for (; count < space_.max_sub_actions; ++count) {
            std::int32_t best = 0;
            for (std::size_t c = 1; c < logits(); ++c)
                if (row[c] > row[best] &&
                    !is_changed(space_, chosen, count, space_.choices[c].column))
                    best = static_cast<std::int32_t>(c);
            if (best == 0) break;
            chosen[count] = best;
        }
        if (space_.max_sub_actions > 0)
            std::fill(chosen + count, chosen + space_.max_sub_actions, 0);
    }
}

void Distribution::fit(std::span<const Plan* const> plans, std::span<const double> weights,
                       double memory, bool keeps_deviations) {
    for (std::int64_t t = 0; t < steps_; ++t) {
        fit_reals(t, plans, weights, memory, keeps_deviations);
        if (logits() > 0) fit_indices(t, plans, weights, memory);
    }
}

void Distribution::fit_reals(std::int64_t step, std::span<const Plan* const> plans,
                             std::span<const double> weights, double memory,
                             bool keeps_deviations) {
    const std::size_t row = static_cast<std::size_t>(step) * reals();
    for (std::size_t k = row; k < row + reals(); ++k) {
        double mean = 0, square = 0;
        for (std::size_t c = 0; c < plans.size(); ++c)
            mean += weights[c] * static_cast<double>(plans[c]->numbers[k]);
        for (std::size_t c = 0; c < plans.size(); ++c) {
            const double difference = static_cast<double>(plans[c]->numbers[k]) - mean;
            square += weights[c] * difference * difference;
        }
        means_[k] =
            static_cast<float>(memory * static_cast<double>(means_[k]) + (1 - memory) * mean);
        if (keeps_deviations) continue;
        const double deviation =
            memory * static_cast<double>(deviations_[k]) + (1 - memory) * std::sqrt(square);
        deviations_[k] = static_cast<float>(std::max(deviation, spread_.least * spread_.first));
    }
}

void Distribution::fit_indices(std::int64_t step, std::span<const Plan* const> plans,
                               std::span<const double> weights, double memory) {
    const std::size_t row = static_cast<std::size_t>(step) * indices();
    std::ranges::fill(fitted_, 0.0f);
    for (std::size_t c = 0; c < plans.size(); ++c) {
        const std::int32_t* const chosen = plans[c]->indices.data() + row;
        const auto weight = static_cast<float>(weights[c]);
        for (std::size_t h = 0; h < space_.categories.size(); ++h)
            fitted_[static_cast<std::size_t>(space_.categories[h].first_logit + chosen[h])] +=
                weight;
        for (int p = 0; p < space_.max_sub_actions; ++p) {
            fitted_[static_cast<std::size_t>(chosen[p])] += weight;
            if (chosen[p] == 0) break;
        }
    }
    float sub_actions = 0;  // on average, with the one that stops
    if (space_.max_sub_actions > 0)
        for (const float share : fitted_) sub_actions += share;
    float* const probabilities = probabilities_.data() + static_cast<std::size_t>(step) * logits();
    for (std::size_t k = 0; k < logits(); ++k) {
        const float share = space_.max_sub_actions > 0 ? fitted_[k] / sub_actions : fitted_[k];
        const float fit = share + least_share * (first_probabilities_[k] - share);
        const auto part = static_cast<float>(memory);
        probabilities[k] = part * probabilities[k] + (1 - part) * fit;
    }
}

}  // namespace rddlc::planners
