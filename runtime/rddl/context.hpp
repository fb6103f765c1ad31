// What an evaluation carries along: the random stream of the episode, the step, the first fault.
#pragma once

#include <rddl/lane.hpp>

#include <cstdint>

namespace rddl {

// Where a draw or a possible fault stands: a site of the program text, and the row-major index
// into the objects of the site's scope.
struct Place {
    std::uint32_t site = 0;
    std::uint32_t index = 0;

    constexpr Place() = default;
    constexpr Place(std::uint32_t site_number, Index index_in_scope)
        : site(site_number), index(static_cast<std::uint32_t>(index_in_scope)) {}
    constexpr bool operator==(const Place&) const = default;
};

// The key of an episode's random stream (random.hpp).
struct StreamKey {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    constexpr bool operator==(const StreamKey&) const = default;
};

// What was wrong; sites.hpp says it in words.
enum class FaultKind : std::uint8_t {
    None,
    Type,                 // a value of the wrong type; the site's text is the message
    NegativeExponent,     // int ^ negative int
    GammaArgument,        // gamma, lngamma of a number that is not > 0
    Probability,          // not in [0, 1]
    PositiveProbability,  // not in (0, 1]
    Width,                // upper minus lower bound: negative, infinite or nan
    Variance,             // not >= 0
    Rate,                 // not in [0, 9.2e18]
    Mean,                 // this and the next three: not > 0
    Shape,
    Scale,
    DegreesOfFreedom,
    Trials,          // negative
    Successes,       // not > 0
    Weight,          // not >= 0
    ProbabilitySum,  // not 1
    WeightSum,       // not > 0, or infinite
    CountTooLarge,   // a draw beyond the range of int
    PositiveWeight,  // not > 0
    Covariance,      // not positive definite
    Undefined,       // no value; the site's text is the message
    ActionLimit,     // a policy's action with more than max-nondef-actions changed values
};

struct FaultRecord {
    FaultKind kind = FaultKind::None;
    Place place;
    double value = 0;  // the offending one

    constexpr explicit operator bool() const { return kind != FaultKind::None; }
};

template <class L>
struct Context;

template <>
struct Context<Scalar> {
    StreamKey key;
    std::uint32_t step = 0;  // 0 at reset; the step that leaves timestep t has t + 1
    FaultRecord fault;

    // Passes `ok` on, having recorded a fault where it is false. The first fault wins.
    constexpr bool require(bool ok, FaultKind kind, Place place, double value) {
        if (!ok && !fault) fault = {kind, place, value};
        return ok;
    }
};

// A fault that has no value to show; evaluates to zero.
template <class T, class L>
constexpr T fault(Context<L>& context, Place place) {
    context.require(false, FaultKind::Type, place, 0.0);
    return T{};
}

}  // namespace rddl
