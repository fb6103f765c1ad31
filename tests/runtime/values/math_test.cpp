// The elementary functions against the C library's of long double, whose errors are invisible here,
// and against themselves in packs.
#include "plain_pack.hpp"

#include <rddl/random/distributions/normal_quantile.hpp>
#include <rddl/values/math.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace rddl {
namespace {

using Long = long double;
using Pack = plain::RealPack;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

static_assert(std::numeric_limits<Long>::digits >= 64, "long double is no reference here");

struct Interval {
    double low;
    double high;
};

// The bounds, in units of the last place, are those that docs/mathematics.md states.
struct Function {
    std::string name;
    double (*scalar)(double);
    Pack (*pack)(Pack);
    Long (*exact)(Long);
    double bound;
    std::vector<Interval> intervals;
};

const Function functions[] = {
    {"exp", exp, exp, std::exp, 0.8, {{-1, 1}, {-746, 710}}},
    {"exp_minus_one", exp_minus_one, exp_minus_one, std::expm1, 1.3, {{-1, 1}, {-45, 710}}},
    {"ln", ln, ln, std::log, 0.9, {{0.5, 2}, {0.99, 1.01}, {0, 1e5}}},
    {"ln_one_plus", ln_one_plus, ln_one_plus, std::log1p, 0.9, {{-1, 2}, {-1e-3, 1e-3}, {0, 1e5}}},
    {"sin", sin, sin, std::sin, 1.0, {{-1, 1}, {-20, 20}, {-0x1p20, 0x1p20}, {0x1p20, 0x1p24}}},
    {"cos", cos, cos, std::cos, 1.0, {{-1, 1}, {-20, 20}, {-0x1p20, 0x1p20}, {0x1p20, 0x1p24}}},
    {"tan", tan, tan, std::tan, 1.2, {{-1, 1}, {-20, 20}, {-0x1p20, 0x1p20}, {0x1p20, 0x1p24}}},
    {"asin", asin, asin, std::asin, 0.7, {{-1, 1}}},
    {"acos", acos, acos, std::acos, 0.7, {{-1, 1}}},
    {"atan", atan, atan, std::atan, 0.8, {{-1, 1}, {-10, 10}}},
    {"sinh", sinh, sinh, std::sinh, 1.3, {{-1, 1}, {-711, 711}}},
    {"cosh", cosh, cosh, std::cosh, 0.9, {{-1, 1}, {-711, 711}}},
    {"tanh", tanh, tanh, std::tanh, 1.0, {{-1, 1}, {-25, 25}}},
};

struct BinaryFunction {
    std::string name;
    double (*scalar)(double, double);
    Pack (*pack)(Pack, Pack);
    Long (*exact)(Long, Long);
    double bound;
};

Long floor_mod_of_long(Long a, Long b) {
    const Long remainder = std::fmod(a, b);
    if (remainder == 0) return std::copysign(Long{0}, b);
    return (remainder < 0) != (b < 0) ? remainder + b : remainder;
}

const BinaryFunction binary_functions[] = {
    {"power", power, power, std::pow, 1.2},
    {"log", log, log, [](Long a, Long base) { return std::log(a) / std::log(base); }, 2.5},
    {"hypot", hypot, hypot, std::hypot, 0.501},
    {"atan2", atan2, atan2, std::atan2, 1.6},
    {"floor_mod", floor_mod, floor_mod, floor_mod_of_long, 1.0},
};

// ------------------------------------------------------------------------------- arguments

// Arguments at which the functions change their method, and special values of IEEE arithmetic.
std::vector<double> special_arguments() {
    const double magnitudes[] = {
        // clang-format off
        0.0, 0x1p-1074, 0x1.8p-1060, 0x1p-1022, 1e-300, 0x1p-54, 0x1p-53, 0x1p-28, 0x1p-27, 1e-5,
        0.1, 1.0 / 3.0, 0.4142, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 22.0, 37.5, 40.0,
        709.0, 709.7827, 709.79, 710.0, 745.0, 745.14, 750.0, 1e4, 0x1p20, 1e7, 0x1p24,
        0x1p51, 0x1p52 - 0.5, 0x1p52, 0x1p53 - 1, 0x1p53, 1e22, 1e100, 1e300,
        std::numbers::pi, std::numbers::pi / 2, std::numbers::pi / 4, std::numbers::ln2,
        0x1.6c6cbc45dc8dep5,  // within 2^-60 of a multiple of pi / 2, as no other up to 2^24
        std::numbers::sqrt2, detail::greatest_real, infinity, nan,
        // clang-format on
    };
    std::vector<double> result;
    for (const double a : magnitudes)
        for (const double b : {a, std::nextafter(a, 0.0), std::nextafter(a, infinity)}) {
            result.push_back(b);
            result.push_back(-b);
        }
    return result;
}

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

// A number of any sign, exponent and significand, or of a size that occurs in models.
double any_argument(Random& random) {
    switch (random() % 3) {
        case 0:
            return std::bit_cast<double>(random());
        case 1:
            return between(random, -800.0, 800.0);
        default:
            return between(random, -2.0, 2.0);
    }
}

// -------------------------------------------------------------------------------- accuracy

// The difference in units of the last place that the exact value's binade has.
double error_in_ulps(double value, Long exact) {
    const double rounded = static_cast<double>(exact);
    if (std::isnan(value) || std::isnan(rounded))
        return std::isnan(value) == std::isnan(rounded) ? 0 : infinity;
    if (std::isinf(value) || std::isinf(rounded)) return value == rounded ? 0 : infinity;
    const int exponent = std::max(exact == 0 ? -1022 : std::ilogb(exact), -1022);
    return static_cast<double>(std::fabs(value - exact) / std::ldexp(Long{1}, exponent - 52));
}

// RDDL_MATH_ARGUMENTS sets how many arguments an interval gets.
int argument_count() {
    const char* text = std::getenv("RDDL_MATH_ARGUMENTS");
    return text ? std::atoi(text) : 100'000;
}

// Expects that no error exceeds the bound, and reports the greatest.
template <class Draw>
void expect_errors_below(double bound, const std::string& what, const Draw& error_of_draw) {
    double worst = 0;
    for (int i = 0; i < argument_count(); ++i) worst = std::max(worst, error_of_draw(i));
    EXPECT_LE(worst, bound) << what;
    std::cout << what << ": " << worst << " ulp\n";
}

TEST(Accuracy, IsWithinTheBounds) {
    Random random(1);
    for (const Function& f : functions)
        for (const auto [low, high] : f.intervals) {
            std::ostringstream what;
            what << f.name << " from " << low << " to " << high;
            expect_errors_below(f.bound, what.str(), [&, low = low, high = high](int) {
                const double a = between(random, low, high);
                return error_in_ulps(f.scalar(a), f.exact(a));
            });
        }
}

TEST(Accuracy, HoldsForArgumentsOfAllSizes) {
    Random random(2);
    for (const Function& f : functions)
        expect_errors_below(f.bound, f.name + " of all sizes", [&](int) {
            const double a = std::bit_cast<double>(random());
            return error_in_ulps(f.scalar(a), f.exact(a));
        });
}

// Next to the zeros of the sine and of the cosine, and the poles of the tangent.
TEST(Accuracy, HoldsNearMultiplesOfARightAngle) {
    Random random(12);
    for (const Function& f : functions) {
        if (f.name != "sin" && f.name != "cos" && f.name != "tan") continue;
        expect_errors_below(f.bound, f.name + " near multiples of pi / 2", [&](int) {
            const double right_angles = std::floor(between(random, 1.0, 0x1p23));
            const double near = right_angles * (std::numbers::pi / 2);
            const double a = std::bit_cast<double>(bits_of(near) + random() % 9 - 4);
            return error_in_ulps(f.scalar(a), f.exact(a));
        });
    }
}

// A power of a base of any size (or near 1), with the logarithm between the limits.
double error_of_power(Random& random, int i, double least_ln, double greatest_ln) {
    const double size = i % 2 ? 700.0 : 1.0;
    const double base = std::exp(between(random, -size, size));
    const double exponent = between(random, least_ln, greatest_ln) / std::log(base);
    return error_in_ulps(power(base, exponent), std::pow(Long{base}, Long{exponent}));
}

TEST(Accuracy, OfPowersIsWithinTheBounds) {
    Random random(3);
    expect_errors_below(1.2, "power from 5e-324 to 1e308",
                        [&](int i) { return error_of_power(random, i, -745.0, 709.0); });
    expect_errors_below(0.7, "power from e^-10 to e^10",
                        [&](int i) { return error_of_power(random, i, -10.0, 10.0); });
}

TEST(Accuracy, OfTrianglesIsWithinTheBounds) {
    Random random(7);
    const auto leg = [&](int i) {
        const double size = i % 2 ? 700.0 : 2.0;
        return std::exp(between(random, -size, size)) * (random() % 2 ? 1 : -1);
    };
    expect_errors_below(0.501, "hypot", [&](int i) {
        const double x = leg(i), y = leg(i);
        return error_in_ulps(hypot(x, y), std::hypot(Long{x}, Long{y}));
    });
    expect_errors_below(1.6, "atan2", [&](int i) {
        const double x = leg(i), y = leg(i);
        return error_in_ulps(atan2(y, x), std::atan2(Long{y}, Long{x}));
    });
}

TEST(Accuracy, MakesPowersExactThatAreIntegers) {
    for (double base = 2; base < 40; ++base) {
        double exact = 1;
        for (double exponent = 0; exact < 0x1p53; ++exponent, exact *= base) {
            EXPECT_EQ(power(base, exponent), exact) << base << "^" << exponent;
            EXPECT_EQ(power(exact, 1.0), exact);
        }
    }
}

// Also in packs whose other lanes have other exponents.
TEST(Accuracy, OfFirstPowersAndOfRootsIsThatOfRealsAndRoots) {
    using Reals = Lanes<double, 8>;
    Random random(11);
    for (int i = 0; i < 10'000; ++i) {
        const double base = std::abs(any_argument(random));
        if (std::isnan(base)) continue;
        ASSERT_EQ(power(base, 0.5), std::sqrt(base)) << base;
        ASSERT_EQ(power(base, 1.0), base);
        ASSERT_EQ(power(Reals{-base}, 1.0)[2], -base);
        ASSERT_EQ(power(Reals{base}, 0.5)[3], std::sqrt(base)) << base;
        double exponents[8] = {2.0, 0.5, 1.0, 0.5, 3.0, 0.5, 0.0, -1.0};
        const Reals mixed = power(Reals{base}, Reals::load(exponents));
        for (int lane = 0; lane < 8; ++lane)
            ASSERT_EQ(mixed[lane], power(base, exponents[lane])) << base << " " << exponents[lane];
    }
    for (const double base : {0.0, -0.0, infinity, -infinity}) {
        ASSERT_EQ(bits_of(power(base, 0.5)), bits_of(std::pow(base, 0.5))) << base;
        ASSERT_EQ(bits_of(power(Reals{base}, 0.5)[1]), bits_of(std::pow(base, 0.5))) << base;
    }
    ASSERT_TRUE(std::isnan(power(-1.0, 0.5)));
}

// ------------------------------------------------------------------------ special arguments

// Near whole multiples of the divisor the rounded quotient may be one too great.
TEST(Accuracy, OfRemaindersIsThatOfTheCLibrary) {
    const auto expected = [](double a, double b) {
        const double remainder = std::fmod(a, b);
        if (remainder == 0) return std::copysign(0.0, b);
        return (remainder < 0) != (b < 0) ? remainder + b : remainder;
    };
    Random random(7);
    for (int i = 0; i < 100'000; ++i) {
        const double divisor = any_argument(random);
        const double multiple = static_cast<double>(random() >> random() % 64) * divisor;
        for (const double near : {multiple, std::nextafter(multiple, 0.0),
                                  std::nextafter(multiple, infinity), any_argument(random)})
            for (const double dividend : {near, -near}) {
                const double remainder = floor_mod(dividend, divisor);
                const double correct = expected(dividend, divisor);
                if (std::isnan(remainder) && std::isnan(correct)) continue;
                ASSERT_EQ(bits_of(remainder), bits_of(correct)) << dividend << " " << divisor;
            }
    }
}

TEST(SpecialArguments, AreTreatedAsByC) {
    for (const Function& f : functions)
        for (const double a : special_arguments()) {
            const double value = f.scalar(a), expected = static_cast<double>(f.exact(a));
            EXPECT_LE(error_in_ulps(value, f.exact(a)), f.bound)
                << f.name << "(" << a << ") = " << value;
            if (expected == 0) {
                EXPECT_EQ(std::signbit(value), std::signbit(expected)) << f.name << "(" << a << ")";
            }
        }
}

TEST(SpecialArguments, OfTwoAreTreatedAsByC) {
    for (const BinaryFunction& f : binary_functions)
        for (const double a : special_arguments())
            for (const double b : special_arguments()) {
                const double value = f.scalar(a, b);
                const Long exact = f.exact(a, b);
                const double expected = static_cast<double>(exact);
                EXPECT_LE(error_in_ulps(value, exact), f.bound)
                    << f.name << "(" << a << ", " << b << ") = " << value;
                if (expected == 0) {
                    EXPECT_EQ(std::signbit(value), std::signbit(expected))
                        << f.name << "(" << a << ", " << b << ")";
                }
            }
}

// -------------------------------------------------------------------------------- packs

bool same_bits(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) || bits_of(a) == bits_of(b);
}

std::vector<double> many_arguments(Random& random) {
    std::vector<double> result = special_arguments();
    for (int i = 0; i < 40'000; ++i) result.push_back(any_argument(random));
    std::shuffle(result.begin(), result.end(), random);
    result.resize(result.size() / plain::width * plain::width);
    return result;
}

Pack pack_of(const std::vector<double>& values, std::size_t first) {
    std::array<double, plain::width> lanes;
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first), plain::width, lanes.begin());
    return lanes;
}

void expect_same_bits(const Function& f, const std::vector<double>& arguments) {
    for (std::size_t i = 0; i < arguments.size(); i += plain::width) {
        const Pack values = f.pack(pack_of(arguments, i));
        for (std::size_t lane = 0; lane < plain::width; ++lane) {
            const double a = arguments[i + lane];
            ASSERT_TRUE(same_bits(values.lanes[lane], f.scalar(a))) << f.name << " of " << a;
        }
    }
}

TEST(Packs, GiveTheBitsOfSingleReals) {
    Random random(4);
    const std::vector<double> arguments = many_arguments(random);
    for (const Function& f : functions) expect_same_bits(f, arguments);
}

TEST(Packs, GiveTheBitsOfSingleNormalQuantiles) {
    Random random(8);
    std::vector<double> probabilities = {0x1p-53, 1e-12, 0.075, 0.5, 0.925, 1 - 0x1p-53, 1e-9, 0.9};
    for (int i = 0; i < 40'000; ++i)
        probabilities.push_back((static_cast<double>(random() >> 12) + 0.5) * 0x1p-52);
    for (std::size_t i = 0; i < probabilities.size(); i += plain::width) {
        const Pack values = normal_quantile(pack_of(probabilities, i));
        for (std::size_t lane = 0; lane < plain::width; ++lane) {
            const double p = probabilities[i + lane];
            ASSERT_TRUE(same_bits(values.lanes[lane], normal_quantile(p))) << p;
        }
    }
}

TEST(Packs, GiveTheBitsOfSingleRealsForTwoArguments) {
    Random random(5);
    std::vector<double> left = many_arguments(random), right = many_arguments(random);
    for (std::size_t i = 0; i < right.size(); i += 7) right[i] = 2.0;
    for (const BinaryFunction& f : binary_functions)
        for (std::size_t i = 0; i < left.size(); i += plain::width) {
            const Pack values = f.pack(pack_of(left, i), pack_of(right, i));
            for (std::size_t lane = 0; lane < plain::width; ++lane) {
                const double a = left[i + lane], b = right[i + lane];
                ASSERT_TRUE(same_bits(values.lanes[lane], f.scalar(a, b)))
                    << f.name << " of " << a << " and " << b;
            }
        }
}

// The same on every machine and with every compiler: a sum over the bits of many values.
TEST(Bits, AreTheSameEverywhere) {
    Random random(6);
    std::uint64_t sum = 0;
    const auto add = [&](double value) {
        sum = sum * 31 + (std::isnan(value) ? 0 : bits_of(value));
    };
    for (int i = 0; i < 20'000; ++i) {
        const double a = static_cast<double>(random() >> 11) * 0x1p-46 - 64.0;
        const double b = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
        for (const Function& f : functions) {
            add(f.scalar(a));
            add(f.scalar(b));
        }
        for (const BinaryFunction& f : binary_functions) add(f.scalar(std::fabs(a), b));
    }
    EXPECT_EQ(sum, 2037654089967663945u);
}

}  // namespace
}  // namespace rddl
