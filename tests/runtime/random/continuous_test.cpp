// The distributions drawn by inversion against Boost.Math's distribution functions.
#include "fit.hpp"

#include <rddl/random/distributions/continuous.hpp>

#include <boost/math/distributions/normal.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rddl {
namespace {

using fit::draws_of;
using fit::expect_continuous_fit;
using fit::expect_mean;
using fit::with_each;

TEST(NormalQuantile, AgreesWithBoost) {
    const boost::math::normal law;
    for (double p = 0x1p-53; p < 0.5; p *= 1.1)
        EXPECT_NEAR(normal_quantile(p) / quantile(law, p), 1.0, 2e-15) << p;
    for (double p = 0.0005; p < 1; p += 0.0005)
        EXPECT_NEAR(normal_quantile(p), quantile(law, p), 1e-14) << p;
}

TEST(NormalQuantile, IsSymmetric) {
    for (double p = 0x1p-53; p < 0.5; p *= 2)
        EXPECT_EQ(normal_quantile(1 - p), -normal_quantile(p));
    EXPECT_EQ(normal_quantile(0.5), 0.0);
}

TEST(Uniform, FitsItsLaw) {
    with_each({{0.0, 1.0}, {-3.0, 5.0}, {1e9, 1e9 + 1}}, [](double lower, double upper) {
        expect_continuous_fit(draws_of([&](auto& context, Place place) {
                                  return sample::uniform(context, place, lower, upper);
                              }),
                              [&](double x) { return (x - lower) / (upper - lower); });
    });
}

TEST(Uniform, StaysBelowItsUpperBound) {
    const double upper = std::nextafter(1.0, 2.0);
    for (const double x : draws_of([&](auto&context, Place place) {
             return sample::uniform(context, place, 1.0, upper);
         }))
        EXPECT_EQ(x, 1.0);
    Context<Scalar> context;
    EXPECT_EQ(sample::uniform(context, {}, 2.5, 2.5), 2.5);
    EXPECT_FALSE(context.fault);
}

TEST(Normal, FitsItsLawByVariance) {
    with_each({{0.0, 1.0}, {-3.0, 4.0}, {100.0, 1e-6}}, [](double mean, double variance) {
        const boost::math::normal law(mean, std::sqrt(variance));
        const auto draws = draws_of([&](auto& context, Place place) {
            return sample::normal(context, place, mean, variance);
        });
        expect_continuous_fit(draws, [&](double x) { return cdf(law, x); });
        expect_mean(draws, mean, std::sqrt(variance));
    });
}

TEST(Normal, OfVarianceZeroIsItsMean) {
    Context<Scalar> context;
    EXPECT_EQ(sample::normal(context, {}, 3.25, 0.0), 3.25);
    EXPECT_TRUE(std::isnan(sample::normal(context, {}, std::nan(""), 1.0)));
    EXPECT_FALSE(context.fault);
}

// Neighbours are made together, and one draw from several distributions may share a series.
TEST(StandardDraws, AreThoseOfTheirUniformNumbers) {
    Context<Scalar> context{stream_key(1, 2, 3), 4, {}}, other = context;
    for (Index index = 0; index < 100; ++index) {
        const double u = open_uniform_at(other, {5, index});
        EXPECT_EQ(sample::normal(context, {5, index}, 0.0, 1.0), normal_quantile(u));
        EXPECT_EQ(uniform_at(context, {5, index}), uniform_at(other, {5, index}));
        EXPECT_EQ(sample::exponential(context, {5, index}, 1.0), -ln(u));
        EXPECT_EQ(sample::normal(context, {8, index}, 0.0, 1.0),
                  normal_quantile(open_uniform_at(other, {8, index})));
        EXPECT_EQ(sample::exponential(context, {5, 7}, 1.0), -ln(open_uniform_at(other, {5, 7})));
    }
}

TEST(Exponential, FitsItsLawByMean) {
    for (const double mean : {1.0, 20.0, 1e-9}) {
        const auto draws = draws_of(
            [&](auto& context, Place place) { return sample::exponential(context, place, mean); });
        expect_continuous_fit(draws, [&](double x) { return -std::expm1(-x / mean); });
        expect_mean(draws, mean, mean);
    }
}

TEST(Weibull, FitsItsLaw) {
    with_each({{1.0, 1.0}, {0.2, 3.0}, {7.0, 0.5}, {200.0, 1.0}}, [](double shape, double scale) {
        expect_continuous_fit(draws_of([&](auto& context, Place place) {
                                  return sample::weibull(context, place, shape, scale);
                              }),
                              [&](double x) { return -std::expm1(-std::pow(x / scale, shape)); });
    });
}

TEST(Pareto, FitsLomaxLaw) {
    with_each({{1.0, 1.0}, {0.3, 2.0}, {50.0, 10.0}}, [](double shape, double scale) {
        expect_continuous_fit(
            draws_of([&](auto& context, Place place) {
                return sample::pareto(context, place, shape, scale);
            }),
            [&](double x) { return -std::expm1(-shape * std::log1p(x / scale)); });
    });
    const auto draws = draws_of(
        [](auto& context, Place place) { return sample::pareto(context, place, 5.0, 2.0); });
    expect_mean(draws, 2.0 / 4.0, std::sqrt(4.0 * 5.0 / (16.0 * 3.0)));
}

TEST(Gumbel, FitsTheLawOfMaxima) {
    with_each({{0.0, 1.0}, {-5.0, 3.0}}, [](double location, double scale) {
        const auto draws = draws_of([&](auto& context, Place place) {
            return sample::gumbel(context, place, location, scale);
        });
        expect_continuous_fit(
            draws, [&](double x) { return std::exp(-std::exp(-(x - location) / scale)); });
        expect_mean(draws, location + std::numbers::egamma * scale,
                    std::numbers::pi / std::sqrt(6.0) * scale);
    });
}

TEST(Laplace, FitsItsLaw) {
    with_each({{0.0, 1.0}, {2.0, 0.1}}, [](double location, double scale) {
        expect_continuous_fit(draws_of([&](auto& context, Place place) {
                                  return sample::laplace(context, place, location, scale);
                              }),
                              [&](double x) {
                                  const double z = (x - location) / scale;
                                  return z < 0 ? 0.5 * std::exp(z) : 1 - 0.5 * std::exp(-z);
                              });
    });
}

TEST(Cauchy, FitsItsLaw) {
    with_each({{0.0, 1.0}, {2.0, 30.0}}, [](double location, double scale) {
        expect_continuous_fit(draws_of([&](auto& context, Place place) {
                                  return sample::cauchy(context, place, location, scale);
                              }),
                              [&](double x) {
                                  const double z = (x - location) / scale;
                                  return 0.5 + std::atan(z) / std::numbers::pi;
                              });
    });
}

TEST(Gompertz, FitsItsLaw) {
    with_each({{1.0, 1.0}, {0.01, 2.0}, {30.0, 0.1}}, [](double shape, double rate) {
        expect_continuous_fit(draws_of([&](auto& context, Place place) {
                                  return sample::gompertz(context, place, shape, rate);
                              }),
                              [&](double x) { return -std::expm1(-shape * std::expm1(rate * x)); });
    });
}

TEST(Kumaraswamy, FitsItsLaw) {
    with_each({{1.0, 1.0}, {2.0, 5.0}, {0.5, 0.5}, {8.0, 0.3}, {0.3, 9.0}}, [](double a, double b) {
        expect_continuous_fit(draws_of([&](auto& context, Place place) {
                                  return sample::kumaraswamy(context, place, a, b);
                              }),
                              [&](double x) { return 1 - std::pow(1 - std::pow(x, a), b); });
    });
}

}  // namespace
}  // namespace rddl
