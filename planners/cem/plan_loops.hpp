// Loops over a value of many plans side by side, compiled for each instruction set. All compute the
// same bits.
#pragma once

#include "planners/simulation/aligned.hpp"
#include "solvers/spaces/actions.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::planners {

// Noise of a step: see PlanNoise. Number k keeps old[k] of itself and takes fresh[k] of drawn[k];
// plan p keeps its rank with the probability keep[p] / 256.
struct NumberNoise {
    const float *old, *fresh, *drawn;
};
struct RankNoise {
    std::uint32_t key;
    const std::uint32_t* keep;
};
// Some rows, of `reals` floats each, and their weights.
struct Rows {
    const float* first;
    std::size_t reals, count;
    const std::size_t* chosen;
    const double* weights;
};
inline constexpr std::size_t slack = 8;

// 32 bits of a counter and a key, each of which depends on all of theirs ("lowbias32" of Chris
// Wellons' hash prospector, 2018). Inlined, since each instruction set compiles it for its own.
[[gnu::always_inline]] inline std::uint32_t noise_bits(std::uint32_t key, std::size_t counter) {
    std::uint32_t bits = key + static_cast<std::uint32_t>(counter) * 0x9E3779B9u;
    bits = (bits ^ (bits >> 16)) * 0x7FEB352Du;
    bits = (bits ^ (bits >> 15)) * 0x846CA68Bu;
    return bits ^ (bits >> 16);
}
inline constexpr std::int32_t rank_count = 1 << 24;

// Where plans' numbers lie between -half_bend and half_bend, values with one bound are bent: they
// go on from the bound as a parabola. 4 log 2: so that 0 has the value that learners give it.
inline constexpr float half_bend = 2.7725887f;
inline bool is_bent(solvers::RealHead::Range range) {
    using Range = solvers::RealHead::Range;
    return range == Range::AboveLower || range == Range::BelowUpper;
}

// Reals of plans lie one plan after the other. What belongs to a real of an action is repeated for
// so many plans, so that loops over vectors of any length need not know where a plan begins.
inline constexpr std::size_t repetitions = 32;  // a power of two
// Repeats a row of `reals` values.
template <class Value>
void repeat(const Value* row, std::size_t reals, Value* to) {
    std::copy_n(row, reals, to);
    for (std::size_t k = 1; k < repetitions; k *= 2) std::copy_n(to, k * reals, to + k * reals);
}

// The distribution of the reals of a step, and the limits of their numbers; each is `period`
// values. Beyond its bounds a number would change nothing, and drift away.
struct NumberScales {
    std::size_t period;
    const float *means, *deviations, *least, *most;
};

// A real of an action: its scale, and its default as a float and as it is.
struct RealScale {
    solvers::RealHead::Range range;  // not Squashed
    bool rounds;
    double lower, upper, scale, centre;
    double least, most;  // what values are limited to
    float short_default;
    double exact_default;
};

// The reals of an action. A number u has the value base + scale * (max(u, least_number) + shift +
// b), where b is what the parabola adds, and is limited to `least` and `most`.
class RealScales {
  public:
    explicit RealScales(std::span<const RealScale> reals);

    template <class Number>
    struct Values {
        Aligned<Number> base, scale, least, most;
    };
    std::size_t period;
    // Whether arithmetic of floats reaches all bounds and defaults that have to be reached.
    bool is_short = true;
    bool any_rounds = false;
    Aligned<float> least_number, shift, twice_bend, rounds;  // rounds: 1 or 0
    Values<float> short_values;
    // Else values are computed as doubles and rounded to floats.
    Values<double> long_values;
    Aligned<double> lower, upper, exact_default;
    Aligned<float> short_default;

  private:
    void add(const RealScale& real);
};

struct PlanLoops {
    void (*next_numbers)(const NumberNoise& noise, std::size_t count, float* numbers);
    void (*next_ranks)(const RankNoise& noise, std::size_t plans, std::int32_t* ranks);
    // number = mean + deviation * noise, within its limits; where 1 is not the most, with noise
    // that is so many widths as wide. The first one is that of a plan's first real, as in
    // real_values().
    void (*scale_numbers)(const NumberScales& scales, const float* widths, const float* noise,
                          std::size_t count, float* numbers);
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
    void (*real_values)(const RealScales& reals, const float* numbers, std::size_t count,
                        double* values);
    // For each of `reals` columns of rows: the sum of weights * x and that of weights * x * x,
    // where x is what a number is more than its centre. Reads up to `slack` floats behind the last
    // row.
    void (*add_moments)(const Rows& rows, const float* centres, double* sums, double* squares);
    // How many values are greater than the limit.
    std::size_t (*count_above)(const double* values, std::size_t count, double limit);
    // How many values come before each of them, the greatest first and equal ones in their order.
    void (*count_before)(const double* values, std::size_t count, std::size_t* before);
};

// The loops of this processor.
const PlanLoops& plan_loops();

}  // namespace rddlc::planners
