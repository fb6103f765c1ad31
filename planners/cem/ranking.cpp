// The order of a population of plan:cem, and what the distribution learns from it.
#include "planners/cem/cem.hpp"
#include "planners/simulation/mean_and_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rddlc::planners {

void Cem::rank() {
    noop_value_ = -std::numeric_limits<double>::infinity();  // where it has no place
    for (std::size_t c = 0; c < population_; ++c) {
        const auto found = mean_and_error(
            scenarios_, [&](std::size_t s) { return futures_.value(s * population_ + c); });
        values_[c] = found.mean;
        errors_[c] = found.error;
        if (origins_[c] == Origin::Noop) noop_value_ = found.mean;
    }
    sort_best();
}

// As far as the order counts: mppi asks for all of it, the others for the elites, the best first.
void Cem::sort_best() {
    const auto is_better = [](const Ranked& a, const Ranked& b) {
        return a.value > b.value || (a.value == b.value && a.plan < b.plan);
    };
    ranked_.clear();
    for (std::size_t c = 0; c < population_; ++c) ranked_.push_back({values_[c], c});
    const std::size_t wanted =
        options_.weights == Weights::Mppi
            ? population_
            : std::max({elites(), static_cast<std::size_t>(options_.kept), most_compared});
    const auto end = ranked_.begin() + static_cast<std::ptrdiff_t>(std::min(wanted, population_));
    if (end < ranked_.end()) std::nth_element(ranked_.begin(), end, ranked_.end(), is_better);
    std::sort(ranked_.begin(), end, is_better);
    for (std::size_t k = 0; k < population_; ++k) order_[k] = ranked_[k].plan;
}

std::size_t Cem::elites() const {
    return static_cast<std::size_t>(std::ceil(options_.elites * static_cast<double>(population_)));
}

// Whether at most half of the population is as good.
bool Cem::is_above_median(double value) const {
    const auto as_good = std::ranges::count_if(values_, [=](double v) { return v >= value; });
    return static_cast<std::size_t>(as_good) <= population_ / 2;
}

// Toward the elites, of which each is better than the median of the population: where most are
// alike, nothing is to be learned from those.
void Cem::refit(Memory& memory) {
    const double best = values_[order_.front()];
    if (!is_above_median(best)) return;
    fitted_.clear();
    weights_.clear();
    if (options_.weights == Weights::Elites) {
        const auto end = std::partition_point(
            order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(elites()),
            [this](std::size_t plan) { return is_above_median(values_[plan]); });
        fitted_.assign(order_.begin(), end);
        weights_.assign(fitted_.size(), 1);
    } else {
        const auto finite =
            std::ranges::count_if(values_, [](double v) { return std::isfinite(v); });
        const auto spread = mean_and_error(static_cast<std::size_t>(finite),
                                           [&](std::size_t k) { return values_[order_[k]]; });
        const double scale = std::max(
            options_.temperature * spread.error * std::sqrt(static_cast<double>(finite)), 1e-300);
        for (std::size_t k = 0; k < static_cast<std::size_t>(finite); ++k) {
            fitted_.push_back(order_[k]);
            weights_.push_back(std::exp((values_[order_[k]] - best) / scale));
        }
    }
    const double sum = std::accumulate(weights_.begin(), weights_.end(), 0.0);
    for (double& weight : weights_) weight /= sum;
    memory.distribution.fit(plans_, fitted_, weights_, options_.memory,
                            options_.weights == Weights::Mppi);
}

void Cem::keep_best(Memory& memory) {
    memory.kept_count = memory.kept.size();
    for (std::size_t k = 0; k < memory.kept_count; ++k) {
        end_by_noop(memory.kept[k], static_cast<std::int64_t>(plans_.steps()), memory.horizon);
        plans_.get(order_[k], memory.kept[k]);
        memory.kept_values[k] = {values_[order_[k]], errors_[order_[k]]};
    }
}

// A population that was not played to its end counts only with the plans that were kept before.
void Cem::rank_kept(const Memory& memory) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    for (std::size_t c = 0; c < population_; ++c) {
        const bool is_kept = c < memory.kept_count;
        values_[c] =
            is_kept ? memory.kept_values[c].first : -std::numeric_limits<double>::infinity();
        errors_[c] = is_kept ? memory.kept_values[c].second : 0;
    }
}

}  // namespace rddlc::planners
