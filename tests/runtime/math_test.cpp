// The elementary functions against the C library's of long double, whose errors are invisible here,
// and against themselves in packs.
#include "plain_pack.hpp"

#include <rddl/math.hpp>

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
#include <string>
#include <vector>

namespace rddl {
namespace {

using Long = long double;
using Pack = plain::RealPack;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Function {
    std::string name;
    double (*scalar)(double);
    Pack (*pack)(Pack);
    Long (*exact)(Long);
};

const Function own_functions[] = {
    {"exp", exp, exp, std::exp},     {"exp_minus_one", exp_minus_one, exp_minus_one, std::expm1},
    {"ln", ln, ln, std::log},        {"ln_one_plus", ln_one_plus, ln_one_plus, std::log1p},
    {"sin", sin, sin, std::sin},     {"cos", cos, cos, std::cos},
    {"tan", tan, tan, std::tan},     {"atan", atan, atan, std::atan},
    {"tanh", tanh, tanh, std::tanh},
};
const Function library_functions[] = {
    {"acos", acos, acos, std::acos},
    {"asin", asin, asin, std::asin},
    {"cosh", cosh, cosh, std::cosh},
    {"sinh", sinh, sinh, std::sinh},
};

const Function& own_function(const std::string& name) {
    return *std::find_if(std::begin(own_functions), std::end(own_functions),
                         [&](const Function& f) { return f.name == name; });
}

struct BinaryFunction {
    std::string name;
    double (*scalar)(double, double);
    Pack (*pack)(Pack, Pack);
};

const BinaryFunction binary_functions[] = {
    {"power", power, power},
    {"log", log, log},
    {"hypot", hypot, hypot},
    {"atan2", atan2, atan2},
    {"floor_mod", floor_mod, floor_mod},
};

// ------------------------------------------------------------------------------- arguments

// Where the functions change their ways, and what IEEE arithmetic treats apart.
std::vector<double> special_arguments() {
    std::vector<double> magnitudes = {0.0,
                                      0x1p-1074,
                                      0x1.8p-1060,
                                      0x1p-1022,
                                      1e-300,
                                      0x1p-54,
                                      0x1p-53,
                                      0x1p-28,
                                      0x1p-27,
                                      1e-5,
                                      0.1,
                                      1.0 / 3.0,
                                      0.4375,
                                      0.5,
                                      0.7,
                                      1.0,
                                      1.5,
                                      2.0,
                                      3.0,
                                      4.0,
                                      5.0,
                                      22.0,
                                      37.5,
                                      40.0,
                                      709.0,
                                      709.7827,
                                      709.79,
                                      710.0,
                                      745.0,
                                      745.14,
                                      750.0,
                                      1e4,
                                      0x1p20,
                                      1e7,
                                      0x1p51,
                                      0x1p52,
                                      0x1p53,
                                      1e22,
                                      1e100,
                                      1e300,
                                      detail::greatest_real,
                                      infinity,
                                      std::numbers::pi,
                                      std::numbers::pi / 2,
                                      std::numbers::pi / 4,
                                      std::numbers::ln2,
                                      std::numbers::sqrt2,
                                      0x1p52 - 0.5,
                                      0x1p53 - 1,
                                      nan};
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

// Of any sign, exponent and significand, or of a size that occurs in models.
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

struct Range {
    std::string name;
    double low;
    double high;
    double bound;
};

// The bounds that docs/mathematics.md states.
const Range ranges[] = {
    {"exp", -1.0, 1.0, 0.8},
    {"exp", -746.0, 710.0, 0.8},
    {"exp_minus_one", -1.0, 1.0, 1.3},
    {"exp_minus_one", -45.0, 710.0, 1.3},
    {"ln", 0.5, 2.0, 0.9},
    {"ln", 0.99, 1.01, 0.9},
    {"ln", 0.0, 1e5, 0.9},
    {"ln_one_plus", -1.0, 2.0, 0.9},
    {"ln_one_plus", -1e-3, 1e-3, 0.9},
    {"ln_one_plus", 0.0, 1e5, 0.9},
    {"sin", -1.0, 1.0, 1.0},
    {"sin", -20.0, 20.0, 1.0},
    {"sin", -0x1p20, 0x1p20, 1.0},
    {"cos", -1.0, 1.0, 0.9},
    {"cos", -20.0, 20.0, 0.9},
    {"cos", -0x1p20, 0x1p20, 0.9},
    {"tan", -1.0, 1.0, 1.2},
    {"tan", -20.0, 20.0, 1.2},
    {"tan", -0x1p20, 0x1p20, 1.2},
    {"atan", -1.0, 1.0, 0.8},
    {"atan", -10.0, 10.0, 0.8},
    {"tanh", -1.0, 1.0, 1.0},
    {"tanh", -25.0, 25.0, 1.0},
};

// RDDL_MATH_ARGUMENTS sets how many arguments a range gets.
int argument_count() {
    const char* text = std::getenv("RDDL_MATH_ARGUMENTS");
    return text ? std::atoi(text) : 100'000;
}

void report(const std::string& name, const std::string& where, double worst, double at) {
    std::cout << name << " " << where << ": " << worst << " ulp at " << at << "\n";
}

TEST(Accuracy, IsWithinTheBounds) {
    Random random(1);
    for (const Range& range : ranges) {
        const Function& f = own_function(range.name);
        double worst = 0, worst_argument = 0;
        for (int i = 0; i < argument_count(); ++i) {
            const double a = between(random, range.low, range.high);
            const double error = error_in_ulps(f.scalar(a), f.exact(a));
            if (error > worst) worst = error, worst_argument = a;
        }
        EXPECT_LE(worst, range.bound) << range.name << " of " << worst_argument;
        report(range.name,
               "from " + std::to_string(range.low) + " to " + std::to_string(range.high), worst,
               worst_argument);
    }
}

TEST(Accuracy, HoldsForArgumentsOfAllSizes) {
    Random random(2);
    for (const Function& f : own_functions) {
        double worst = 0, worst_argument = 0;
        for (int i = 0; i < argument_count(); ++i) {
            const double a = std::bit_cast<double>(random());
            const double error = error_in_ulps(f.scalar(a), f.exact(a));
            if (error > worst) worst = error, worst_argument = a;
        }
        EXPECT_LE(worst, 1.3) << f.name << " of " << worst_argument;
        report(f.name, "of any size", worst, worst_argument);
    }
}

// Exponents that make the results fill the range of double.
TEST(Accuracy, OfPowersIsWithinTheBounds) {
    Random random(3);
    double worst = 0, worst_base = 0;
    double worst_of_small = 0, worst_small_base = 0;
    for (int i = 0; i < argument_count(); ++i) {
        const double size = i % 2 ? 700.0 : 1.0;
        const double base = std::exp(between(random, -size, size));
        const double exponent = between(random, -745.0, 709.0) / std::log(base);
        const double error =
            error_in_ulps(power(base, exponent), std::pow(Long{base}, Long{exponent}));
        if (error > worst) worst = error, worst_base = base;
        const double small = between(random, -10.0, 10.0) / std::log(base);
        const double error_of_small =
            error_in_ulps(power(base, small), std::pow(Long{base}, Long{small}));
        if (error_of_small > worst_of_small)
            worst_of_small = error_of_small, worst_small_base = base;
    }
    EXPECT_LE(worst, 1.2) << worst_base;
    EXPECT_LE(worst_of_small, 0.7) << worst_small_base;
    report("power", "up to overflow", worst, worst_base);
    report("power", "from e^-10 to e^10", worst_of_small, worst_small_base);
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

// ------------------------------------------------------------------------ special arguments

TEST(SpecialArguments, AreTreatedAsByC) {
    for (const Function& f : own_functions)
        for (const double a : special_arguments()) {
            const double value = f.scalar(a), expected = static_cast<double>(f.exact(a));
            EXPECT_LE(error_in_ulps(value, f.exact(a)), 1.3)
                << f.name << "(" << a << ") = " << value;
            if (expected == 0) {
                EXPECT_EQ(std::signbit(value), std::signbit(expected)) << f.name << "(" << a << ")";
            }
        }
}

TEST(SpecialArguments, OfPowersAreTreatedAsByC) {
    for (const double base : special_arguments())
        for (const double exponent : special_arguments()) {
            const double value = power(base, exponent);
            const Long exact = std::pow(Long{base}, Long{exponent});
            const double expected = static_cast<double>(exact);
            EXPECT_LE(error_in_ulps(value, exact), 1.2)
                << base << "^" << exponent << " = " << value;
            if (expected == 0) {
                EXPECT_EQ(std::signbit(value), std::signbit(expected)) << base << "^" << exponent;
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
    for (const Function& f : own_functions) expect_same_bits(f, arguments);
    for (const Function& f : library_functions) expect_same_bits(f, arguments);
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
    for (int i = 0; i < 20'000; ++i) {
        const double a = static_cast<double>(random() >> 11) * 0x1p-46 - 64.0;
        const double b = static_cast<double>(random() >> 11) * 0x1p-50;
        for (const Function& f : own_functions)
            sum = sum * 31 + bits_of(f.scalar(f.name.starts_with("ln") ? b : a));
        sum = sum * 31 + bits_of(power(b, a));
    }
    EXPECT_EQ(sum, 15939038807909110581u);
}

}  // namespace
}  // namespace rddl
