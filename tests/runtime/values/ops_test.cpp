#include <rddl/values/ops.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rddl {
namespace {

using Int = std::int64_t;
constexpr Int least = std::numeric_limits<Int>::min();
constexpr Int greatest = std::numeric_limits<Int>::max();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(IntArithmetic, WrapsAround) {
    EXPECT_EQ(wrap_add(greatest, 1), least);
    EXPECT_EQ(wrap_sub(least, 1), greatest);
    EXPECT_EQ(wrap_mul(greatest, 2), -2);
    EXPECT_EQ(wrap_mul(least, -1), least);
    EXPECT_EQ(wrap_neg(least), least);
    EXPECT_EQ(wrap_neg(5), -5);
    EXPECT_EQ(absolute(least), least);
    EXPECT_EQ(absolute(Int{-3}), 3);
}

TEST(FloorDivision, RoundsTowardMinusInfinity) {
    EXPECT_EQ(floor_div(7, 2), 3);
    EXPECT_EQ(floor_div(-7, 2), -4);
    EXPECT_EQ(floor_div(7, -2), -4);
    EXPECT_EQ(floor_div(-7, -2), 3);
    EXPECT_EQ(floor_div(-6, 2), -3);
    EXPECT_EQ(floor_div(6, -2), -3);
    EXPECT_EQ(floor_div(0, -5), 0);
    EXPECT_EQ(floor_div(least, -1), least);
    EXPECT_EQ(floor_div(least, 1), least);
    EXPECT_EQ(floor_div(least, greatest), -2);
}

TEST(FloorModulo, HasTheSignOfTheDivisor) {
    EXPECT_EQ(floor_mod(Int{7}, Int{3}), 1);
    EXPECT_EQ(floor_mod(Int{-7}, Int{3}), 2);
    EXPECT_EQ(floor_mod(Int{7}, Int{-3}), -2);
    EXPECT_EQ(floor_mod(Int{-7}, Int{-3}), -1);
    EXPECT_EQ(floor_mod(Int{-6}, Int{3}), 0);
    EXPECT_EQ(floor_mod(least, Int{-1}), 0);
}

TEST(FloorDivision, ByZeroIsZero) {
    for (const Int a : {least, Int{-1}, Int{0}, Int{1}, greatest}) {
        EXPECT_EQ(floor_div(a, 0), 0);
        EXPECT_EQ(floor_mod(a, Int{0}), 0);
    }
}

TEST(FloorDivision, AndModuloBelongTogether) {
    for (Int a = -20; a <= 20; ++a)
        for (Int b = -7; b <= 7; ++b)
            if (b != 0) {
                EXPECT_EQ(floor_div(a, b) * b + floor_mod(a, b), a);
            }
}

TEST(RealModulo, HasTheSignOfTheDivisor) {
    EXPECT_EQ(floor_mod(-7.5, 2.0), 0.5);
    EXPECT_EQ(floor_mod(7.5, -2.0), -0.5);
    EXPECT_EQ(floor_mod(7.5, 2.0), 1.5);
    EXPECT_EQ(floor_mod(-7.5, -2.0), -1.5);
    EXPECT_EQ(floor_mod(1.0, infinity), 1.0);
    EXPECT_FALSE(std::signbit(floor_mod(-4.0, 2.0)));
    EXPECT_TRUE(std::signbit(floor_mod(4.0, -2.0)));
}

TEST(RealModulo, ByZeroAndOfInfinityIsNan) {
    EXPECT_TRUE(std::isnan(floor_mod(1.0, 0.0)));
    EXPECT_TRUE(std::isnan(floor_mod(0.0, 0.0)));
    EXPECT_TRUE(std::isnan(floor_mod(infinity, 2.0)));
    EXPECT_TRUE(std::isnan(floor_mod(nan, 2.0)));
    EXPECT_TRUE(std::isnan(floor_mod(2.0, nan)));
}

TEST(Rounding, GoesToTheEvenNeighbourOfAHalf) {
    EXPECT_EQ(round(2.5), 2);
    EXPECT_EQ(round(3.5), 4);
    EXPECT_EQ(round(-2.5), -2);
    EXPECT_EQ(round(-0.5), 0);
    EXPECT_EQ(round(0.49999999999999994), 0);
    EXPECT_EQ(floor(-0.5), -1);
    EXPECT_EQ(floor(2.9), 2);
    EXPECT_EQ(ceil(-0.5), 0);
    EXPECT_EQ(ceil(2.1), 3);
}

TEST(Rounding, OfWhatDoesNotFitIsTheLeastInt) {
    for (const double a : {nan, infinity, -infinity, 1e19, -1e19, 0x1p63}) {
        EXPECT_EQ(round(a), least) << a;
        EXPECT_EQ(floor(a), least) << a;
        EXPECT_EQ(ceil(a), least) << a;
        EXPECT_EQ(truncate_to_int(a), least) << a;
    }
    EXPECT_EQ(floor(-0x1p63), least);
    EXPECT_EQ(round(0x1p63 - 1024), greatest - 1023);
}

// Known to the C++ compiler, or not.
TEST(Rounding, OfAConstantIsThatOfAVariable) {
    EXPECT_EQ(floor(1e19), least);
    EXPECT_EQ(ceil(-1e300), least);
    EXPECT_EQ(round(std::numeric_limits<double>::infinity()), least);
    EXPECT_EQ(floor(std::nan("")), least);
    EXPECT_EQ(floor(-2.5), -3);
}

TEST(Rounding, AsRealIsTheRealOfTheInt) {
    for (const double a : {0.0, -0.0, -0.3, 0.3, 2.5, -2.5, 0x1p62, 0x1p63, -0x1p63, -0x1.1p63,
                           0x1p80, infinity, -infinity, nan}) {
        EXPECT_EQ(bits_of(round_as_real(a)), bits_of(to_real(round(a)))) << a;
        EXPECT_EQ(bits_of(floor_as_real(a)), bits_of(to_real(floor(a)))) << a;
        EXPECT_EQ(bits_of(ceil_as_real(a)), bits_of(to_real(ceil(a)))) << a;
    }
}

TEST(Sign, IsAnIntAndTheLeastOfNan) {
    EXPECT_EQ(sign(-2.5), -1);
    EXPECT_EQ(sign(-0.0), 0);
    EXPECT_EQ(sign(infinity), 1);
    EXPECT_EQ(sign(nan), least);
    EXPECT_EQ(sign(least), -1);
    EXPECT_EQ(sign(Int{0}), 0);
    EXPECT_EQ(sign(greatest), 1);
}

TEST(MinimumAndMaximum, LetNanWin) {
    EXPECT_EQ(minimum(1.0, 2.0), 1.0);
    EXPECT_EQ(maximum(1.0, 2.0), 2.0);
    EXPECT_EQ(minimum(-infinity, 2.0), -infinity);
    for (const double other : {0.0, infinity, -infinity, nan}) {
        EXPECT_TRUE(std::isnan(minimum(nan, other)));
        EXPECT_TRUE(std::isnan(minimum(other, nan)));
        EXPECT_TRUE(std::isnan(maximum(nan, other)));
        EXPECT_TRUE(std::isnan(maximum(other, nan)));
    }
    EXPECT_EQ(minimum(Int{3}, Int{-3}), -3);
    EXPECT_EQ(maximum(least, greatest), greatest);
}

// Constants and values that only a run knows have forms of their own.
TEST(MinimumAndMaximum, TakeTheFirstZero) {
    volatile double unknown = 0.0;
    const double zero = unknown;
    EXPECT_FALSE(std::signbit(minimum(0.0, -zero)));
    EXPECT_FALSE(std::signbit(maximum(0.0, -zero)));
    EXPECT_TRUE(std::signbit(minimum(-0.0, zero)));
    EXPECT_TRUE(std::signbit(maximum(-0.0, zero)));
    EXPECT_FALSE(std::signbit(minimum(zero, -0.0)));
    EXPECT_TRUE(std::signbit(maximum(-zero, 0.0)));
    EXPECT_EQ(maximum(0.0, zero - 1), 0.0);
    EXPECT_EQ(minimum(0.0, zero - 1), -1.0);
    EXPECT_TRUE(std::isnan(maximum(0.0, zero + nan)));
    EXPECT_TRUE(std::isnan(minimum(0.0, zero + nan)));
}

TEST(Conversions, CountTrueAsOne) {
    EXPECT_EQ(to_int(true), 1);
    EXPECT_EQ(to_int(false), 0);
    EXPECT_EQ(to_real(true), 1.0);
    EXPECT_EQ(to_real(Int{-7}), -7.0);
}

TEST(RealPower, IsThatOfIeee) {
    EXPECT_EQ(power(0.0, 0.0), 1.0);
    EXPECT_EQ(power(2.0, -2.0), 0.25);
    EXPECT_EQ(power(0.0, -1.0), infinity);
    EXPECT_TRUE(std::isnan(power(-8.0, 1.0 / 3.0)));
    EXPECT_EQ(power(-2.0, 3.0), -8.0);
}

// The interpreter's operands are never constants of its own C++ text, those of emitted code are.
TEST(RealPower, OfAConstantIsThatOfAVariable) {
    volatile double half = 0.5, minus_one = -1.0, two = 2.0, three = 3.0, ten = 10.0;
    for (double a = 0.01; a < 9.0; a += 0.0137) {
        EXPECT_EQ(power(a, 0.5), power(a, half));
        EXPECT_EQ(power(a, -1.0), power(a, minus_one));
        EXPECT_EQ(power(a, 2.0), power(a, two));
        EXPECT_EQ(power(a, 3.0), power(a, three));
        EXPECT_EQ(power(2.0, a), power(two, a));
        EXPECT_EQ(power(10.0, a), power(ten, a));
        EXPECT_EQ(log(a, 10.0), log(a, ten));
    }
}

TEST(IntPower, WrapsAround) {
    Context<Scalar> context;
    const auto pow = [&](Int a, Int b) {
        return power(context, {1, 2}, a, b);
    };
    EXPECT_EQ(pow(3, 4), 81);
    EXPECT_EQ(pow(0, 0), 1);
    EXPECT_EQ(pow(-2, 63), least);
    EXPECT_EQ(pow(2, 64), 0);
    EXPECT_EQ(pow(3, 41), static_cast<Int>(18026252303461234787ull));
    EXPECT_EQ(pow(-1, greatest), -1);
    EXPECT_FALSE(context.fault);
}

TEST(IntPower, FaultsOnANegativeExponent) {
    Context<Scalar> context;
    EXPECT_EQ(power(context, {1, 2}, 1, -3), 0);
    EXPECT_EQ(context.fault.kind, FaultKind::NegativeExponent);
    EXPECT_EQ(context.fault.place, (Place{1, 2}));
    EXPECT_EQ(context.fault.value, -3.0);
}

TEST(RealFunctions, NeverFault) {
    EXPECT_EQ(ln(0.0), -infinity);
    EXPECT_TRUE(std::isnan(ln(-1.0)));
    EXPECT_TRUE(std::isnan(sqrt(-1.0)));
    EXPECT_TRUE(std::isnan(acos(2.0)));
    EXPECT_TRUE(std::isnan(asin(-2.0)));
    EXPECT_EQ(exp(1000.0), infinity);
    EXPECT_EQ(exp(-1000.0), 0.0);
    EXPECT_DOUBLE_EQ(log(8.0, 2.0), 3.0);
    EXPECT_EQ(log(8.0, 1.0), infinity);
    EXPECT_EQ(hypot(3.0, 4.0), 5.0);
    EXPECT_EQ(absolute(-2.5), 2.5);
    EXPECT_FALSE(std::signbit(absolute(-0.0)));
    EXPECT_DOUBLE_EQ(tanh(0.5), sinh(0.5) / cosh(0.5));
    EXPECT_DOUBLE_EQ(tan(0.5), sin(0.5) / cos(0.5));
    EXPECT_DOUBLE_EQ(atan(1.0), acos(0.0) / 2);
}

TEST(GammaFunction, FaultsUnlessItsArgumentIsPositive) {
    for (const double bad : {0.0, -0.0, -1.0, -0.5, nan, -infinity}) {
        Context<Scalar> in_gamma, in_ln_gamma;
        EXPECT_EQ(gamma(in_gamma, {4, 0}, bad), 0.0);
        EXPECT_EQ(ln_gamma(in_ln_gamma, {4, 0}, bad), 0.0);
        EXPECT_EQ(in_gamma.fault.kind, FaultKind::GammaArgument) << bad;
        EXPECT_EQ(in_ln_gamma.fault.kind, FaultKind::GammaArgument) << bad;
    }
    Context<Scalar> context;
    EXPECT_DOUBLE_EQ(gamma(context, {}, 5.0), 24.0);
    EXPECT_DOUBLE_EQ(ln_gamma(context, {}, 0.5), 0.5 * std::log(std::acos(-1.0)));
    EXPECT_EQ(ln_gamma(context, {}, 1.0), 0.0);
    EXPECT_EQ(gamma(context, {}, 200.0), infinity);
    EXPECT_EQ(ln_gamma(context, {}, infinity), infinity);
    EXPECT_FALSE(context.fault);
}

// g++ would compute those of constants exactly, which the mathematical library does not.
TEST(GammaFunction, OfAConstantIsThatOfAVariable) {
    Context<Scalar> context;
    const auto at_run_time = [&](double a) {
        const volatile double argument = a;
        return gamma(context, {}, argument);
    };
    EXPECT_EQ(gamma(context, {}, 9.5), at_run_time(9.5));
    EXPECT_EQ(gamma(context, {}, 20.25), at_run_time(20.25));
    EXPECT_EQ(gamma(context, {}, 99.5), at_run_time(99.5));
    EXPECT_EQ(gamma(context, {}, 150.3), at_run_time(150.3));
}

TEST(Faults, KeepTheFirst) {
    Context<Scalar> context;
    EXPECT_EQ(fault<Int>(context, {1, 1}), 0);
    EXPECT_EQ(power(context, {2, 2}, 2, -1), 0);
    EXPECT_EQ(context.fault.kind, FaultKind::Type);
    EXPECT_EQ(context.fault.place, (Place{1, 1}));
}

TEST(Choices, AreEagerOrLazy) {
    Context<Scalar> context;
    EXPECT_EQ(select(true, Int{1}, Int{2}), 1);
    EXPECT_EQ(select(false, 1.5, 2.5), 2.5);
    EXPECT_EQ(select(true, false, true), false);
    const double chosen = branch(
        context, true, [] { return 1.0; }, [&] { return fault<double>(context, {}); });
    EXPECT_EQ(chosen, 1.0);
    EXPECT_FALSE(context.fault);
    const auto which = [](bool first, bool second) {
        return branch(
            first, [] { return 1; }, [&] { return second; }, [] { return 2; }, [] { return 3; });
    };
    EXPECT_EQ(which(true, true), 1);
    EXPECT_EQ(which(false, true), 2);
    EXPECT_EQ(which(false, false), 3);
}

TEST(At, IndexesNestedArrays) {
    constexpr std::array<std::array<double, 3>, 2> table{{{1, 2, 3}, {4, 5, 6}}};
    static_assert(at(table, 1, 2) == 6);
    static_assert(at(table[0], 1) == 2);
    EXPECT_EQ(at(table, Int{1}, Int{0}), 4);
}

}  // namespace
}  // namespace rddl
