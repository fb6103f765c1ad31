// Distributions of counts against Boost.Math's distribution functions.
#include "fit.hpp"

#include <rddl/random/distributions/binomial.hpp>
#include <rddl/random/distributions/discrete.hpp>
#include <rddl/random/distributions/poisson.hpp>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/geometric.hpp>
#include <boost/math/distributions/negative_binomial.hpp>
#include <boost/math/distributions/poisson.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace rddl {
namespace {

using fit::draws_of;
using fit::expect_count_fit;
using fit::expect_mean;
using fit::with_each;

double real(std::int64_t k) {
    return static_cast<double>(k);
}

TEST(PoissonProbability, AgreesWithBoost) {
    for (const double rate : {0.5, 10.0, 77.7, 1e4, 1e6}) {
        const boost::math::poisson law(rate);
        for (double z = -4; z <= 4; z += 0.5) {
            const double k = std::floor(rate + z * std::sqrt(rate));
            if (k < 0) continue;
            EXPECT_NEAR(std::exp(ln_poisson_probability(k, rate)) / pdf(law, k), 1.0, 1e-9)
                << k << " of " << rate;
        }
    }
}

TEST(BinomialProbability, AgreesWithBoost) {
    for (const double n : {1.0, 20.0, 1000.0, 1e6})
        for (const double p : {0.01, 0.3, 0.5}) {
            const boost::math::binomial law(n, p);
            for (double z = -4; z <= 4; z += 0.5) {
                const double k = std::floor(n * p + z * std::sqrt(n * p * (1 - p)));
                if (k < 0 || k > n) continue;
                EXPECT_NEAR(std::exp(ln_binomial_probability(k, n, p)) / pdf(law, k), 1.0, 1e-9)
                    << k << " of " << n << ", " << p;
            }
        }
}

TEST(Poisson, FitsItsLaw) {
    for (const double rate :
         {1e-3, 0.1, 1.0, 5.0, 9.999, 10.0, 10.5, 12.0, 30.0, 1000.0, 1e5, 1e9}) {
        SCOPED_TRACE(rate);
        const boost::math::poisson law(rate);
        const auto draws = draws_of(
            [&](auto& context, Place place) { return sample::poisson(context, place, rate); });
        expect_count_fit(draws, [&](std::int64_t k) { return cdf(law, real(k)); });
        expect_mean(draws, rate, std::sqrt(rate));
    }
}

TEST(Poisson, OfExtremeRates) {
    Context<Scalar> context;
    EXPECT_EQ(sample::poisson(context, {}, 0.0), 0);
    EXPECT_EQ(sample::poisson(context, {}, 1e-300), 0);
    for (int i = 0; i < 1000; ++i)
        EXPECT_NEAR(real(sample::poisson(context, {0, i}, 9.2e18)), 9.2e18, 7 * std::sqrt(9.2e18));
    EXPECT_FALSE(context.fault);
}

TEST(Binomial, FitsItsLaw) {
    const std::int64_t trials[] = {1, 2, 10, 25, 100, 5000, std::int64_t{1} << 40};
    for (const std::int64_t n : trials)
        for (const double p : {1e-11, 1e-3, 0.1, 0.4, 0.5, 0.9, 0.999}) {
            SCOPED_TRACE(testing::Message() << n << ", " << p);
            const boost::math::binomial law(real(n), p);
            const auto draws = draws_of(
                [&](auto& context, Place place) { return sample::binomial(context, place, n, p); });
            expect_count_fit(draws,
                             [&](std::int64_t k) { return k < n ? cdf(law, real(k)) : 1.0; });
            expect_mean(draws, real(n) * p, std::sqrt(real(n) * p * (1 - p)) + 1e-3);
        }
}

TEST(Binomial, OfCertainties) {
    Context<Scalar> context;
    const std::int64_t greatest = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t n : {std::int64_t{0}, std::int64_t{5}, greatest}) {
        EXPECT_EQ(sample::binomial(context, {}, n, 0.0), 0);
        EXPECT_EQ(sample::binomial(context, {}, n, 1.0), n);
    }
    const std::int64_t half = sample::binomial(context, {}, greatest, 0.5);
    EXPECT_NEAR(real(half), 0x1p62, 1e11);
    EXPECT_FALSE(context.fault);
}

TEST(NegativeBinomial, CountsFailuresBeforeTheSuccesses) {
    with_each({{1.0, 0.5}, {3.0, 0.2}, {0.5, 0.3}, {2.5, 0.9}, {40.0, 0.01}, {1000.0, 0.999}},
              [](double r, double p) {
                  const boost::math::negative_binomial law(r, p);
                  const auto draws = draws_of([&](auto& context, Place place) {
                      return sample::negative_binomial(context, place, r, p);
                  });
                  expect_count_fit(draws, [&](std::int64_t k) { return cdf(law, real(k)); });
                  expect_mean(draws, r * (1 - p) / p, std::sqrt(r * (1 - p)) / p);
              });
    Context<Scalar> context;
    EXPECT_EQ(sample::negative_binomial(context, {}, 3.0, 1.0), 0);
    EXPECT_FALSE(context.fault);
}

TEST(Geometric, CountsTrialsFromOne) {
    for (const double p : {1e-6, 0.01, 0.3, 0.5, 0.95}) {
        SCOPED_TRACE(p);
        const boost::math::geometric law(p);
        const auto draws = draws_of(
            [&](auto& context, Place place) { return sample::geometric(context, place, p); });
        expect_count_fit(draws,
                         [&](std::int64_t k) { return k < 1 ? 0.0 : cdf(law, real(k - 1)); });
        expect_mean(draws, 1 / p, std::sqrt(1 - p) / p);
    }
    Context<Scalar> context;
    EXPECT_EQ(sample::geometric(context, {}, 1.0), 1);
    EXPECT_EQ(sample::geometric(context, {}, 1e-300), std::numeric_limits<std::int64_t>::max());
    EXPECT_FALSE(context.fault);
}

}  // namespace
}  // namespace rddl
