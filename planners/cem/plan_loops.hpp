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

// Noise of a step: see PlanNoise. Number k keeps old[k] of itself, takes fresh[k] of drawn[k], and
// is widths[k] as wide; plan p keeps its rank with the probability keep[p] / 256.
struct NumberNoise {
    const float *old, *fresh, *drawn, *widths;
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

// A real of a plan is a number in the learner's units that is 0 at a bound: reals between two
// bounds have numbers from 0 to 2, those with one bound numbers from 0 on, and those without have
// any. Where a number lies between 0 and 2 * half_bend, values with one bound are bent: they go on
// from the bound as a parabola. 4 log 2: so that the middle has the value that learners give to 0.
inline constexpr float half_bend = 2.7725887f;
inline bool is_bent(solvers::RealHead::Range range) {
    using Range = solvers::RealHead::Range;
    return range == Range::AboveLower || range == Range::BelowUpper;
}
// The learner's 0.
inline float middle_number(solvers::RealHead::Range range) {
    return is_bent(range) ? half_bend : range == solvers::RealHead::Range::Bounded ? 1.0f : 0.0f;
}
// Beyond these a number would change nothing, and drift away.
struct NumberLimits {
    float least, most;
};
NumberLimits number_limits(const solvers::RealHead& head);

// Reals of plans lie one plan after the other. What belongs to a real of an action is repeated for
// so many plans, so that loops over vectors of any length need not know where a plan begins.
inline constexpr std::size_t repetitions = 16;  // a power of two
// Repeats a row of `reals` values.
template <class Value>
void repeat(const Value* row, std::size_t reals, Value* to) {
    for (std::size_t k = 0; k < repetitions; ++k)
        for (std::size_t r = 0; r < reals; ++r) *to++ = row[r];
}

// The distribution of the reals of a step, and the limits of their numbers; each is `period`
// values.
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

// The reals of an action. A number y has the value base + scale * y + t * (t * bend - slope), where
// t is y, but at most bend_end: the parabola, and what is missing to it further on. All are 0 for
// reals without a parabola. So numbers within their limits have values within their bounds.
class RealScales {
  public:
    explicit RealScales(std::span<const RealScale> reals);

    template <class Number>
    struct Values {
        Aligned<Number> base, scale, bend, slope, bend_end, least, most;
    };
    std::size_t period;
    // Whether arithmetic of floats reaches all bounds and defaults that have to be reached.
    bool is_short = true;
    bool any_rounds = false;
    Aligned<float> rounds;  // 1 or 0
    Values<float> short_values;
    // Else values are computed as doubles, limited to `least` and `most`, and rounded to floats.
    Values<double> long_values;
    Aligned<double> lower, upper, exact_default;
    Aligned<float> short_default;

  private:
    void add(const RealScale& real);
};

struct PlanLoops {
    // The noise goes on by a step, and so many numbers are drawn by it, of which the first is the
    // scales' first-th one: number = mean + deviation * noise, within its limits. Its mirror image
    // has the noise's negative.
    void (*draw_numbers)(const NumberNoise& noise, const NumberScales& scales, std::size_t first,
                         std::size_t count, float* values, float* numbers, float* mirrored);
    void (*next_ranks)(const RankNoise& noise, std::size_t plans, std::int32_t* ranks);
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
    // float's precision, and what is the default there is the default itself. The first one is that
    // of a plan's first real. Numbers lie within their limits.
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
