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

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

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
    const auto sums_to_one = context.require(
        absolute(total - Real{1}) <= Real{static_cast<typename L::Element>(1.001e-5)},
        FaultKind::ProbabilitySum, place, total);
    return select(valid && sums_to_one && chosen < n, chosen, Int{0});
}

namespace detail {

// Whether a condition holds where values are used.
template <class R>
RDDL_INLINE bool holds_where_used(const Context<ScalarOf<R>>&, bool condition) {
    return condition;
}
template <class L, int n>
RDDL_INLINE bool holds_where_used(const Context<L>& context, const Mask<n>& condition) {
    return all(condition || !context.active);
}

// The part of a total by which sums of its n shares may differ, and U times the total: more than
// 4 n + 4 roundings, of which each is at most epsilon / 2.
template <class Number>
constexpr Number rounding_of_shares(Index n) {
    return static_cast<Number>(2 * n + 8) * std::numeric_limits<Number>::epsilon();
}
// Less than this rounds by more.
template <class Number>
inline constexpr Number least_total =
    std::numeric_limits<Number>::min() / std::numeric_limits<Number>::epsilon();

// How many sums of weights are at most a limit that lies between `low` and `high`, and whether that
// is certain: no sum lies between them, nor is anything nan. Sums of weights that are not negative
// never fall, so packs ask whether the first one above `low` is above `high` as well.
template <class L>
class PassedSums {
    using Int = typename L::Int;
    using Real = typename L::Real;

  public:
    RDDL_INLINE PassedSums(const Real& low, const Real& high) : low_(low), high_(high) {}
    RDDL_INLINE void add(const Real& sum) {
        next_ = select(is_passed_, sum, next_);
        is_passed_ = sum <= low_;
        count_ = wrap_add(count_, to_int(is_passed_));
    }
    RDDL_INLINE Int count() const { return count_; }
    RDDL_INLINE auto is_certain() const { return high_ < next_; }

  private:
    Real low_, high_, next_{0};
    Int count_{0};
    typename L::Bool is_passed_{true};
};
// For one environment, where compilers make jumps of selects, both counts are compared.
template <class R>
class PassedSums<ScalarOf<R>> {
  public:
    RDDL_INLINE PassedSums(R low, R high) : low_(low), high_(high) {}
    RDDL_INLINE void add(R sum) {
        count_ += sum <= low_;
        most_ += sum <= high_;
    }
    RDDL_INLINE std::int64_t count() const { return count_; }
    RDDL_INLINE bool is_certain() const { return count_ == most_ && low_ <= high_; }

  private:
    R low_, high_;
    std::int64_t count_ = 0, most_ = 0;
};

}  // namespace detail

// discrete_over() with the probabilities weight(i) / total, where no weight is negative. Sums of
// weights are compared with U * total, without a division for each. Where rounding might decide,
// or where the weights do not sum to the total, the probabilities are added after all.
template <class L, class Weight, class SomePlace = Place>
RDDL_INLINE typename L::Int discrete_of_shares_over(Context<L>& context, SomePlace place, Index n,
                                                    typename L::Real total, Weight&& weight) {
    using Int = typename L::Int;
    using Real = typename L::Real;
    using Number = typename L::Element;
    const Real rounding = total * Real{detail::rounding_of_shares<Number>(n)};
    const Real limit = uniform_at(context, place) * total;
    const Real low = limit - rounding, high = limit + rounding;
    Real sum{0};
    detail::PassedSums<L> passed(low, high);
    for (Index i = 0; i < n; ++i) {
        sum = sum + weight(i);
        passed.add(sum);
    }
    const Int chosen = passed.count();
    const auto is_certain = passed.is_certain() && chosen < Int{n} &&
                            absolute(sum - total) < total * Real{1e-6} &&
                            total > Real{detail::least_total<Number>};
    if (detail::holds_where_used(context, is_certain)) [[likely]]
        return select(is_certain, chosen, Int{0});
    return discrete_over(context, place, n, [&](Index i) { return weight(i) / total; });
}

namespace detail {

// The probabilities are added after all.
template <class L, std::size_t n, class SomePlace>
[[gnu::noinline, gnu::cold]] typename L::Int discrete_of_quotients(
    Context<L>& context, SomePlace place, const std::array<typename L::Real, n>& weights) {
    typename L::Real total{0};
    for (const auto& weight : weights) total = total + weight;
    return discrete_over(context, place, n, [&](Index i) { return weights[i] / total; });
}

}  // namespace detail

// discrete_of_shares_over() where the total is the sum of the weights, which lie in a row.
template <class L, std::size_t n, class SomePlace = Place>
RDDL_INLINE typename L::Int discrete_of_row(Context<L>& context, SomePlace place,
                                            const std::array<typename L::Real, n>& weights) {
    using Int = typename L::Int;
    using Real = typename L::Real;
    using Number = typename L::Element;
    std::array<Real, n> sums;
    sums[0] = weights[0];
    for (std::size_t i = 1; i < n; ++i) sums[i] = sums[i - 1] + weights[i];
    const Real total = sums[n - 1];
    const Real rounding = total * Real{detail::rounding_of_shares<Number>(n)};
    const Real limit = uniform_at(context, place) * total;
    const Real low = limit - rounding, high = limit + rounding;
    detail::PassedSums<L> passed(low, high);
    for (const Real& sum : sums) passed.add(sum);
    const Int chosen = passed.count();
    // With an infinite total or a nan, `low` is nan.
    const auto is_certain = passed.is_certain() && total > Real{detail::least_total<Number>};
    if (detail::holds_where_used(context, is_certain)) [[likely]]
        return select(is_certain, chosen, Int{0});
    return detail::discrete_of_quotients(context, place, weights);
}

// discrete_over() with weights of any positive, finite sum. They are evaluated twice; the second
// time, the last index of positive weight with no more than U * sum before it is chosen. Of the
// weights, the first nan, or else the least, is what a fault names.
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

// The rows of nested arrays, which are their last dimension.
template <class T>
struct RowsOf;
template <class T, std::size_t n>
struct RowsOf<std::array<T, n>> {
    using Element = T;
    static constexpr Index length = static_cast<Index>(n);
};
template <class T, std::size_t m, std::size_t n>
struct RowsOf<std::array<std::array<T, m>, n>> : RowsOf<std::array<T, m>> {};

inline constexpr Index most_counted = 8;  // longer rows are searched

// The table with f(row) in place of each row, its last dimension.
template <class T, std::size_t n, class Function>
constexpr auto mapped_rows(const std::array<T, n>& table, const Function& f) {
    if constexpr (std::is_floating_point_v<T>) {
        return f(table);
    } else {
        std::array<decltype(mapped_rows(table[0], f)), n> rows{};
        for (std::size_t i = 0; i < n; ++i) rows[i] = mapped_rows(table[i], f);
        return rows;
    }
}

// Rows of sorted thresholds of which some are at most any number in [0, 1), and others more than
// any.
template <const auto& thresholds>
struct Intervals {
    using Rows = RowsOf<std::remove_cvref_t<decltype(thresholds)>>;
    using Threshold = typename Rows::Element;
    static constexpr Index size = Rows::length;
    static constexpr Index steps =
        size <= most_counted ? size : std::bit_width(static_cast<std::size_t>(size));

    static constexpr bool is_decided(Threshold threshold) {
        return threshold <= 0 || threshold >= 1;
    }
    // How many of a row numbers in [0, 1) decide, at most.
    static constexpr std::size_t most_open = [] {
        std::size_t most = 0;
        mapped_rows(thresholds, [&](const auto& row) {
            std::size_t open = 0;
            for (const Threshold threshold : row) open += !is_decided(threshold);
            return most = std::max(most, open);
        });
        return most;
    }();
    // Their tables are worth it where fewer elements are looked up.
    static constexpr bool has_few_open = static_cast<Index>(most_open) + 1 < steps;

    static constexpr auto reached = mapped_rows(thresholds, [](const auto& row) {
        return static_cast<std::int64_t>(
            std::count_if(row.begin(), row.end(), [](Threshold each) { return each <= 0; }));
    });
    // The open threshold i of each row. Each i has a table of its own, since registers may be able
    // to hold that.
    template <std::size_t i>
    static constexpr auto open = mapped_rows(thresholds, [](const auto& row) {
        std::size_t before = 0;
        for (const Threshold each : row)
            if (!is_decided(each) && before++ == i) return each;
        return Threshold{1};
    });
};

}  // namespace detail

// How many thresholds of a row are at most U: an index with as many probabilities as there are
// intervals between them. The indices of the row are in range in the active lanes.
template <const auto& thresholds, class L, class SomePlace = Place, class... Row>
RDDL_INLINE typename L::Int interval(Context<L>& context, SomePlace place, const Row&... row) {
    using Int = typename L::Int;
    using Intervals = detail::Intervals<thresholds>;
    constexpr Index size = Intervals::size;
    const auto u = uniform_at(context, place);
    if constexpr (size > detail::most_counted && sizeof...(row) == 0)
        if constexpr (detail::GuideTable<thresholds>::parts > 0)
            return detail::GuideTable<thresholds>::template count<Int>(u);
    if constexpr (sizeof...(Row) > 0 && Intervals::has_few_open) {
        Int count{at(Intervals::reached, in_range(context, row)...)};
        [&]<std::size_t... i>(std::index_sequence<i...>) RDDL_INLINE_LAMBDA {
            const auto add = [&](const auto& threshold) RDDL_INLINE_LAMBDA {
                count = wrap_add(count, to_int(threshold <= u));
            };
            (add(at(Intervals::template open<i>, in_range(context, row)...)), ...);
        }
        (std::make_index_sequence<Intervals::most_open>());
        return count;
    }
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
RDDL_INLINE typename L::Int discrete_of_shares(Context<L>& context, SomePlace place,
                                               typename L::Real total,
                                               const std::array<typename L::Real, n>& weights) {
    return discrete_of_shares_over(context, place, n, total,
                                   [&weights](Index i) { return weights[i]; });
}

template <class L, std::size_t n, class SomePlace = Place>
typename L::Int unnormalised_discrete(Context<L>& context, SomePlace place,
                                      const std::array<typename L::Real, n>& weights) {
    return unnormalised_discrete_over(context, place, n,
                                      [&weights](Index i) { return weights[i]; });
}

}  // namespace rddl::sample
