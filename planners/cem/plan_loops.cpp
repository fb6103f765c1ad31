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
    constexpr double greatest = 1e30;  // whose products are floats as well
    if (!is_float(real.exact_default) || real.least < -greatest || real.most > greatest ||
        real.scale > greatest)
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

NumberLimits number_limits(const solvers::RealHead& head) {
    using Range = solvers::RealHead::Range;
    static constexpr double most_number = 1e9;
    const auto within = [](double number) {
        return static_cast<float>(std::clamp(number, -most_number, most_number));
    };
    switch (head.range) {
        case Range::Squashed:
        case Range::Bounded:
            break;
        case Range::AboveLower:
            return {0, within((head.most() - head.lower) / head.scale)};
        case Range::BelowUpper:
            return {0, within((head.upper - head.least()) / head.scale)};
        case Range::Free:
            return {within((head.least() - head.centre) / head.scale),
                    within((head.most() - head.centre) / head.scale)};
    }
    return {0, 2};
}

RealScales::RealScales(std::span<const RealScale> reals) : period(repetitions * reals.size()) {
    for (const RealScale& real : reals) add(real);
    const auto repeat_values = [](auto& values) {
        for (auto* const row : {&values.base, &values.scale, &values.bend, &values.slope,
                                &values.bend_end, &values.least, &values.most})
            repeat_all(*row);
    };
    repeat_values(short_values);
    repeat_values(long_values);
    for (auto* const row : {&rounds, &short_default}) repeat_all(*row);
    for (auto* const row : {&lower, &upper, &exact_default}) repeat_all(*row);
}

void RealScales::add(const RealScale& real) {
    using Range = solvers::RealHead::Range;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr double greatest = std::numeric_limits<float>::max();
    const bool is_bounded = real.range == Range::Bounded;
    is_short = is_short && planners::is_short(real);
    any_rounds = any_rounds || real.rounds;
    rounds.push_back(real.rounds ? 1.0f : 0.0f);
    const double base = real.range == Range::Free         ? real.centre
                        : real.range == Range::BelowUpper ? real.upper
                                                          : real.lower;
    const double scale = is_bounded                        ? 0.5 * real.upper - 0.5 * real.lower
                         : real.range == Range::BelowUpper ? -real.scale
                                                           : real.scale;
    const double bent_scale = is_bent(real.range) ? scale : 0;
    const auto add_parabola = [&]<class Number>(Values<Number>& values) {
        values.scale.push_back(static_cast<Number>(scale));
        values.bend.push_back(static_cast<Number>(bent_scale / (4 * half_bend)));
        values.slope.push_back(static_cast<Number>(bent_scale));
        values.bend_end.push_back(is_bent(real.range) ? 2 * half_bend : Number{0});
    };
    add_parabola(short_values);
    add_parabola(long_values);
    long_values.base.push_back(base);
    long_values.least.push_back(std::clamp(real.least, -greatest, greatest));
    long_values.most.push_back(std::clamp(real.most, -greatest, greatest));
    short_values.base.push_back(
        is_bent(real.range)
            ? float_within(base, real.range == Range::AboveLower ? infinity : -infinity)
            : static_cast<float>(base));
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
