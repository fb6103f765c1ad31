// The numbers that are accepted as probabilities and weights.
//
// Rounding may bring a probability a little out of [0, 1]: 0.1 / (0.8 - 0.3 - 0.4) is 1 + 9e-16. It
// counts as the bound that it passed. nan is not a probability.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/values/ops.hpp>

#include <type_traits>

namespace rddl {

// Counts with a smaller mean are found by a walk up their distribution function.
inline constexpr double largest_walked_mean = 10;

// How far out; floats round 5e8 times as coarsely as doubles.
template <class Element>
inline constexpr Element probability_rounding = std::is_same_v<Element, float> ? Element(1e-5)
                                                                               : Element(1e-9);

// Whether it may be one of the weights whose sum, of those above 0, is that.
template <class L>
RDDL_INLINE typename L::Bool is_weight(typename L::Real w, typename L::Real sum) {
    constexpr auto rounding = probability_rounding<typename L::Element>;
    return w >= typename L::Real{-rounding} * sum;
}

template <class L>
RDDL_INLINE typename L::Bool is_probability(typename L::Real p) {
    constexpr auto rounding = probability_rounding<typename L::Element>;
    return is_weight<L>(p, typename L::Real{1}) && p <= typename L::Real{1 + rounding};
}

template <class L>
RDDL_INLINE typename L::Bool is_positive_probability(typename L::Real p) {
    return p > 0.0 && is_probability<L>(p);
}

// Requires is_probability().
template <class Real>
RDDL_INLINE Real clamp_probability(Real p) {
    return maximum(Real{0}, minimum(p, Real{1}));
}

}  // namespace rddl
