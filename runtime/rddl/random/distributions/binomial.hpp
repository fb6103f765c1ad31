// The binomial distribution. Laws, checks and sources: docs/distributions.md.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/random/distributions/probability.hpp>
#include <rddl/random/distributions/saddle_point.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/ops.hpp>

#include <cmath>
#include <cstdint>

namespace rddl {

namespace detail {

// Walks up the distribution function; n p < 10, so that ending at 110 loses 1e-60.
inline std::int64_t binomial_by_inversion(Draws& draws, std::int64_t n, double p) {
    const double odds = p / (1.0 - p);
    const std::int64_t last = minimum(n, std::int64_t{110});
    double rest = draws.uniform();
    double probability = exp(to_real(n) * ln_one_plus(-p));
    std::int64_t k = 0;
    while (rest >= probability && k < last) {
        rest -= probability;
        probability *= odds * (to_real(n - k) / to_real(k + 1));
        ++k;
    }
    return k;
}

// W. Hoermann, "The generation of binomial random variates", Journal of Statistical Computation
// and Simulation 46 (1993), 101-110: algorithm BTRS; p <= 1/2, n p >= 10.
inline std::int64_t binomial_by_rejection(Draws& draws, std::int64_t trials, double p) {
    const double n = to_real(trials);
    const double deviation = sqrt(n * p * (1.0 - p));
    const double b = 1.15 + 2.53 * deviation;
    const double a = -0.0873 + 0.0248 * b + 0.01 * p;
    const double alpha = (2.83 + 5.1 / b) * deviation;
    const double quick_limit = 0.92 - 4.2 / b;
    const double ln_mode_probability = ln_binomial_probability(std::floor((n + 1.0) * p), n, p);
    for (int attempt = 0; attempt < rejection_limit; ++attempt) {
        const double u = draws.open_uniform() - 0.5;
        const double v = draws.open_uniform();
        const double distance = 0.5 - absolute(u);
        const double k = std::floor((2.0 * a / distance + b) * u + n * p + 0.5);
        if (k < 0 || k > n) continue;
        const bool quick = distance >= 0.07 && v <= quick_limit;
        const double height = v * alpha / (a / (distance * distance) + b);
        if (quick || ln(height) <= ln_binomial_probability(k, n, p) - ln_mode_probability)
            return minimum(truncate_to_int(k), trials);
    }
    return truncate_to_int(n * p);
}

// p <= 1/2.
inline std::int64_t binomial_of_rare(Draws& draws, std::int64_t n, double p) {
    return to_real(n) * p < largest_walked_mean ? binomial_by_inversion(draws, n, p)
                                                : binomial_by_rejection(draws, n, p);
}

}  // namespace detail

// n >= 0, 0 <= p <= 1. Successes or failures are drawn, whichever are rarer.
inline std::int64_t standard_binomial(Draws& draws, std::int64_t n, double p) {
    return p <= 0.5 ? detail::binomial_of_rare(draws, n, p)
                    : n - detail::binomial_of_rare(draws, n, 1.0 - p);
}

namespace sample {

template <class L>
typename L::Int binomial(Context<L>& context, Place place, typename L::Int n, typename L::Real p) {
    const auto n_is_valid = context.require(n >= 0, FaultKind::Trials, place, to_real(n));
    const auto p_is_valid = context.require(is_probability<L>(p), FaultKind::Probability, place, p);
    return draw_in_each_lane(context, place, n_is_valid && p_is_valid, standard_binomial, n,
                             clamp_probability(p));
}

}  // namespace sample

}  // namespace rddl
