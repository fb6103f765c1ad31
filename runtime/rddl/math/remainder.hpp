// The remainder, which is the C library's, called in each lane: exact by definition.
#pragma once

#include <rddl/real.hpp>

#include <cmath>

namespace rddl {

// Has the sign of the divisor, unlike C's; by 0 gives nan.
template <RealLanes R>
R floor_mod(R a, R b) {
    return map_lanes(a, b, [](double dividend, double divisor) {
        const double remainder = std::fmod(dividend, divisor);
        if (remainder == 0) return std::copysign(0.0, divisor);
        return (remainder < 0) != (divisor < 0) ? remainder + divisor : remainder;
    });
}

}  // namespace rddl
