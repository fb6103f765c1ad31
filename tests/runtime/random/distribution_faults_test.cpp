// Parameters outside their domains: which fault, with which value, and that nothing hangs.
#include <rddl/random/distributions.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>

namespace rddl {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
const Place place{7, 9};

// The call records the fault with the value at fault, and evaluates to zero.
template <class Draw>
void expect_fault(FaultKind kind, double value, Draw draw) {
    Context<Scalar> context;
    EXPECT_EQ(static_cast<double>(draw(context)), 0.0);
    EXPECT_EQ(context.fault.kind, kind) << "for " << value;
    EXPECT_EQ(context.fault.place, place);
    EXPECT_TRUE(context.fault.value == value ||
                (std::isnan(value) && std::isnan(context.fault.value)))
        << context.fault.value << " instead of " << value;
}

template <class Draw>
void expect_no_fault(Draw draw) {
    Context<Scalar> context;
    draw(context);
    EXPECT_FALSE(context.fault) << static_cast<int>(context.fault.kind);
}

template <class Draw>
void expect_faults(FaultKind kind, std::initializer_list<double> values, Draw draw) {
    for (const double value : values)
        expect_fault(kind, value, [&](Context<Scalar>& context) { return draw(context, value); });
}

TEST(DistributionFaults, Probabilities) {
    expect_faults(FaultKind::Probability, {-2e-9, 1.000000002, nan, infinity},
                  [](auto& context, double p) { return sample::bernoulli(context, place, p); });
    expect_faults(FaultKind::Probability, {-2e-9, 1.000000002, nan},
                  [](auto& context, double p) { return sample::binomial(context, place, 3, p); });
    expect_faults(FaultKind::PositiveProbability, {0.0, -0.5, 1.5, nan},
                  [](auto& context, double p) { return sample::geometric(context, place, p); });
    expect_faults(
        FaultKind::PositiveProbability, {0.0, -0.5, 1.5, nan},
        [](auto& context, double p) { return sample::negative_binomial(context, place, 2.0, p); });
    expect_faults(FaultKind::Weight, {-2e-9, nan}, [](auto& context, double w) {
        return sample::discrete(context, place, std::array{w, 1.0});
    });
    expect_faults(FaultKind::Weight, {-2e-9, nan}, [](auto& context, double w) {
        return sample::unnormalised_discrete(context, place, std::array{w, 1.0});
    });
}

// A negative weight counts as rounding only in relation to the others.
TEST(DistributionFaults, WeightsAreComparedWithTheirSum) {
    for (const double scale : {1e-200, 1e-12, 1.0, 1e12, 1e200}) {
        const auto draw = [scale](auto& context, double w) {
            return sample::unnormalised_discrete(context, place,
                                                 std::array{scale, w * scale, 2 * scale});
        };
        expect_fault(FaultKind::Weight, -4e-9 * scale,
                     [&](Context<Scalar>& context) { return draw(context, -4e-9); });
        Context<Scalar> context{{}, 1, {}, {}};
        EXPECT_NE(draw(context, -2e-9), 1) << scale;
        EXPECT_FALSE(context.fault) << scale;
    }
    const auto all_below = [](auto& context, double w) {
        return sample::unnormalised_discrete(context, place, std::array{w, w / 2});
    };
    expect_faults(FaultKind::Weight, {-1e-300, -1e-12, -1.0, -infinity, nan}, all_below);
    expect_fault(FaultKind::Weight, nan, [](Context<Scalar>& context) {
        return sample::unnormalised_discrete(context, place, std::array{1.0, nan, -5.0});
    });
}

// Rounding brings probabilities a little out of [0, 1]: they count as 0 and 1. This also holds in
// packs, and in floats, which round more.
template <class L>
void expect_rounding_is_no_fault(Context<L> context, double rounding) {
    using Real = typename L::Real;
    using Int = typename L::Int;
    const auto always = [](const auto& condition) {
        return !any(!condition);
    };
    const Real below{static_cast<typename L::Element>(-rounding)};
    const Real above{static_cast<typename L::Element>(1.0 + rounding)};
    const Real one{1};
    for (std::uint32_t index = 0; index < 1000; ++index) {
        const Place here{7, index};
        EXPECT_TRUE(always(sample::bernoulli(context, here, above)));
        EXPECT_TRUE(always(!sample::bernoulli(context, here, below)));
        EXPECT_TRUE(always(sample::geometric(context, here, above) == Int{1}));
        EXPECT_TRUE(always(sample::negative_binomial(context, here, one, above) == Int{0}));
        EXPECT_TRUE(always(sample::binomial(context, here, Int{5}, above) == Int{5}));
        EXPECT_TRUE(always(sample::binomial(context, here, Int{5}, below) == Int{0}));
        EXPECT_TRUE(
            always(sample::discrete(context, here, std::array{below, one, below}) == Int{1}));
        EXPECT_TRUE(
            always(sample::discrete(context, here, std::array{below, above, below}) == Int{1}));
        EXPECT_TRUE(always(
            sample::unnormalised_discrete(context, here, std::array{below, one, below}) == Int{1}));
    }
    EXPECT_FALSE(any(context.faulted()));
}

TEST(DistributionFaults, AreNotMadeByRounding) {
    using L = Pack<16>;
    for (const double rounding : {2e-16, 1e-10, 1e-9}) {
        expect_rounding_is_no_fault(Context<Scalar>{{}, 1, {}, {}}, rounding);
        const auto keys = typename Context<L>::Word{1};
        expect_rounding_is_no_fault(Context<L>::of(keys, keys, keys, true), rounding);
    }
    for (const double rounding : {1.2e-7, 2e-6})
        expect_rounding_is_no_fault(Context<ScalarOf<float>>{{}, 1, {}, {}}, rounding);
}

TEST(DistributionFaults, Uniform) {
    expect_faults(FaultKind::Width, {-1.0, -infinity, infinity, nan},
                  [](auto& context, double b) { return sample::uniform(context, place, 0.0, b); });
    expect_fault(FaultKind::Width, infinity,
                 [](auto& context) { return sample::uniform(context, place, -1e308, 1e308); });
    expect_fault(FaultKind::Width, nan,
                 [](auto& context) { return sample::uniform(context, place, infinity, infinity); });
}

TEST(DistributionFaults, VarianceMeanAndRate) {
    expect_faults(FaultKind::Variance, {-1e-300, nan, -infinity},
                  [](auto& context, double v) { return sample::normal(context, place, 1.0, v); });
    expect_faults(FaultKind::Mean, {0.0, -1.0, nan}, [](auto& context, double mean) {
        return sample::exponential(context, place, mean);
    });
    expect_faults(FaultKind::Rate, {-1e-9, nan, infinity, 9.3e18},
                  [](auto& context, double rate) { return sample::poisson(context, place, rate); });
}

TEST(DistributionFaults, ShapeAndScale) {
    const auto expect = [](auto draw) {
        expect_faults(FaultKind::Shape, {0.0, -1.0, nan, -infinity},
                      [&](auto& context, double shape) { return draw(context, shape, 1.0); });
        expect_faults(FaultKind::Scale, {0.0, -1.0, nan, -infinity},
                      [&](auto& context, double scale) { return draw(context, 1.0, scale); });
    };
    expect([](auto& context, double k, double s) { return sample::weibull(context, place, k, s); });
    expect([](auto& context, double k, double s) { return sample::gamma(context, place, k, s); });
    expect([](auto& context, double k, double s) { return sample::pareto(context, place, k, s); });
    expect(
        [](auto& context, double k, double s) { return sample::gompertz(context, place, k, s); });
}

TEST(DistributionFaults, TwoShapes) {
    const auto expect = [](auto draw) {
        for (const double bad : {0.0, -1.0, nan}) {
            expect_fault(FaultKind::Shape, bad,
                         [&](auto& context) { return draw(context, bad, 1.0); });
            expect_fault(FaultKind::Shape, bad,
                         [&](auto& context) { return draw(context, 1.0, bad); });
        }
    };
    expect([](auto& context, double a, double b) { return sample::beta(context, place, a, b); });
    expect([](auto& context, double a, double b) {
        return sample::kumaraswamy(context, place, a, b);
    });
}

TEST(DistributionFaults, LocationAndScale) {
    const auto expect = [](auto draw) {
        expect_faults(FaultKind::Scale, {0.0, -1.0, nan},
                      [&](auto& context, double scale) { return draw(context, 1.0, scale); });
        expect_no_fault([&](auto& context) { return draw(context, nan, 1.0); });
    };
    expect([](auto& context, double m, double s) { return sample::gumbel(context, place, m, s); });
    expect([](auto& context, double m, double s) { return sample::laplace(context, place, m, s); });
    expect([](auto& context, double m, double s) { return sample::cauchy(context, place, m, s); });
}

TEST(DistributionFaults, DegreesOfFreedom) {
    expect_faults(FaultKind::DegreesOfFreedom, {0.0, -1.0, nan},
                  [](auto& context, double df) { return sample::student(context, place, df); });
    expect_faults(FaultKind::DegreesOfFreedom, {0.0, -1.0, nan},
                  [](auto& context, double df) { return sample::chi_square(context, place, df); });
}

TEST(DistributionFaults, Counts) {
    expect_fault(FaultKind::Trials, -1.0,
                 [](auto& context) { return sample::binomial(context, place, -1, 0.5); });
    expect_faults(FaultKind::Successes, {0.0, -1.0, nan}, [](auto& context, double r) {
        return sample::negative_binomial(context, place, r, 0.5);
    });
    Context<Scalar> context;
    EXPECT_EQ(sample::negative_binomial(context, place, 10.0, 1e-300), 0);
    EXPECT_EQ(context.fault.kind, FaultKind::CountTooLarge);
}

// Infinite and subnormal parameters end, whatever they give.
TEST(DistributionFaults, ExtremeParametersEnd) {
    Context<Scalar> context;
    for (const double a : {5e-324, 1e-300, 1e-5, 1.0, 1e5, 1e300, infinity})
        for (const double b : {5e-324, 1e-300, 1e-5, 1.0, 1e5, 1e300, infinity}) {
            sample::gamma(context, place, a, b);
            sample::beta(context, place, a, b);
            sample::weibull(context, place, a, b);
            sample::pareto(context, place, a, b);
            sample::gompertz(context, place, a, b);
            sample::kumaraswamy(context, place, a, b);
            sample::student(context, place, a);
            sample::chi_square(context, place, a);
            sample::exponential(context, place, a);
            sample::normal(context, place, a, b);
            sample::gumbel(context, place, a, b);
            sample::laplace(context, place, a, b);
            sample::cauchy(context, place, a, b);
            sample::negative_binomial(context, place, a, 0.5);
        }
    for (const std::int64_t n : {std::int64_t{1}, std::int64_t{1000}, std::int64_t{1} << 40,
                                 std::numeric_limits<std::int64_t>::max()})
        for (const double p : {5e-324, 1e-300, 1e-18, 1e-5, 0.5, 1 - 0x1p-53}) {
            const std::int64_t k = sample::binomial(context, place, n, p);
            EXPECT_TRUE(k >= 0 && k <= n) << n << ", " << p;
        }
}

}  // namespace
}  // namespace rddl
