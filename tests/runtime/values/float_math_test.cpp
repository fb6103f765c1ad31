// The functions of floats: how exact they are, and that lanes have the bits of single floats.
#include <rddl/random/distributions/normal_quantile.hpp>
#include <rddl/values/math.hpp>
#include <rddl/values/pack_ops.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace rddl {
namespace {

constexpr int width = 16;
using Floats = Lanes<float, width>;
constexpr float infinity = std::numeric_limits<float>::infinity();

double ulps(float found, double exact) {
    const float nearest = std::fabs(static_cast<float>(exact));
    return std::fabs(double{found} - exact) / (std::nextafter(nearest, infinity) - nearest);
}

// Half a million arguments from `lowest` to `highest`, evenly spaced by their bits if `by_bits`.
template <class Function, class Exact>
void expect_accuracy(float lowest, float highest, double bound, Function function, Exact exact,
                     bool by_bits = false) {
    constexpr int count = 500'000;
    double worst = 0;
    for (int i = 0; i < count; i += width) {
        Floats arguments;
        for (int lane = 0; lane < width; ++lane) {
            const double part = static_cast<double>(i + lane) / count;
            const auto between =
                bits_of(lowest) +
                static_cast<std::uint32_t>(static_cast<double>(bits_of(highest) - bits_of(lowest)) *
                                           part);
            arguments.set(lane, by_bits ? real_of_bits(between)
                                        : static_cast<float>(lowest + (highest - lowest) * part));
        }
        const Floats results = function(arguments);
        for (int lane = 0; lane < width; ++lane) {
            const float alone = function(arguments[lane]);
            ASSERT_EQ(bits_of(alone), bits_of(results[lane])) << arguments[lane];
            worst = std::fmax(worst, ulps(alone, exact(double{arguments[lane]})));
        }
    }
    EXPECT_LE(worst, bound);
}

#define RDDL_OF(function)   \
    [](auto x) {            \
        return function(x); \
    }

TEST(FloatMath, IsAccurate) {
    expect_accuracy(-87, 88, 1.1, RDDL_OF(exp), RDDL_OF(std::exp));
    expect_accuracy(0.4f, 2.5f, 1.0, RDDL_OF(ln), RDDL_OF(std::log));
    expect_accuracy(1e-44f, 3e38f, 1.0, RDDL_OF(ln), RDDL_OF(std::log), true);
    expect_accuracy(-3, 3, 1.7, RDDL_OF(sin), RDDL_OF(std::sin));
    expect_accuracy(1e-30f, 3, 1.7, RDDL_OF(sin), RDDL_OF(std::sin), true);
    expect_accuracy(-1.5f, 1.5f, 1.7, RDDL_OF(cos), RDDL_OF(std::cos));
    for (const float farthest : {1e6f, 0x1p24f, 0x1p26f}) {
        expect_accuracy(9000, farthest, 0.51, RDDL_OF(sin), RDDL_OF(std::sin));
        expect_accuracy(9000, farthest, 0.51, RDDL_OF(cos), RDDL_OF(std::cos));
    }
    expect_accuracy(1e-44f, 0.9999999f, 5, RDDL_OF(normal_quantile), RDDL_OF(normal_quantile),
                    true);
}

TEST(FloatMath, IsRoundedFromDoubles) {
    expect_accuracy(-1.5f, 1.5f, 0.51, RDDL_OF(tan), RDDL_OF(std::tan));
    expect_accuracy(1e-44f, 1e30f, 0.51, RDDL_OF(tan), RDDL_OF(std::tan), true);
    expect_accuracy(0, 0x1.1p24f, 0.51, RDDL_OF(tan), RDDL_OF(std::tan));
    expect_accuracy(-1, 1, 0.51, RDDL_OF(asin), RDDL_OF(std::asin));
    expect_accuracy(-1, 1, 0.51, RDDL_OF(acos), RDDL_OF(std::acos));
    expect_accuracy(-30, 30, 0.51, RDDL_OF(atan), RDDL_OF(std::atan));
    expect_accuracy(1e-44f, 3e38f, 0.51, RDDL_OF(atan), RDDL_OF(std::atan), true);
    expect_accuracy(-30, 30, 0.51, RDDL_OF(sinh), RDDL_OF(std::sinh));
    expect_accuracy(-30, 30, 0.51, RDDL_OF(cosh), RDDL_OF(std::cosh));
    expect_accuracy(-5, 5, 0.51, RDDL_OF(tanh), RDDL_OF(std::tanh));
    expect_accuracy(-5, 5, 0.51, RDDL_OF(exp_minus_one), RDDL_OF(std::expm1));
    expect_accuracy(-0.9f, 5, 0.51, RDDL_OF(ln_one_plus), RDDL_OF(std::log1p));
}

// Powers of all floats with an exponent, and of a base with many exponents.
TEST(FloatMath, HasPowersThatAreRoundedFromDoubles) {
    for (const float exponent : {1.0f / 3.0f, 0.5f, 1.0f, 1.5f, -0.7f, 3.0f, -1.0f, 0.01f}) {
        const auto power_of = [=](auto x) {
            return power(x, decltype(x)(exponent));
        };
        const auto exact = [=](double x) {
            return std::pow(x, double{exponent});
        };
        const bool grows = exponent > 0.0f;  // results stay within the floats, subnormal ones too
        expect_accuracy(grows ? 1e-44f : 1e-20f, 1e12f, 0.51, power_of, exact, true);
    }
    for (const float base : {0.99999f, 1.00001f, 0.3f, 7.5f, 1e-40f}) {
        const auto power_to = [=](auto x) {
            return power(decltype(x)(base), x);
        };
        const float greatest = 85.0f / std::fabs(std::log(base));
        expect_accuracy(-greatest, greatest, 0.51, power_to,
                        [=](double x) { return std::pow(double{base}, x); });
    }
}

// Their remainders have the bits of those of doubles, rounded, alone and in packs.
TEST(FloatMath, HasTheRemaindersOfDoubles) {
    constexpr float special[] = {
        0.0f,       -0.0f, 1e-45f,   -1e-45f,   3.4e38f,
        1.0f,       -2.5f, infinity, -infinity, std::numeric_limits<float>::quiet_NaN(),
        6.2831855f, -7.0f, 3e6f,     -14.0f,    5e-7f};
    const auto expect_same = [](const Floats& a, const Floats& b) {
        const Floats together = floor_mod(a, b);
        for (int lane = 0; lane < width; ++lane) {
            const float exact = to_float(floor_mod(to_double(a[lane]), to_double(b[lane])));
            for (const float found : {floor_mod(a[lane], b[lane]), together[lane]})
                EXPECT_TRUE(bits_of(found) == bits_of(exact) ||
                            (std::isnan(found) && std::isnan(exact)))
                    << a[lane] << " " << b[lane];
        }
    };
    for (const float a : special)
        for (const float b : special) expect_same(a, b);
    for (const float divisor : {6.2831855f, -0.3f, 1e-3f, 1.0f, 1e30f})
        for (int i = 0; i < 20'000; ++i) {
            Floats a;  // near multiples of the divisor, and between them
            for (int lane = 0; lane < width; ++lane) {
                const float multiple = divisor * static_cast<float>(i * 100 - 1'000'000);
                const float steps[] = {std::nextafter(multiple, infinity),
                                       std::nextafter(multiple, -infinity), multiple};
                a.set(lane, lane < 3 ? steps[lane]
                                     : multiple + divisor * static_cast<float>(lane) * 0.07f);
            }
            expect_same(a, divisor);
        }
}

// Angles up to 2^13 have a small absolute error, though zeros are not met to the last bit.
TEST(FloatMath, TurnsFarAngles) {
    for (float angle = -8192; angle < 8192; angle += 0.37f) {
        EXPECT_NEAR(sin(angle), std::sin(double{angle}), 1.2e-7) << angle;
        EXPECT_NEAR(cos(angle), std::cos(double{angle}), 1.2e-7) << angle;
    }
}

// Sines beyond 2^13 are those of doubles, rounded, although doubles take more care.
// RDDL_MATH_FLOATS=1 compares all floats; otherwise, each so many-th is compared.
TEST(FloatMath, HasTheSinesOfDoublesBeyond) {
    const char* const text = std::getenv("RDDL_MATH_FLOATS");
    const std::uint32_t step = text ? static_cast<std::uint32_t>(std::atoi(text)) : 997;
    std::uint32_t next = bits_of(0x1p13f) + 1;
    while (next <= bits_of(0x1p25f)) {
        Floats angles;
        for (int lane = 0; lane < width; ++lane, next += step)
            angles.set(lane, real_of_bits(next) * (lane % 2 == 0 ? 1.0f : -1.0f));
        const Floats sines = sin(angles), cosines = cos(angles);
        for (int lane = 0; lane < width; ++lane) {
            const float a = angles[lane];
            ASSERT_EQ(sines[lane], to_float(sin(to_double(a)))) << a;
            ASSERT_EQ(cosines[lane], to_float(cos(to_double(a)))) << a;
        }
    }
}

// Near and far angles, those of the C library and none stand side by side.
TEST(FloatMath, HasTheSameSinesInAnyLanes) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const std::array<float, width> values = {
        0.0f,  -0.0f,     0x1p-13f,  0x1p13f, -0x1.000002p13f, 9e3f,
        -1e6f, 0x1p24f,   -0x1p24f,  3e7f,    0x1.000002p24f,  infinity,
        nan,   -infinity, 0x1p-149f, 3e38f,
    };
    const Floats angles = Floats::load(values.data());
    const Floats sines = sin(angles), cosines = cos(angles);
    for (int lane = 0; lane < width; ++lane) {
        const float s = sin(angles[lane]), c = cos(angles[lane]);
        if (std::isfinite(angles[lane])) {
            EXPECT_EQ(bits_of(sines[lane]), bits_of(s)) << angles[lane];
            EXPECT_EQ(bits_of(cosines[lane]), bits_of(c)) << angles[lane];
        } else {
            EXPECT_TRUE(std::isnan(sines[lane]) && std::isnan(s)) << angles[lane];
            EXPECT_TRUE(std::isnan(cosines[lane]) && std::isnan(c)) << angles[lane];
        }
    }
}

TEST(FloatMath, HasTheRareCases) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(exp(-infinity), 0.0f);
    EXPECT_EQ(exp(infinity), infinity);
    EXPECT_EQ(exp(-104.5f), 0.0f);
    EXPECT_EQ(exp(-103.0f), 0x1p-149f);
    EXPECT_EQ(exp(89.0f), infinity);
    EXPECT_EQ(exp(0.0f), 1.0f);
    EXPECT_EQ(ln(0.0f), -infinity);
    EXPECT_EQ(ln(infinity), infinity);
    EXPECT_EQ(ln(1.0f), 0.0f);
    EXPECT_TRUE(std::signbit(sin(-0.0f)));
    EXPECT_EQ(power(-2.0f, 3.0f), -8.0f);
    for (const float base : {-infinity, -2.0f, -1.0f, -0.0f, 0.0f, 0.5f, 1.0f, 3.0f, infinity, nan})
        for (const float exponent : {-infinity, -3.0f, -2.0f, -0.5f, 0.0f, 0.5f, 1.0f, 2.0f, 3.0f,
                                     100.0f, 1e30f, infinity, nan}) {
            const float found = power(base, exponent);
            const auto expected = to_float(power(double{base}, double{exponent}));
            EXPECT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected)))
                << base << " " << exponent;
            EXPECT_TRUE(std::isnan(found) || std::signbit(found) == std::signbit(expected))
                << base << " " << exponent;
        }
    EXPECT_TRUE(std::signbit(tan(-0.0f)));
    EXPECT_TRUE(std::signbit(atan(-0.0f)));
    EXPECT_EQ(atan(-infinity), to_float(std::atan(-double{infinity})));
    for (const float none : {exp(nan), ln(-1.0f), ln(nan), sin(infinity), cos(nan), tan(infinity),
                             tan(nan), atan(nan)})
        EXPECT_TRUE(std::isnan(none));
}

// Packs convert, round and gather as single numbers do.
template <int n>
void expect_the_bits_of_the_scalar() {
    using SomeFloats = Lanes<float, n>;
    std::array<float, 64> table;
    std::array<float, 8> small_table;
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = static_cast<float>(i) * 0.1f;
    for (std::size_t i = 0; i < small_table.size(); ++i) small_table[i] = table[i] - 0.3f;
    SomeFloats a;
    Lanes<std::int64_t, n> places, near, great;
    for (int lane = 0; lane < n; ++lane) {
        a.set(lane, static_cast<float>(lane) * 0.75f - 5.0f);
        places.set(lane, lane * 37 % 64);
        near.set(lane, lane * 5 % 8);
        great.set(lane, (std::int64_t{1} << (4 * lane % 64)) + lane - 5);
    }
    const SomeFloats chosen = at(table, places), looked_up = at(small_table, near),
                     converted = to_float(great), root = sqrt(a * a);
    const auto rounded = round(a), lower = floor(a), upper = ceil(a);
    const SomeFloats least = minimum(a, 1.5f), picked = select(a < 0.0f, a, 2.0f);
    EXPECT_EQ((a <= 0.25f).bits, (0.25f >= a).bits);
    EXPECT_EQ((a == 0.25f).bits, 1 << 7);
    for (int lane = 0; lane < n; ++lane) {
        const float x = a[lane];
        EXPECT_EQ(chosen[lane], table[static_cast<std::size_t>(places[lane])]);
        EXPECT_EQ(looked_up[lane], small_table[static_cast<std::size_t>(near[lane])]);
        EXPECT_EQ(converted[lane], to_float(great[lane]));
        EXPECT_EQ(to_float(to_double(a))[lane], x);
        EXPECT_EQ(root[lane], std::fabs(x));
        EXPECT_EQ(rounded[lane], rddl::round(x));
        EXPECT_EQ(lower[lane], rddl::floor(x));
        EXPECT_EQ(upper[lane], rddl::ceil(x));
        EXPECT_EQ(least[lane], minimum(x, 1.5f));
        EXPECT_EQ(picked[lane], select(x < 0.0f, x, 2.0f));
    }
}

TEST(FloatLanesOf, HaveTheBitsOfTheScalar) {
    expect_the_bits_of_the_scalar<8>();  // half a register of AVX-512
    expect_the_bits_of_the_scalar<width>();
    expect_the_bits_of_the_scalar<64>();
}

// So do nan and floats beyond ints.
TEST(FloatLanesOf, BecomeIntsAsSingleFloatsDo) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float values[] = {-0.0f,    0.5f,     -0.5f,    2.5f,      0x1p62f, 0x1p63f,
                                -0x1p63f, -0x1p64f, infinity, -infinity, nan,     -7.9f};
    Floats a{0.0f};
    for (int lane = 0; lane < 12; ++lane) a.set(lane, values[lane]);
    const auto truncated = truncate_to_int(a), rounded = round(a), lower = floor(a);
    const Floats nearest = round_as_real(a), below = floor_as_real(a), above = ceil_as_real(a);
    for (int lane = 0; lane < width; ++lane) {
        const float x = a[lane];
        EXPECT_EQ(truncated[lane], truncate_to_int(to_double(x))) << x;
        EXPECT_EQ(truncate_to_int(x), truncate_to_int(to_double(x))) << x;
        EXPECT_EQ(rounded[lane], rddl::round(to_double(x))) << x;
        EXPECT_EQ(lower[lane], rddl::floor(to_double(x))) << x;
        EXPECT_EQ(bits_of(nearest[lane]), bits_of(to_float(rddl::round(x)))) << x;
        EXPECT_EQ(bits_of(below[lane]), bits_of(to_float(rddl::floor(x)))) << x;
        EXPECT_EQ(bits_of(above[lane]), bits_of(to_float(rddl::ceil(x)))) << x;
        EXPECT_EQ(bits_of(round_as_real(x)), bits_of(nearest[lane])) << x;
        EXPECT_EQ(bits_of(floor_as_real(x)), bits_of(below[lane])) << x;
        EXPECT_EQ(bits_of(ceil_as_real(x)), bits_of(above[lane])) << x;
    }
}

}  // namespace
}  // namespace rddl
