// Matrix functions: known answers, and the equations that define them.
#include <rddl/values/linear_algebra.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace rddl {
namespace {

template <std::size_t n>
using Matrix = std::array<std::array<double, n>, n>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

template <std::size_t n>
Matrix<n> product(const Matrix<n>& a, const Matrix<n>& b) {
    Matrix<n> result{};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t k = 0; k < n; ++k) result[i][j] += a[i][k] * b[k][j];
    return result;
}

template <std::size_t n>
Matrix<n> transposed(const Matrix<n>& a) {
    Matrix<n> result;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) result[i][j] = a[j][i];
    return result;
}

template <std::size_t n>
Matrix<n> identity() {
    Matrix<n> result{};
    for (std::size_t i = 0; i < n; ++i) result[i][i] = 1;
    return result;
}

template <std::size_t n>
void expect_near(const Matrix<n>& a, const Matrix<n>& b, double tolerance) {
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            EXPECT_NEAR(a[i][j], b[i][j], tolerance) << i << ", " << j;
}

template <std::size_t n>
void expect_nan(const Matrix<n>& matrix) {
    for (const auto& row : matrix)
        for (const double element : row) EXPECT_TRUE(std::isnan(element));
}

template <std::size_t n>
Matrix<n> random_matrix(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Matrix<n> matrix;
    for (auto& row : matrix)
        for (double& element : row) element = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
    return matrix;
}

template <std::size_t n>
double determinant_of(Matrix<n> matrix) {
    double result = nan;
    determinant(n, matrix, result);
    return result;
}

template <std::size_t n>
Matrix<n> inverse_of(Matrix<n> matrix) {
    Matrix<n> result;
    inverse(n, matrix, result);
    return result;
}

template <std::size_t n>
Matrix<n> pseudo_inverse_of(Matrix<n> matrix) {
    Matrix<n> rotation, result;
    pseudo_inverse(n, matrix, rotation, result);
    return result;
}

template <std::size_t n>
Matrix<n> cholesky_of(const Matrix<n>& matrix) {
    Matrix<n> factor;
    cholesky(n, matrix, factor);
    return factor;
}

TEST(Determinant, OfKnownMatrices) {
    EXPECT_EQ(determinant_of<1>({{{-3}}}), -3);
    EXPECT_EQ(determinant_of<2>({{{1, 2}, {3, 4}}}), -2);
    EXPECT_EQ(determinant_of<2>({{{0, 1}, {1, 0}}}), -1);
    EXPECT_NEAR(determinant_of<3>({{{2, -1, 0}, {-1, 2, -1}, {0, -1, 2}}}), 4, 1e-15);
    EXPECT_EQ(determinant_of<3>({{{1, 2, 3}, {2, 4, 6}, {1, 0, 1}}}), 0);
    EXPECT_FALSE(std::signbit(determinant_of<2>({{{-1, -1}, {-1, -1}}})));
    EXPECT_TRUE(std::isnan(determinant_of<2>({{{nan, 1}, {1, 1}}})));
    std::array<std::array<double, 1>, 1> unused{};
    double empty = nan;
    determinant(0, unused, empty);
    EXPECT_EQ(empty, 1);
}

TEST(Determinant, OfAProductIsTheProduct) {
    const auto a = random_matrix<6>(1);
    const auto b = random_matrix<6>(2);
    EXPECT_NEAR(determinant_of(product(a, b)), determinant_of(a) * determinant_of(b), 1e-13);
}

TEST(Inverse, OfKnownMatrices) {
    expect_near(inverse_of<2>({{{1, 2}, {3, 4}}}), {{{-2, 1}, {1.5, -0.5}}}, 1e-15);
    expect_near(inverse_of<3>({{{0, 0, 2}, {4, 0, 0}, {0, 8, 0}}}),
                {{{0, 0.25, 0}, {0, 0, 0.125}, {0.5, 0, 0}}}, 0);
}

TEST(Inverse, TimesTheMatrixIsOne) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto matrix = random_matrix<8>(seed);
        expect_near(product(matrix, inverse_of(matrix)), identity<8>(), 1e-12);
        expect_near(product(inverse_of(matrix), matrix), identity<8>(), 1e-12);
    }
}

TEST(Inverse, OfASingularMatrixIsNan) {
    expect_nan(inverse_of<1>({{{0}}}));
    expect_nan(inverse_of<2>({{{1, 2}, {2, 4}}}));
    expect_nan(inverse_of<3>({{{0, 1, 1}, {0, 2, 1}, {0, 3, 1}}}));
}

TEST(Cholesky, OfKnownMatrices) {
    expect_near(cholesky_of<2>({{{4, 2}, {2, 10}}}), {{{2, 0}, {1, 3}}}, 0);
    expect_near(cholesky_of<3>({{{4, 12, -16}, {12, 37, -43}, {-16, -43, 98}}}),
                {{{2, 0, 0}, {6, 1, 0}, {-8, 5, 3}}}, 0);
}

TEST(Cholesky, ReadsTheLowerTriangleOnly) {
    expect_near(cholesky_of<2>({{{4, nan}, {2, 10}}}), {{{2, 0}, {1, 3}}}, 0);
}

TEST(Cholesky, TimesItsTransposeIsTheMatrix) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto root = random_matrix<7>(seed);
        const auto matrix = product(root, transposed(root));
        const auto factor = cholesky_of(matrix);
        expect_near(product(factor, transposed(factor)), matrix, 1e-14);
    }
}

TEST(Cholesky, OfWhatIsNotPositiveDefiniteIsNan) {
    expect_nan(cholesky_of<2>({{{1, 2}, {2, 1}}}));
    expect_nan(cholesky_of<2>({{{1, 1}, {1, 1}}}));
    expect_nan(cholesky_of<2>({{{1, 0}, {nan, 1}}}));
    expect_nan(cholesky_of<1>({{{-1}}}));
}

// Moore and Penrose's four equations.
template <std::size_t n>
void expect_pseudo_inverse(const Matrix<n>& a, double tolerance) {
    const Matrix<n> x = pseudo_inverse_of(a);
    expect_near(product(product(a, x), a), a, tolerance);
    expect_near(product(product(x, a), x), x, tolerance);
    expect_near(product(a, x), transposed(product(a, x)), tolerance);
    expect_near(product(x, a), transposed(product(x, a)), tolerance);
}

TEST(PseudoInverse, SatisfiesItsEquations) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        auto matrix = random_matrix<6>(seed);
        expect_pseudo_inverse(matrix, 1e-11);
        matrix[4] = matrix[1];  // rank 5
        expect_pseudo_inverse(matrix, 1e-11);
        for (auto& row : matrix) row[2] = row[0] - row[3];  // rank 4
        expect_pseudo_inverse(matrix, 1e-11);
    }
}

TEST(PseudoInverse, OfKnownMatrices) {
    expect_near(pseudo_inverse_of<2>({{{1, 2}, {2, 4}}}), {{{0.04, 0.08}, {0.08, 0.16}}}, 1e-16);
    expect_near(pseudo_inverse_of<2>({{{0, 0}, {0, 0}}}), {}, 0);
    expect_near(pseudo_inverse_of<2>({{{0, 3}, {0, 0}}}), {{{0, 0}, {1.0 / 3, 0}}}, 1e-16);
    const auto matrix = random_matrix<5>(3);
    expect_near(pseudo_inverse_of(matrix), inverse_of(matrix), 1e-11);
}

TEST(PseudoInverse, OfExtremeElements) {
    expect_near(pseudo_inverse_of<2>({{{1e200, 0}, {0, 2e200}}}), {{{1e-200, 0}, {0, 5e-201}}},
                1e-215);
    expect_near(pseudo_inverse_of<2>({{{1e-200, 0}, {0, 2e-200}}}), {{{1e200, 0}, {0, 5e199}}},
                1e185);
    expect_nan(pseudo_inverse_of<2>({{{1, nan}, {0, 1}}}));
    expect_nan(pseudo_inverse_of<2>({{{1, infinity}, {0, 1}}}));
}

TEST(LinearAlgebra, IsTheSameOnViews) {
    auto nested = random_matrix<5>(4);
    auto flat = nested;
    Matrix<5> result, flat_result;
    inverse(5, nested, result);
    MatrixView view{flat[0].data(), 5}, result_view{flat_result[0].data(), 5};
    inverse(5, view, result_view);
    EXPECT_EQ(result, flat_result);
}

TEST(Defined, FaultsOnNan) {
    Context<Scalar> context;
    EXPECT_EQ(defined(context, {3, 1}, infinity), infinity);
    EXPECT_FALSE(context.fault);
    EXPECT_EQ(defined(context, {3, 1}, nan), 0.0);
    EXPECT_EQ(context.fault.kind, FaultKind::Undefined);
    EXPECT_EQ(context.fault.place, (Place{3, 1}));
}

}  // namespace
}  // namespace rddl
