// The length of a right triangle's third side.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math/parts.hpp>

#include <limits>

namespace rddl {

namespace detail {

// sqrt(a^2 + b^2) for a >= b >= 0 whose squares neither overflow nor vanish.
template <class R>
RDDL_ALWAYS_INLINE R root_of_squares(R a, R b) {
    const Pair<R> a_square = multiply_exactly(a, a), b_square = multiply_exactly(b, b);
    const Pair<R> sum = sum_exactly(a_square.high, b_square.high);
    const R low = sum.low + (a_square.low + b_square.low);
    const R root = sqrt(sum.high);
    const R remaining =
        lost_by_root(sum.high, root) + low / select(root == 0.0, R{1.0}, 2.0 * root);
    return root + remaining;
}

}  // namespace detail

template <RealLanes R>
R hypot(R a, R b) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const R x = absolute(a), y = absolute(b);
    const R longer = select(x < y, y, x), shorter = select(x < y, x, y);
    const auto tiny = longer < 0x1p-400;
    const auto huge = longer > 0x1p500;
    const auto infinite = x == infinity || y == infinity;
    if (!any(tiny || huge || infinite)) return detail::root_of_squares(longer, shorter);
    const R factor = select(tiny, R{0x1p600}, select(huge, R{0x1p-600}, R{1.0}));
    const R back = select(tiny, R{0x1p-600}, select(huge, R{0x1p600}, R{1.0}));
    const R root = detail::root_of_squares(longer * factor, shorter * factor);
    return select(infinite, R{infinity}, root * back);
}

}  // namespace rddl
