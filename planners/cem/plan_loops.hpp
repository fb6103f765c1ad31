// Loops over a value of many plans side by side, compiled for each instruction set. All compute the
// same bits.
#pragma once

#include "solvers/spaces/actions.hpp"

#include <cstddef>
#include <cstdint>

namespace rddlc::planners {

// Noise of a step: see PlanNoise. Plan p keeps old[p] of its number and takes fresh[p] of a new
// one; it keeps its rank with the probability keep[p] / 256.
struct NumberNoise {
    std::uint32_t key;
    const float *old, *fresh;
};
struct RankNoise {
    std::uint32_t key;
    const std::uint32_t* keep;
};
inline constexpr std::int32_t rank_count = 1 << 24;

// Where plans' numbers lie between -half_bend and half_bend, values with one bound are bent: they
// go on from the bound as a parabola. 4 log 2: so that 0 has the value that learners give it.
inline constexpr float half_bend = 2.7725887f;

// A real of an action: its scale, and its default as a float and as it is.
struct RealScale {
    solvers::RealHead::Range range;  // not Squashed
    bool rounds;
    double lower, upper, scale, centre;
    double least, most;  // what values are limited to
    float short_default;
    double exact_default;
};

struct PlanLoops {
    void (*next_numbers)(const NumberNoise& noise, std::size_t plans, float* numbers);
    // widths[p] = exp(1.5 n), n being noise of its own.
    void (*draw_widths)(std::uint32_t key, std::size_t plans, float* widths);
    void (*next_ranks)(const RankNoise& noise, std::size_t plans, std::int32_t* ranks);
    // number = mean + deviation * noise; where it is bounded, between -1 and 1, else with noise
    // that is widths[p] times as wide in plan p.
    void (*scale_numbers)(float mean, float deviation, bool is_bounded, const float* widths,
                          const float* noise, std::size_t plans, float* numbers);
    // reached[p] becomes the number of thresholds that ranks[p] reaches. They are in ascending
    // order and 2^n - 1.
    void (*count_reached)(const std::int32_t* thresholds, std::size_t count,
                          const std::int32_t* ranks, std::size_t plans, std::int32_t* reached);
    // Where ranks[p] is below habits[p], plan p does what is usual: chosen[p] becomes `usual`. The
    // other ranks are stretched over all ranks, for count_reached().
    void (*stretch)(const std::int32_t* habits, const float* stretches, const std::int32_t* ranks,
                    std::size_t plans, std::int32_t* stretched);
    void (*keep_habits)(const std::int32_t* habits, const std::int32_t* ranks, std::int32_t usual,
                        std::size_t plans, std::int32_t* chosen);
    // Values as write_action and ActionRecords have them, but bent in place of softplus: of a
    // float's precision, and what is the default there is the default itself.
    void (*real_values)(const RealScale& real, const float* numbers, std::size_t plans,
                        double* values);
};

// The loops of this processor.
const PlanLoops& plan_loops();

}  // namespace rddlc::planners
