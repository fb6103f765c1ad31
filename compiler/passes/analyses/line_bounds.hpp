// Bounds of numbers that grow at most in a straight line with a parameter.
//
// An interval [0, 2t] is tighter than the interval [0, 2] of all t in (0, 1]: a product with a
// number of t's size can still be compared with another one. So each end is a line over the
// parameter, given by its values where the parameter is least and where it is greatest.
//
// All rounded values are inside, for reals as doubles or floats that are finite: the rules of
// interval arithmetic (R. Moore, Interval Analysis, 1966) with ends that are moved outwards by more
// than the rounding errors.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace rddlc::passes {

using Line = std::array<double, 2>;

struct LineBounds {
    Line low, high;
};

namespace detail {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
// More than the error of one rounding to a float, of a normal number and of a subnormal one.
inline constexpr double relative_error = 0x1p-22, absolute_error = 0x1p-140;
// Floats below it do not overflow when they are rounded.
inline constexpr double greatest_finite = 0x1p127;

inline double lower(double value) {
    return std::isnan(value) ? -infinity
                             : value - std::fabs(value) * relative_error - absolute_error;
}
inline double upper(double value) {
    return -lower(-value);
}
inline LineBounds outward(const LineBounds& a) {
    LineBounds result = a;
    for (double& value : result.low) value = lower(value);
    for (double& value : result.high) value = upper(value);
    return result;
}

// One line is above the other for all parameters.
inline bool dominates(const Line& a, const Line& b) {
    return a[0] >= b[0] && a[1] >= b[1];
}
// The better of two lines below a number: where they cross, the higher one at the least parameter.
inline Line higher(const Line& a, const Line& b) {
    if (dominates(a, b)) return a;
    if (dominates(b, a)) return b;
    return a[0] > b[0] ? a : b;
}
inline Line negative(const Line& a) {
    return {-a[0], -a[1]};
}
inline Line pairwise_least(const Line& a, const Line& b) {
    return {std::min(a[0], b[0]), std::min(a[1], b[1])};
}

}  // namespace detail

inline std::optional<double> only_number(const LineBounds& a);
inline LineBounds join(const LineBounds& a, const LineBounds& b);
inline LineBounds maximum(const LineBounds& a, const LineBounds& b);

inline LineBounds between(double low, double high) {
    return {{low, low}, {high, high}};
}
inline LineBounds exactly(double value) {
    return between(value, value);
}
inline LineBounds everything() {
    return between(-detail::infinity, detail::infinity);
}

inline LineBounds add(const LineBounds& a, const LineBounds& b) {
    return detail::outward({{a.low[0] + b.low[0], a.low[1] + b.low[1]},
                            {a.high[0] + b.high[0], a.high[1] + b.high[1]}});
}
inline LineBounds negate(const LineBounds& a) {
    return {detail::negative(a.high), detail::negative(a.low)};
}
inline LineBounds subtract(const LineBounds& a, const LineBounds& b) {
    return add(a, negate(b));
}

// A product of two lines is a parabola, which differs from the line through its ends by a quarter
// of the product of their rises at most.
inline LineBounds multiply(const LineBounds& a, const LineBounds& b) {
    if (only_number(a) == 0.0 || only_number(b) == 0.0) return exactly(0);
    LineBounds result{{detail::infinity, detail::infinity}, {-detail::infinity, -detail::infinity}};
    for (const Line* const x : {&a.low, &a.high})
        for (const Line* const y : {&b.low, &b.high}) {
            const double bend = ((*x)[1] - (*x)[0]) * ((*y)[1] - (*y)[0]) / 4;
            for (std::size_t end = 0; end < 2; ++end) {
                const double product = (*x)[end] * (*y)[end];
                if (!std::isfinite(product) || !std::isfinite(bend)) return everything();
                // The errors of both are larger than those of their difference if that is small.
                result.low[end] = std::min(
                    result.low[end], detail::lower(product) - detail::upper(std::max(bend, 0.0)));
                result.high[end] = std::max(
                    result.high[end], detail::upper(product) - detail::lower(std::min(bend, 0.0)));
            }
        }
    return detail::outward(result);
}

inline LineBounds absolute(const LineBounds& a) {
    const LineBounds other = negate(a);
    if (a.low[0] >= 0 && a.low[1] >= 0) return a;
    if (other.low[0] >= 0 && other.low[1] >= 0) return other;
    return {{0, 0}, join(a, other).high};
}
inline LineBounds minimum(const LineBounds& a, const LineBounds& b) {
    return negate(maximum(negate(a), negate(b)));
}
inline LineBounds maximum(const LineBounds& a, const LineBounds& b) {
    return {detail::higher(a.low, b.low), join(a, b).high};
}
// All numbers of either.
inline LineBounds join(const LineBounds& a, const LineBounds& b) {
    return {detail::pairwise_least(a.low, b.low),
            detail::negative(
                detail::pairwise_least(detail::negative(a.high), detail::negative(b.high)))};
}
// All exact results that may be rounded to one of these.
inline LineBounds before_rounding(const LineBounds& a) {
    return detail::outward(a);
}

inline bool is_finite(const LineBounds& a) {
    const auto is_small = [](double end) {
        return std::fabs(end) < detail::greatest_finite;
    };
    return std::ranges::all_of(a.low, is_small) && std::ranges::all_of(a.high, is_small);
}
// For all parameters.
inline bool is_below(const LineBounds& a, const LineBounds& b) {
    return a.high[0] < b.low[0] && a.high[1] < b.low[1];
}
inline bool is_at_most(const LineBounds& a, const LineBounds& b) {
    return a.high[0] <= b.low[0] && a.high[1] <= b.low[1];
}
// The only number, the same for all parameters.
inline std::optional<double> only_number(const LineBounds& a) {
    const bool is_one = a.low == a.high && a.low[0] == a.low[1];
    return is_one ? std::optional(a.low[0]) : std::nullopt;
}

// Leaves numbers of `a` that are not in `b` out. Without any number, the low end is above the high
// one.
inline void narrow(LineBounds& a, const LineBounds& b) {
    a.low = detail::higher(a.low, b.low);
    a.high = detail::negative(detail::higher(detail::negative(a.high), detail::negative(b.high)));
}
inline bool is_empty(const LineBounds& a) {
    return a.low[0] > a.high[0] && a.low[1] > a.high[1];
}

}  // namespace rddlc::passes
