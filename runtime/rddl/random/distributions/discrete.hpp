// Discrete distributions by inversion, one uniform number each. Laws, checks and sources:
// docs/distributions.md.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/random/distributions/guide_table.hpp>
#include <rddl/random/distributions/probability.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/ops.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace rddl::sample {

// U < p, with U in [0, 1): never true for p <= 0, always for p >= 1.
template <class L, class SomePlace = Place>
RDDL_INLINE typename L::Bool bernoulli(Context<L>& context, SomePlace place, typename L::Real p) {
    const auto valid = context.require(is_probability<L>(p), FaultKind::Probability, place, p);
    return valid && uniform_at(context, place) < p;
}
// The same for what is known to be a probability.
template <class L, class SomePlace = Place>
RDDL_INLINE typename L::Bool valid_bernoulli(Context<L>& context, SomePlace place,
                                             typename L::Real p) {
    return uniform_at(context, place) < p;
}

// Trials up to the first success: 1, 2, ...; counts beyond int become the greatest int.
template <class L, class SomePlace = Place>
typename L::Int geometric(Context<L>& context, SomePlace place, typename L::Real p) {
    using Int = typename L::Int;
    const auto valid =
        context.require(is_positive_probability<L>(p), FaultKind::PositiveProbability, place, p);
    const auto failures = ln(open_uniform_at(context, place)) / ln_one_plus(-clamp_probability(p));
    const Int trials = select(failures < 0x1p63, wrap_add(floor(failures), Int{1}),
                              Int{std::numeric_limits<std::int64_t>::max()});
    return select(valid, trials, Int{0});
}

// An index below n with probability weight(i). The weights must sum to 1 up to 1.001e-5 (numpy's
// allclose, as in pyRDDLGym) and are not renormalised: index 0 gets what is missing. A weight that
// rounding made negative is never chosen, as the sum does not grow by it.
template <class L, class Weight, class SomePlace = Place>
typename L::Int discrete_over(Context<L>& context, SomePlace place, Index n, Weight&& weight) {
    using Int = typename L::Int;
    using Real = typename L::Real;
    const Real u = uniform_at(context, place);
    Real total{0};
    Int chosen{n};
    typename L::Bool valid{true};
    for (Index i = 0; i < n; ++i) {
        const Real w = weight(i);
        valid = context.require(is_weight<L>(w, Real{1}), FaultKind::Weight, place, w) && valid;
        total = total + w;
        chosen = select(chosen == n && u < total, Int{i}, chosen);
    }
    const auto sums_to_one = context.require(absolute(total - Real{1}) <= Real{1.001e-5},
                                             FaultKind::ProbabilitySum, place, total);
    return select(valid && sums_to_one && chosen < n, chosen, Int{0});
}

// The same with weights of any positive, finite sum. They are evaluated twice; the second time,
// the last index of positive weight with no more than U * sum before it is chosen. Of the weights,
// the first nan, or else the least, is what a fault names.
template <class L, class Weight, class SomePlace = Place>
typename L::Int unnormalised_discrete_over(Context<L>& context, SomePlace place, Index n,
                                           Weight&& weight) {
    using Int = typename L::Int;
    using Real = typename L::Real;
    Real total{0};
    Real above_zero{0};
    Real least{0};
    for (Index i = 0; i < n; ++i) {
        const Real w = weight(i);
        least = select(!(w >= least) && least == least, w, least);
        above_zero = above_zero + maximum(w, Real{0});
        total = total + w;
    }
    const auto valid =
        context.require(is_weight<L>(least, above_zero), FaultKind::Weight, place, least);
    const auto has_mass =
        context.require(total > 0.0 && total <= std::numeric_limits<typename L::Element>::max(),
                        FaultKind::WeightSum, place, total);
    const Real threshold = uniform_at(context, place) * total;
    Real before{0};
    Int chosen{0};
    for (Index i = 0; i < n; ++i) {
        const Real w = weight(i);
        chosen = select(w > 0.0 && before <= threshold, Int{i}, chosen);
        before = before + w;
    }
    return select(valid && has_mass, chosen, Int{0});
}

namespace detail {

// The length of the rows of nested arrays, their last dimension.
template <class T>
struct RowLength;
template <class T, std::size_t n>
struct RowLength<std::array<T, n>> {
    static constexpr Index value = static_cast<Index>(n);
};
template <class T, std::size_t m, std::size_t n>
struct RowLength<std::array<std::array<T, m>, n>> : RowLength<std::array<T, m>> {};

inline constexpr Index most_counted = 8;  // longer rows are searched

}  // namespace detail

// How many thresholds of a row are at most U: an index with as many probabilities as there are
// intervals between them. The indices of the row are in range in the active lanes.
template <const auto& thresholds, class L, class SomePlace = Place, class... Row>
RDDL_INLINE typename L::Int interval(Context<L>& context, SomePlace place, const Row&... row) {
    using Int = typename L::Int;
    constexpr Index size = detail::RowLength<std::remove_cvref_t<decltype(thresholds)>>::value;
    const auto u = uniform_at(context, place);
    if constexpr (size > detail::most_counted && sizeof...(row) == 0)
        if constexpr (detail::GuideTable<thresholds>::parts > 0)
            return detail::GuideTable<thresholds>::template count<Int>(u);
    const auto is_at_most = [&](const auto& i) RDDL_INLINE_LAMBDA {
        return at(thresholds, in_range(context, row)..., i) <= u;
    };
    Int count{0};
    if constexpr (size <= detail::most_counted) {
        for (Index i = 0; i < size; ++i) count = wrap_add(count, to_int(is_at_most(i)));
    } else {
        for (Index length = size; length > 0; length /= 2) {
            const Index half = (length + 1) / 2;
            const auto middle = wrap_add(count, Int{half - 1});
            count = select(is_at_most(middle), wrap_add(count, Int{half}), count);
        }
    }
    return count;
}

template <class L, std::size_t n, class SomePlace = Place>
typename L::Int discrete(Context<L>& context, SomePlace place,
                         const std::array<typename L::Real, n>& weights) {
    return discrete_over(context, place, n, [&weights](Index i) { return weights[i]; });
}

template <class L, std::size_t n, class SomePlace = Place>
typename L::Int unnormalised_discrete(Context<L>& context, SomePlace place,
                                      const std::array<typename L::Real, n>& weights) {
    return unnormalised_discrete_over(context, place, n,
                                      [&weights](Index i) { return weights[i]; });
}

}  // namespace rddl::sample
