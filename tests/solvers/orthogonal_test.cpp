// First weights: orthogonal, and of all such matrices equally likely.
#include "solvers/ppo/orthogonal.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

namespace rddlc::solvers {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Matrix random_rows(int rows, int columns, double gain, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto numbers = orthogonal_rows(
        rows, columns, gain, [&] { return normal(random); }, nullptr);
    return Eigen::Map<const Matrix>(numbers.data(), rows, columns);
}

TEST(OrthogonalRows, AreOrthogonalAndOfTheirLength) {
    for (const auto& [rows, columns] : {std::pair{1, 1}, {1, 9}, {5, 5}, {7, 30}, {64, 64}}) {
        const Matrix q = random_rows(rows, columns, 1.5, 1);
        const Matrix expected = 2.25 * Matrix::Identity(rows, rows);
        EXPECT_LT((q * q.transpose() - expected).cwiseAbs().maxCoeff(), 1e-13) << rows;
    }
}

// The first of Gram and Schmidt's steps leaves the first row's direction, not its opposite.
TEST(OrthogonalRows, BeginWithTheDirectionThatWasDrawn) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    Eigen::RowVectorXd drawn(6);
    for (double& number : drawn) number = normal(random);
    const Matrix q = random_rows(3, 6, 1, 2);
    EXPECT_LT((q.row(0) - drawn.normalized()).cwiseAbs().maxCoeff(), 1e-15);
}

// Reflections alone would make signs of the diagonal known in advance.
TEST(OrthogonalRows, HaveAnySigns) {
    constexpr int draws = 400, size = 4;
    Eigen::Array<int, size, size> positive = Eigen::Array<int, size, size>::Zero();
    for (unsigned seed = 0; seed < draws; ++seed)
        positive += (random_rows(size, size, 1, seed).array() > 0).cast<int>();
    // Half of them, by five standard deviations.
    EXPECT_GT(positive.minCoeff(), draws / 2 - 50) << positive;
    EXPECT_LT(positive.maxCoeff(), draws / 2 + 50) << positive;
}

TEST(OrthogonalRows, AreLeftUnfinishedWhenStopped) {
    int asked = 0, drawn = 0;
    const auto rows = orthogonal_rows(
        100, 100, 1, [&] { return 1.0 + ++drawn; }, [&] { return ++asked > 3; });
    EXPECT_EQ(drawn, 300);
    EXPECT_EQ(rows.size(), 10000u);
}

}  // namespace
}  // namespace rddlc::solvers
