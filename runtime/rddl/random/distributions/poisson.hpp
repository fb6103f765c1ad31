// The Poisson distribution and its gamma mixture. Laws, checks and sources: docs/distributions.md.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/random/distributions/gamma.hpp>
#include <rddl/random/distributions/probability.hpp>
#include <rddl/random/distributions/saddle_point.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/ops.hpp>

#include <cmath>
#include <cstdint>

namespace rddl {

// Above it a draw might not fit an int.
inline constexpr double largest_poisson_rate = 9.2e18;

namespace detail {

// Walks up the distribution function; rate < 10, so that ending at 100 loses 1e-60.
inline std::int64_t poisson_by_inversion(Draws& draws, double rate) {
    double rest = draws.uniform();
    double probability = exp(-rate);
    std::int64_t k = 0;
    while (rest >= probability && k < 100) {
        rest -= probability;
        ++k;
        probability *= rate / to_real(k);
    }
    return k;
}

// W. Hoermann, "The transformed rejection method for generating Poisson random variables",
// Insurance: Mathematics and Economics 12 (1993), 39-45: algorithm PTRS; rate >= 10.
inline std::int64_t poisson_by_rejection(Draws& draws, double rate) {
    const double b = 0.931 + 2.53 * sqrt(rate);
    const double a = -0.059 + 0.02483 * b;
    const double inverse_alpha = 1.1239 + 1.1328 / (b - 3.4);
    const double quick_limit = 0.9277 - 3.6224 / (b - 2.0);
    for (int attempt = 0; attempt < rejection_limit; ++attempt) {
        const double u = draws.open_uniform() - 0.5;
        const double v = draws.open_uniform();
        const double distance = 0.5 - absolute(u);
        const double k = std::floor((2.0 * a / distance + b) * u + rate + 0.43);
        if (distance >= 0.07 && v <= quick_limit) return truncate_to_int(k);
        if (k < 0 || (distance < 0.013 && v > distance)) continue;
        const double height = ln(v * inverse_alpha / (a / (distance * distance) + b));
        if (height <= ln_poisson_probability(k, rate)) return truncate_to_int(k);
    }
    return truncate_to_int(rate);
}

}  // namespace detail

// 0 <= rate <= largest_poisson_rate.
inline std::int64_t standard_poisson(Draws& draws, double rate) {
    return rate < largest_walked_mean ? detail::poisson_by_inversion(draws, rate)
                                      : detail::poisson_by_rejection(draws, rate);
}

namespace sample {

template <class L>
typename L::Int poisson(Context<L>& context, Place place, typename L::Real rate) {
    const auto valid =
        context.require(rate >= 0.0 && rate <= largest_poisson_rate, FaultKind::Rate, place, rate);
    return draw_in_each_lane(context, place, valid, standard_poisson, rate);
}

// Failures before the r-th success: a Poisson count whose rate is a gamma draw. r may be real.
template <class L>
typename L::Int negative_binomial(Context<L>& context, Place place, typename L::Real r,
                                  typename L::Real p) {
    constexpr std::int64_t too_large = -1;
    const auto r_is_valid = context.require(r > 0.0, FaultKind::Successes, place, r);
    const auto p_is_valid =
        context.require(is_positive_probability<L>(p), FaultKind::PositiveProbability, place, p);
    const auto valid = r_is_valid && p_is_valid;
    const typename L::Real chance = clamp_probability(p);
    const auto draw_rate = [](Draws& draws, double shape, double probability) {
        return standard_gamma(draws, shape) * ((1.0 - probability) / probability);
    };
    const auto draw_count = [draw_rate](Draws& draws, double shape, double probability) {
        const double rate = draw_rate(draws, shape, probability);
        return rate <= largest_poisson_rate ? standard_poisson(draws, rate) : too_large;
    };
    using Int = typename L::Int;
    const Int count = draw_in_each_lane(context, place, valid, draw_count, r, chance);
    if (any(count == Int{too_large}))
        context.require(count != Int{too_large}, FaultKind::CountTooLarge, place,
                        draw_in_each_lane(context, place, valid, draw_rate, r, chance));
    return maximum(count, Int{0});
}

}  // namespace sample

}  // namespace rddl
