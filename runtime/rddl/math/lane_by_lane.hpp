// Functions of reals that are rare in RDDL and stay the C library's, called in each lane.
#pragma once

#include <rddl/real.hpp>

#include <cmath>

namespace rddl {

template <RealLanes R>
R acos(R a) {
    return map_lanes(a, [](double x) { return std::acos(x); });
}
template <RealLanes R>
R asin(R a) {
    return map_lanes(a, [](double x) { return std::asin(x); });
}
template <RealLanes R>
R cosh(R a) {
    return map_lanes(a, [](double x) { return std::cosh(x); });
}
template <RealLanes R>
R sinh(R a) {
    return map_lanes(a, [](double x) { return std::sinh(x); });
}
template <RealLanes R>
R hypot(R a, R b) {
    return map_lanes(a, b, [](double x, double y) { return std::hypot(x, y); });
}
// The angle of the point (x, y), in [-pi, pi]; 0 for the origin.
template <RealLanes R>
R atan2(R y, R x) {
    return map_lanes(y, x, [](double b, double a) { return std::atan2(b, a); });
}

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
