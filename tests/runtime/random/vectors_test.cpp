// Random vectors: each element against its own law, the elements together by their covariances.
#include "fit.hpp"

#include <rddl/random/distributions/vectors.hpp>
#include <rddl/values/linear_algebra.hpp>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace rddl {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;
using Counts = std::array<std::int64_t, 4>;

constexpr Vector mean{1, -2, 0.5};
constexpr Matrix covariance{{{4, 2, -1}, {2, 3, 0.5}, {-1, 0.5, 2}}};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Place place{7, 2};

Matrix factor_of(const Matrix& matrix) {
    Matrix factor;
    cholesky(3, matrix, factor);
    return factor;
}

template <class Vectors>
auto element(const Vectors& vectors, std::size_t i) {
    std::vector<typename Vectors::value_type::value_type> elements;
    for (const auto& vector : vectors) elements.push_back(vector[i]);
    return elements;
}

// The mean of the products of two elements' deviations, within five standard errors. `spread` is
// the standard deviation of one such product.
template <class Vectors>
void expect_covariance(const Vectors& vectors, std::size_t i, std::size_t j, double mean_i,
                       double mean_j, double expected, double spread) {
    std::vector<double> products;
    for (const auto& vector : vectors) {
        products.push_back((static_cast<double>(vector[i]) - mean_i) *
                           (static_cast<double>(vector[j]) - mean_j));
    }
    SCOPED_TRACE(testing::Message() << "elements " << i << ", " << j);
    fit::expect_mean(products, expected, spread);
}

TEST(MultivariateNormal, FitsItsLaw) {
    const Matrix factor = factor_of(covariance);
    const auto draws = fit::draws_of([&](auto& context, Place at) {
        Vector draw;
        sample::multivariate_normal(context, at, 3, mean, factor, draw);
        return draw;
    });
    for (std::size_t i = 0; i < 3; ++i) {
        const boost::math::normal law(mean[i], std::sqrt(covariance[i][i]));
        fit::expect_continuous_fit(element(draws, i), [&](double x) { return cdf(law, x); });
        for (std::size_t j = 0; j < i; ++j) {
            const double c = covariance[i][j];
            const double spread = std::sqrt(covariance[i][i] * covariance[j][j] + c * c);
            expect_covariance(draws, i, j, mean[i], mean[j], c, spread);
        }
    }
}

// One element is mean + l t; the covariance is that of the normal times df / (df - 2).
TEST(MultivariateStudent, HasIndependentComponents) {
    const Matrix factor = factor_of(covariance);
    const double degrees = 9;
    const auto draws = fit::draws_of([&](auto& context, Place at) {
        Vector draw;
        sample::multivariate_student(context, at, 3, degrees, mean, factor, draw);
        return draw;
    });
    const boost::math::students_t law(degrees);
    fit::expect_continuous_fit(element(draws, 0),
                               [&](double x) { return cdf(law, (x - mean[0]) / factor[0][0]); });
    std::vector<double> second;  // L z without the share of the first component
    for (const Vector& draw : draws) {
        const double z = (draw[0] - mean[0]) / factor[0][0];
        second.push_back((draw[1] - mean[1] - factor[1][0] * z) / factor[1][1]);
    }
    fit::expect_continuous_fit(second, [&](double x) { return cdf(law, x); });
    const double stretch = degrees / (degrees - 2);
    for (std::size_t i = 0; i < 3; ++i) {
        // Kurtosis at most that of t: 3 + 6 / (df - 4) bounds the spread of the products.
        for (std::size_t j = 0; j <= i; ++j) {
            const double scale = stretch * std::sqrt(covariance[i][i] * covariance[j][j]);
            expect_covariance(draws, i, j, mean[i], mean[j], stretch * covariance[i][j],
                              scale * std::sqrt(3 + 6 / (degrees - 4)));
        }
    }
}

TEST(Dirichlet, FitsItsLaw) {
    const Vector weights{0.3, 2.5, 7};
    const double total = 9.8;
    const auto draws = fit::draws_of([&](auto& context, Place at) {
        Vector draw;
        sample::dirichlet(context, at, 3, weights, draw);
        return draw;
    });
    for (const Vector& draw : draws) ASSERT_NEAR(draw[0] + draw[1] + draw[2], 1, 1e-15);
    for (std::size_t i = 0; i < 3; ++i) {
        const boost::math::beta_distribution<> law(weights[i], total - weights[i]);
        fit::expect_continuous_fit(element(draws, i), [&](double x) { return cdf(law, x); });
    }
    const double m = weights[1] / total;
    const double n = weights[2] / total;
    expect_covariance(draws, 1, 2, m, n, -m * n / (total + 1), 0.03);
}

TEST(Dirichlet, OfTinyWeightsIsNearlyOneElement) {
    Context<Scalar> context;
    const Vector weights{1e-5, 1e-5, 1e-5};
    Vector draw;
    sample::dirichlet(context, place, 3, weights, draw);
    EXPECT_EQ(draw[0] + draw[1] + draw[2], 1);
    EXPECT_FALSE(context.fault);
}

// The logarithms of all gamma draws are infinite.
TEST(Dirichlet, OfWeightsNearTheLeastDoubleIsOneElement) {
    const Vector weights{1e-316, 2e-316, 5e-316};
    Vector wins{};
    for (const Vector& draw : fit::draws_of([&](auto&context, Place at) {
             Vector drawn;
             sample::dirichlet(context, at, 3, weights, drawn);
             return drawn;
         })) {
        ASSERT_EQ(draw[0] + draw[1] + draw[2], 1);
        for (std::size_t i = 0; i < 3; ++i) wins[i] += draw[i];
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const double share = weights[i] / 8e-316;
        EXPECT_NEAR(wins[i], share * fit::draw_count,
                    5 * std::sqrt(fit::draw_count * share * (1 - share)));
    }
}

TEST(Multinomial, FitsItsLaw) {
    const std::array<double, 4> probabilities{0.1, 0.5, 0.15, 0.25};
    for (const std::int64_t trials : {std::int64_t{1}, std::int64_t{20}, std::int64_t{1000}}) {
        SCOPED_TRACE(trials);
        const auto draws = fit::draws_of([&](auto& context, Place at) {
            Counts draw;
            sample::multinomial(context, at, 4, trials, probabilities, draw);
            return draw;
        });
        const auto n = static_cast<double>(trials);
        for (const Counts& draw : draws) ASSERT_EQ(draw[0] + draw[1] + draw[2] + draw[3], trials);
        for (std::size_t i = 0; i < 4; ++i) {
            const boost::math::binomial law(n, probabilities[i]);
            fit::expect_count_fit(element(draws, i), [&](std::int64_t k) {
                return k < 0 ? 0.0 : k >= trials ? 1.0 : cdf(law, static_cast<double>(k));
            });
        }
        const double a = n * probabilities[1];
        const double b = n * probabilities[3];
        expect_covariance(draws, 1, 3, a, b, -a * b / n, n * 0.3);
    }
}

TEST(Multinomial, NeverCountsWhatIsImpossible) {
    const std::array<double, 4> probabilities{0.1, 0, 0.899995, 0};  // short of 1, but near enough
    for (const Counts& draw : fit::draws_of([&](auto&context, Place at) {
             Counts counts;
             sample::multinomial(context, at, 4, 50, probabilities, counts);
             return counts;
         })) {
        ASSERT_EQ(draw[1], 0);
        ASSERT_EQ(draw[3], 0);
        ASSERT_EQ(draw[0] + draw[2], 50);
    }
}

// The rest of the sum of probabilities is 0 before the last one that is not 0.
TEST(Multinomial, GivesToTheCertainWhereTheSumRounds) {
    Context<Scalar> context;
    Counts counts;
    sample::multinomial(context, place, 4, 5, std::array<double, 4>{1, 0, 0, 1e-17}, counts);
    EXPECT_EQ(counts, (Counts{5, 0, 0, 0}));
    sample::multinomial(context, place, 4, 5, std::array<double, 4>{1e-17, 0, 1, 1e-17}, counts);
    EXPECT_EQ(counts, (Counts{0, 0, 5, 0}));
    for (const Counts& draw : fit::draws_of([](auto&other, Place at) {
             Counts drawn;
             const std::array<double, 4> probabilities{0.5, 0.5, 0, 1e-17};
             sample::multinomial(other, at, 4, 50, probabilities, drawn);
             return drawn;
         })) {
        ASSERT_EQ(draw[0] + draw[1], 50);
        ASSERT_TRUE(draw[0] >= 0 && draw[1] >= 0 && draw[2] == 0 && draw[3] == 0);
    }
}

TEST(Multinomial, TakesARoundedZeroForZero) {
    Context<Scalar> context;
    for (const std::array<double, 3> probabilities :
         {std::array{-1e-17, 1.0, -1e-9}, std::array{-1e-9, 1.0 + 1e-9, -1e-17}}) {
        std::array<std::int64_t, 3> counts;
        sample::multinomial(context, place, 3, 1000, probabilities, counts);
        EXPECT_EQ(counts, (std::array<std::int64_t, 3>{0, 1000, 0}));
    }
    EXPECT_FALSE(context.fault);
}

template <class Draw>
void expect_fault(FaultKind kind, double value, Draw draw) {
    Context<Scalar> context;
    draw(context);
    EXPECT_EQ(context.fault.kind, kind);
    EXPECT_EQ(context.fault.place, place);
    EXPECT_EQ(context.fault.value, value);
}

TEST(VectorFaults, Covariance) {
    const Matrix factor = factor_of({{{1, 0, 0}, {2, 1, 0}, {0, 0, 1}}});
    Vector draw{9, 9, 9};
    expect_fault(FaultKind::Covariance, 0, [&](auto& context) {
        sample::multivariate_normal(context, place, 3, mean, factor, draw);
    });
    EXPECT_EQ(draw, Vector{});
    expect_fault(FaultKind::Covariance, 0, [&](auto& context) {
        sample::multivariate_student(context, place, 3, 2.0, mean, factor, draw);
    });
    expect_fault(FaultKind::DegreesOfFreedom, -1, [&](auto& context) {
        sample::multivariate_student(context, place, 3, -1.0, mean, factor_of(covariance), draw);
    });
}

TEST(VectorFaults, WeightsAndTrials) {
    Vector draw{9, 9, 9};
    expect_fault(FaultKind::PositiveWeight, 0, [&](auto& context) {
        sample::dirichlet(context, place, 3, Vector{1, 0, 2}, draw);
    });
    EXPECT_EQ(draw, Vector{});
    std::array<std::int64_t, 3> counts{9, 9, 9};
    const auto multinomial = [&](std::int64_t trials, const Vector& probabilities) {
        return [&counts, trials, probabilities](auto& context) {
            sample::multinomial(context, place, 3, trials, probabilities, counts);
        };
    };
    expect_fault(FaultKind::Trials, -1, multinomial(-1, {0.5, 0.25, 0.25}));
    expect_fault(FaultKind::Weight, -0.5, multinomial(1, {0.5, -0.5, 1}));
    expect_fault(FaultKind::Weight, -2e-9, multinomial(1, {0.5, -2e-9, 0.5}));
    expect_fault(FaultKind::ProbabilitySum, 1.25, multinomial(1, {0.5, 0.25, 0.5}));
    Context<Scalar> context;
    multinomial(3, {0.5, nan, 0.5})(context);
    EXPECT_EQ(context.fault.kind, FaultKind::Weight);
    EXPECT_EQ(counts, (std::array<std::int64_t, 3>{}));
}

TEST(Vectors, OfNoElementsAreFine) {
    Context<Scalar> context;
    Vector draw{};
    sample::multivariate_normal(context, place, 0, mean, covariance, draw);
    sample::dirichlet(context, place, 0, mean, draw);
    EXPECT_FALSE(context.fault);
}

}  // namespace
}  // namespace rddl
