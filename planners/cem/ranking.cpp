// The order of a population of plan:cem, and what the distribution learns from it.
#include "planners/cem/cem.hpp"
#include "planners/simulation/mean_and_error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace rddlc::planners {

void Cem::rank() {
    if (scenarios_ == 1) {
        std::ranges::copy(futures_.values(), values_.begin());
        std::ranges::fill(errors_, 0.0);
    } else {
        for (std::size_t c = 0; c < population_; ++c) {
            const auto found = mean_and_error(
                scenarios_, [&](std::size_t s) { return futures_.value(s * population_ + c); });
            values_[c] = found.mean;
            errors_[c] = found.error;
        }
    }
    const auto noop = std::ranges::find(origins_, Origin::Noop);
    noop_value_ = noop == origins_.end()
                      ? -std::numeric_limits<double>::infinity()
                      : values_[static_cast<std::size_t>(noop - origins_.begin())];
    sort_best();
}

namespace {

// Integers in the order of doubles, and back.
constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;
constexpr std::uint64_t ordered(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return bits & sign_bit ? ~bits : bits | sign_bit;
}
double from_ordered(std::uint64_t place) {
    return std::bit_cast<double>(place & sign_bit ? place & ~sign_bit : ~place);
}

constexpr std::uint64_t lowest = ordered(-std::numeric_limits<double>::infinity());
constexpr std::uint64_t highest = ordered(std::numeric_limits<double>::infinity());

// The search for a limit leaves its guess by longer and longer steps, until the limit lies between
// two of them, and bisects then.
std::uint64_t place_between(std::uint64_t low, std::uint64_t high, std::uint64_t step) {
    const std::uint64_t half = (high - low) / 2;
    if (low == lowest) return high - std::min(step, half);
    if (high == highest) return low + std::min(step, half);
    return low + half;
}

// A limit above which there are at least `wanted` values and, unless many are equal, few more.
// It is -inf where fewer values than that are above -inf.
double limit_of_best(const PlanLoops& loops, std::span<const double> values, std::size_t wanted,
                     double guess) {
    constexpr std::size_t few = 8;
    constexpr std::uint64_t longest = std::uint64_t{1} << 62;
    std::uint64_t low = lowest, high = highest, middle = ordered(guess);
    std::uint64_t step = std::uint64_t{1} << 46;  // about a hundredth of the guess
    while (high - low > 1) {
        const std::size_t above =
            loops.count_above(values.data(), values.size(), from_ordered(middle));
        (above < wanted ? high : low) = middle;
        if (above >= wanted && above <= wanted + few) break;
        middle = place_between(low, high, step);
        step = std::min(step, longest / 4) * 4;
    }
    return from_ordered(low);
}

}  // namespace

// As far as the order counts: mppi asks for all of it, the others for the elites, the best first.
void Cem::sort_best() {
    const std::size_t wanted =
        options_.weights == Weights::Mppi
            ? population_
            : std::max({elites(), static_cast<std::size_t>(options_.kept), most_compared});
    if (wanted < population_) {
        // Populations that follow each other are about as good.
        limit_ = limit_of_best(loops_, values_, wanted, std::isfinite(limit_) ? limit_ : 0);
        find_best(wanted);
    } else {
        limit_ = std::numeric_limits<double>::infinity();
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        ordered_ = population_;
    }
    sort_first(ordered_);
}

// Plans above the limit begin order_, and others follow until there are as many as wanted.
void Cem::find_best(std::size_t wanted) {
    // The loop has no branches, and copies of members, which it need not read again.
    const double limit = limit_;
    const double* const values = values_.data();
    std::size_t* const order = order_.data();
    std::size_t best = 0;
    for (std::size_t c = 0; c < population_; ++c) {
        order[best] = c;
        best += values[c] > limit;
    }
    // Where too few are above the limit, all others are -inf, and any of them will do.
    for (std::size_t c = 0; best < wanted; ++c)
        if (!(values[c] > limit)) order[best++] = c;
    ordered_ = best;
}

// So many of order_, which are in the order of plans. Few are ordered by counting: a sort guesses
// each of its comparisons, and is wrong half of the time.
void Cem::sort_first(std::size_t count) {
    constexpr std::size_t most_counted = 64;
    if (count > most_counted) {
        std::stable_sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(count),
                         [this](std::size_t a, std::size_t b) { return values_[a] > values_[b]; });
        return;
    }
    double values[most_counted];
    std::size_t plans[most_counted], before[most_counted];
    for (std::size_t k = 0; k < count; ++k) {
        plans[k] = order_[k];
        values[k] = values_[plans[k]];
    }
    loops_.count_before(values, count, before);
    for (std::size_t k = 0; k < count; ++k) order_[before[k]] = plans[k];
}

std::size_t Cem::elites() const {
    return static_cast<std::size_t>(std::ceil(options_.elites * static_cast<double>(population_)));
}

// Plans that are not among the best follow them, in the order of the population.
void Cem::add_others() {
    std::ranges::fill(is_ordered_, std::uint8_t{0});
    for (std::size_t k = 0; k < ordered_; ++k) is_ordered_[order_[k]] = 1;
    for (std::size_t c = 0; c < population_; ++c)
        if (!is_ordered_[c]) order_[ordered_++] = c;
}

// Whether at most half of the population is as good.
bool Cem::is_above_median(double value) const {
    if (value > limit_ && ordered_ <= population_ / 2) return true;
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
        auto end = order_.begin() + static_cast<std::ptrdiff_t>(elites());
        if (!is_above_median(values_[*(end - 1)]))
            end = std::partition_point(order_.begin(), end, [this](std::size_t plan) {
                return is_above_median(values_[plan]);
            });
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
    ordered_ = population_;
    for (std::size_t c = 0; c < population_; ++c) {
        const bool is_kept = c < memory.kept_count;
        values_[c] =
            is_kept ? memory.kept_values[c].first : -std::numeric_limits<double>::infinity();
        errors_[c] = is_kept ? memory.kept_values[c].second : 0;
    }
}

}  // namespace rddlc::planners
