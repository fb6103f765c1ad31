// Poisson and binomial probabilities without cancellation, for counts of any size.
// C. Loader, "Fast and accurate computation of binomial probabilities" (2000): Stirling's error
// and the deviance, instead of differences of huge logarithms.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math.hpp>

#include <cstddef>
#include <numbers>

namespace rddl {

namespace detail {

// ln(n!) - ln(sqrt(2 pi n) (n/e)^n), for an integer n >= 1.
inline double stirling_error(double n) {
    constexpr double exact[] = {0.0,
                                0.08106146679532726,
                                0.0413406959554093,
                                0.02767792568499834,
                                0.020790672103765093,
                                0.016644691189821193,
                                0.013876128823070748,
                                0.01189670994589177,
                                0.010411265261972096,
                                0.009255462182712733,
                                0.00833056343336287,
                                0.007573675487951841,
                                0.00694284010720953,
                                0.006408994188004207,
                                0.0059513701127588475,
                                0.005554733551962801};
    if (n < 16) return exact[static_cast<std::size_t>(n)];
    const double r = 1.0 / (n * n);
    return (1.0 / 12 - (1.0 / 360 - (1.0 / 1260 - (1.0 / 1680 - r / 1188) * r) * r) * r) / n;
}

// x ln(x / mean) + mean - x, for x > 0.
inline double deviance(double x, double mean) {
    const double difference = x - mean;
    if (absolute(difference) >= 0.1 * (x + mean)) return x * ln(x / mean) - difference;
    const double v = difference / (x + mean);
    double total = difference * v;
    double power = 2.0 * x * v;
    for (int odd = 3; odd < 100; odd += 2) {
        power *= v * v;
        const double next = total + power / odd;
        if (next == total) break;
        total = next;
    }
    return total;
}

}  // namespace detail

// rate > 0, k an integer >= 0.
inline double ln_poisson_probability(double k, double rate) {
    if (k == 0) return -rate;
    return -detail::stirling_error(k) - detail::deviance(k, rate) -
           0.5 * ln(2.0 * std::numbers::pi * k);
}

// 0 < p < 1, k an integer in [0, n].
inline double ln_binomial_probability(double k, double n, double p) {
    if (k == 0) return n * ln_one_plus(-p);
    if (k == n) return n * ln(p);
    const double errors =
        detail::stirling_error(n) - detail::stirling_error(k) - detail::stirling_error(n - k);
    const double deviances = detail::deviance(k, n * p) + detail::deviance(n - k, n * (1.0 - p));
    return errors - deviances - 0.5 * ln(2.0 * std::numbers::pi * k * ((n - k) / n));
}

}  // namespace rddl
