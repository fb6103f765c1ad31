// The gamma family against Boost.Math's distribution functions.
#include "fit.hpp"

#include <rddl/random/distributions/gamma.hpp>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rddl {
namespace {

using fit::draws_of;
using fit::expect_continuous_fit;
using fit::expect_mean;
using fit::with_each;

TEST(Gamma, FitsItsLawByShapeAndScale) {
    for (const double shape : {0.02, 0.1, 0.5, 0.99, 1.0, 1.01, 2.5, 30.0, 1e4, 1e8}) {
        SCOPED_TRACE(shape);
        const double scale = 3.0;
        const boost::math::gamma_distribution<> law(shape, scale);
        const auto draws = draws_of([&](auto& context, Place place) {
            return sample::gamma(context, place, shape, scale);
        });
        expect_continuous_fit(draws, [&](double x) { return cdf(law, x); });
        expect_mean(draws, shape * scale, std::sqrt(shape) * scale);
    }
}

// P(X < x) is close to (x / e^-gamma)^shape: nearly all draws underflow.
TEST(Gamma, OfTinyShapeIsTiny) {
    int zeros = 0;
    for (const double x : draws_of(
             [](auto&context, Place place) { return sample::gamma(context, place, 1e-4, 1.0); }))
        zeros += x == 0;
    const double expected = fit::draw_count * std::pow(0x1p-1074, 1e-4);
    EXPECT_NEAR(zeros, expected, 5 * std::sqrt(expected));
}

TEST(Gamma, OfHugeShapeIsItsMean) {
    Context<Scalar> context;
    EXPECT_NEAR(sample::gamma(context, {}, 1e300, 1.0) / 1e300, 1.0, 1e-12);
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(sample::gamma(context, {}, infinity, 1.0), infinity);
    EXPECT_FALSE(context.fault);
}

TEST(ChiSquare, FitsItsLaw) {
    for (const double degrees : {0.1, 1.0, 2.0, 7.5, 1000.0}) {
        SCOPED_TRACE(degrees);
        const boost::math::chi_squared law(degrees);
        const auto draws = draws_of([&](auto& context, Place place) {
            return sample::chi_square(context, place, degrees);
        });
        expect_continuous_fit(draws, [&](double x) { return cdf(law, x); });
        expect_mean(draws, degrees, std::sqrt(2 * degrees));
    }
}

TEST(Beta, FitsItsLaw) {
    with_each(
        {{1.0, 1.0}, {0.5, 0.5}, {0.1, 3.0}, {4.0, 0.3}, {2.0, 5.0}, {300.0, 20.0}, {1e6, 1e6}},
        [](double a, double b) {
            const boost::math::beta_distribution<> law(a, b);
            const auto draws = draws_of(
                [&](auto& context, Place place) { return sample::beta(context, place, a, b); });
            expect_continuous_fit(draws, [&](double x) { return cdf(law, x); });
            expect_mean(draws, mean(law), standard_deviation(law));
        });
}

// With a shape of 1e-316 the logarithms of both gamma draws are infinite.
TEST(Beta, OfTinyShapesIsACoin) {
    for (const double shape : {1e-5, 1e-300, 1e-316}) {
        int ones = 0;
        for (const double x : draws_of([&](auto&context, Place place) {
                 return sample::beta(context, place, shape, 3 * shape);
             })) {
            ASSERT_TRUE(x >= 0 && x <= 1) << x;
            ones += x > 0.5;
        }
        EXPECT_NEAR(ones, 0.25 * fit::draw_count, 5 * std::sqrt(fit::draw_count * 0.25 * 0.75))
            << shape;
    }
    Context<Scalar> context;
    EXPECT_EQ(sample::beta(context, {}, 1e-316, 1.0), 0.0);
    EXPECT_EQ(sample::beta(context, {}, 1.0, 1e-316), 1.0);
}

TEST(Student, FitsItsLaw) {
    for (const double degrees : {0.2, 1.0, 2.0, 5.0, 100.0, 1e9}) {
        SCOPED_TRACE(degrees);
        const boost::math::students_t law(degrees);
        expect_continuous_fit(draws_of([&](auto& context, Place place) {
                                  return sample::student(context, place, degrees);
                              }),
                              [&](double x) { return cdf(law, x); });
    }
    Context<Scalar> context;
    const double normal = sample::student(context, {}, std::numeric_limits<double>::infinity());
    EXPECT_LT(std::fabs(normal), 9);
}

}  // namespace
}  // namespace rddl
