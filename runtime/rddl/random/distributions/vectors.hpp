// Random vectors of n elements. Laws, checks and sources: docs/distributions.md.
//
// Vectors are anything with elements [i], matrices with [i][j] (linear_algebra.hpp). A parameter
// outside its domain records a fault and draws zeros.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/random/distributions/binomial.hpp>
#include <rddl/random/distributions/gamma.hpp>
#include <rddl/random/distributions/normal_quantile.hpp>
#include <rddl/random/distributions/probability.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/ops.hpp>

#include <cstdint>
#include <limits>

namespace rddl::sample {

namespace detail {

// mean + L z in place of z, from the last element up, since each needs those before it.
template <class Mean, class Factor, class Draw>
void correlate(Index n, const Mean& mean, const Factor& factor, Draw& draw) {
    for (Index i = n - 1; i >= 0; --i) {
        double total = 0.0;
        for (Index j = 0; j <= i; ++j) total = total + factor[i][j] * draw[j];
        draw[i] = mean[i] + total;
    }
}

// cholesky() gives nan for what is not positive definite.
template <class L, class Factor>
bool require_factor(Context<L>& context, Place place, Index n, const Factor& factor) {
    return n == 0 || context.require(!is_nan(factor[0][0]), FaultKind::Covariance, place, 0.0);
}

template <class Draw>
void fill_vector(Index n, Draw& draw) {
    for (Index i = 0; i < n; ++i) draw[i] = {};
}

}  // namespace detail

// `factor` is the Cholesky factor of the covariance.
template <class L, class Mean, class Factor, class Draw>
void multivariate_normal(Context<L>& context, Place place, Index n, const Mean& mean,
                         const Factor& factor, Draw& draw) {
    if (!detail::require_factor(context, place, n, factor)) return detail::fill_vector(n, draw);
    Draws draws(context, place);
    for (Index i = 0; i < n; ++i) draw[i] = normal_quantile(draws.open_uniform());
    detail::correlate(n, mean, factor, draw);
}

// The method of pyRDDLGym: mean + L z with independent t components z.
template <class L, class Mean, class Factor, class Draw>
void multivariate_student(Context<L>& context, Place place, Index n, typename L::Real degrees,
                          const Mean& mean, const Factor& factor, Draw& draw) {
    const bool has_degrees =
        context.require(degrees > 0.0, FaultKind::DegreesOfFreedom, place, degrees);
    if (!detail::require_factor(context, place, n, factor) || !has_degrees)
        return detail::fill_vector(n, draw);
    Draws draws(context, place);
    for (Index i = 0; i < n; ++i) draw[i] = standard_student(draws, degrees);
    detail::correlate(n, mean, factor, draw);
}

// Gamma draws divided by their sum, by logarithms: of small weights all might underflow.
template <class L, class Weights, class Draw>
void dirichlet(Context<L>& context, Place place, Index n, const Weights& weights, Draw& draw) {
    bool valid = true;
    double greatest_weight = 0.0;
    for (Index i = 0; i < n; ++i) {
        valid = context.require(weights[i] > 0.0, FaultKind::PositiveWeight, place, weights[i]) &&
                valid;
        greatest_weight = maximum(greatest_weight, double(weights[i]));
    }
    if (!valid) return detail::fill_vector(n, draw);
    Draws draws(context, place);
    const double factor = raised_shapes(greatest_weight);
    double greatest = -std::numeric_limits<double>::infinity();
    for (Index i = 0; i < n; ++i) {
        draw[i] = ln_standard_gamma(draws, factor * weights[i]);
        greatest = maximum(greatest, draw[i]);
    }
    double total = 0.0;
    for (Index i = 0; i < n; ++i) {
        draw[i] = exp(draw[i] - greatest);
        total = total + draw[i];
    }
    for (Index i = 0; i < n; ++i) draw[i] = draw[i] / total;
}

// Each count is binomial given those before it. The last category of positive probability gets what
// is left, so that no other one does by rounding. Before it, what is left of the sum of
// probabilities may round to less than a probability is.
template <class L, class Probabilities, class Draw>
void multinomial(Context<L>& context, Place place, Index n, typename L::Int trials,
                 const Probabilities& probabilities, Draw& draw) {
    detail::fill_vector(n, draw);
    bool valid = context.require(trials >= 0, FaultKind::Trials, place, to_real(trials));
    double total = 0.0;
    Index last = 0;
    for (Index i = 0; i < n; ++i) {
        const double p = probabilities[i];
        valid =
            context.require(is_weight<L>(p, typename L::Real{1}), FaultKind::Weight, place, p) &&
            valid;
        total = total + maximum(p, 0.0);
        if (p > 0.0) last = i;
    }
    valid = context.require(absolute(total - 1.0) <= 1.001e-5, FaultKind::ProbabilitySum, place,
                            total) &&
            valid;
    if (!valid) return;
    Draws draws(context, place);
    std::int64_t left = trials;
    for (Index i = 0; i < last; ++i) {
        const double p = probabilities[i];
        if (p <= 0.0) continue;
        draw[i] = standard_binomial(draws, left, p < total ? p / total : 1.0);
        left = left - draw[i];
        total = total - p;
    }
    draw[last] = left;
}

}  // namespace rddl::sample
