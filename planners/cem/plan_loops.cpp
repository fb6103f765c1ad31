#include "planners/cem/plan_loops.hpp"

#include <rddl/lanes/processor.hpp>

#include <cmath>
#include <limits>

namespace rddlc::planners {

// The same text for each instruction set. The headers above are compiled for any processor.
namespace portable {
#include "planners/cem/plan_loops_variant.hpp"
}

namespace {

bool is_float(double x) {
    return static_cast<double>(static_cast<float>(x)) == x;
}

// Whether arithmetic of floats reaches the bounds and the default. A single bound is also reached
// by the float that is next to it within.
bool is_short(const RealScale& real) {
    using Range = solvers::RealHead::Range;
    constexpr double greatest = std::numeric_limits<float>::max();
    if (!is_float(real.exact_default) || real.least < -greatest || real.most > greatest)
        return false;
    if (real.range != Range::Bounded) return true;
    const auto half_width = static_cast<float>(0.5 * (real.upper - real.lower));
    return is_float(real.lower) && is_float(real.upper) &&
           static_cast<float>(real.lower) + 2 * half_width == static_cast<float>(real.upper);
}

// The next float on the side of `toward`, unless x is one.
float float_within(double x, float toward) {
    const auto nearest = static_cast<float>(x);
    const auto is_beyond =
        toward > 0 ? static_cast<double>(nearest) < x : static_cast<double>(nearest) > x;
    return is_beyond ? std::nextafter(nearest, toward) : nearest;
}

template <class Value>
void repeat_all(Aligned<Value>& row) {
    const Aligned<Value> once = row;
    row.resize(repetitions * once.size());
    repeat(once.data(), once.size(), row.data());
}

}  // namespace

RealScales::RealScales(std::span<const RealScale> reals) : period(repetitions * reals.size()) {
    for (const RealScale& real : reals) add(real);
    for (auto* const row :
         {&least_number, &shift, &twice_bend, &rounds, &short_default, &short_values.base,
          &short_values.scale, &short_values.least, &short_values.most})
        repeat_all(*row);
    for (auto* const row : {&lower, &upper, &exact_default, &long_values.base, &long_values.scale,
                            &long_values.least, &long_values.most})
        repeat_all(*row);
}

void RealScales::add(const RealScale& real) {
    using Range = solvers::RealHead::Range;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr double greatest = std::numeric_limits<float>::max();
    const bool is_bounded = real.range == Range::Bounded;
    const bool bends = is_bent(real.range);
    is_short = is_short && planners::is_short(real);
    any_rounds = any_rounds || real.rounds;
    least_number.push_back(bends ? half_bend : -infinity);
    shift.push_back(bends ? -half_bend : is_bounded ? 1.0f : 0.0f);
    twice_bend.push_back(bends ? 2 * half_bend : 0.0f);
    rounds.push_back(real.rounds ? 1.0f : 0.0f);
    const double base = real.range == Range::Free         ? real.centre
                        : real.range == Range::BelowUpper ? real.upper
                                                          : real.lower;
    const double scale = is_bounded                        ? 0.5 * real.upper - 0.5 * real.lower
                         : real.range == Range::BelowUpper ? -real.scale
                                                           : real.scale;
    long_values.base.push_back(base);
    long_values.scale.push_back(scale);
    long_values.least.push_back(std::clamp(real.least, -greatest, greatest));
    long_values.most.push_back(std::clamp(real.most, -greatest, greatest));
    short_values.base.push_back(static_cast<float>(base));
    short_values.scale.push_back(static_cast<float>(scale));
    short_values.least.push_back(float_within(long_values.least.back(), infinity));
    short_values.most.push_back(float_within(long_values.most.back(), -infinity));
    lower.push_back(real.lower);
    upper.push_back(real.upper);
    exact_default.push_back(real.exact_default);
    short_default.push_back(real.short_default);
}

#ifdef __x86_64__
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
#include "planners/cem/plan_loops_variant.hpp"
}
#ifdef __clang__
#pragma clang attribute pop
#pragma clang attribute push(                                                    \
    __attribute__((target("avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2"))), \
    apply_to = function)
#else
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,prefer-vector-width=512")
#endif
namespace avx512 {
#include "planners/cem/plan_loops_variant.hpp"
}
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

const PlanLoops& plan_loops() {
    switch (rddl::allowed_instruction_set()) {
        case rddl::InstructionSet::Avx512:
            return avx512::loops;
        case rddl::InstructionSet::Avx2:
            return avx2::loops;
        case rddl::InstructionSet::Sse2:
            break;
    }
    return portable::loops;
}
#else
const PlanLoops& plan_loops() {
    return portable::loops;
}
#endif

}  // namespace rddlc::planners
