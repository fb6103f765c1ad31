// Functions of square matrices, for any n.
//
// A matrix is anything with elements [i][j]: a nested array in emitted code, a MatrixView where the
// size is known only at run time. Nothing is allocated: what needs room works in its argument. The
// order of the operations is fixed, so equal matrices give equal results bit for bit.
//
// A matrix without a result gives nan everywhere; defined() makes its use a fault.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/ops.hpp>

#include <limits>
#include <utility>

namespace rddl {

// Rows of `columns` doubles behind each other.
struct MatrixView {
    double* first;
    Index columns;

    constexpr double* operator[](Index row) const { return first + row * columns; }
};

// Passes a value on, having recorded a fault where it is nan: what has no value.
template <class L>
constexpr typename L::Real defined(Context<L>& context, Place place, typename L::Real value) {
    const auto exists = value == value;
    context.require(exists, FaultKind::Undefined, place, 0.0);
    return select(exists, value, typename L::Real{0});
}

namespace detail {

template <class Matrix>
constexpr void fill_matrix(Index n, Matrix& matrix, double value) {
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) matrix[i][j] = value;
}

template <class Matrix>
constexpr void fill_with_nan(Index n, Matrix& matrix) {
    fill_matrix(n, matrix, std::numeric_limits<double>::quiet_NaN());
}

template <class Matrix>
constexpr void set_to_identity(Index n, Matrix& matrix) {
    fill_matrix(n, matrix, 0.0);
    for (Index i = 0; i < n; ++i) matrix[i][i] = 1.0;
}

template <class Matrix>
constexpr void swap_rows(Index n, Matrix& matrix, Index a, Index b) {
    for (Index j = 0; j < n; ++j) std::swap(matrix[a][j], matrix[b][j]);
}

// The row from k on with the greatest element in column k: partial pivoting.
template <class Matrix>
constexpr Index pivot_row(Index n, const Matrix& matrix, Index k) {
    Index best = k;
    for (Index i = k + 1; i < n; ++i)
        if (absolute(matrix[i][k]) > absolute(matrix[best][k])) best = i;
    return best;
}

// matrix[row] -= factor * matrix[pivot], from a column on.
template <class Matrix>
constexpr void subtract_row(Index n, Matrix& matrix, Index row, Index pivot, double factor,
                            Index from) {
    for (Index j = from; j < n; ++j) matrix[row][j] = matrix[row][j] - factor * matrix[pivot][j];
}

}  // namespace detail

// The lower triangle L with L L^T = A, row by row. Reads the lower triangle of A only. Nan unless A
// is positive definite.
// G. Golub, C. Van Loan, "Matrix computations", 4th edition (2013), section 4.2.
template <class Matrix, class Factor>
void cholesky(Index n, const Matrix& matrix, Factor& factor) {
    detail::fill_matrix(n, factor, 0.0);
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j <= i; ++j) {
            double rest = matrix[i][j];
            for (Index k = 0; k < j; ++k) rest = rest - factor[i][k] * factor[j][k];
            if (j < i) {
                factor[i][j] = rest / factor[j][j];
            } else if (rest > 0.0) {
                factor[i][i] = sqrt(rest);
            } else {
                return detail::fill_with_nan(n, factor);
            }
        }
    }
}

// The determinant by elimination with partial pivoting; overwrites the matrix. 0 if singular. Golub
// and Van Loan, section 3.4.
template <class Matrix, class Real>
void determinant(Index n, Matrix& matrix, Real& result) {
    result = 1.0;
    for (Index k = 0; k < n; ++k) {
        const Index pivot = detail::pivot_row(n, matrix, k);
        if (pivot != k) {
            detail::swap_rows(n, matrix, k, pivot);
            result = -result;
        }
        if (matrix[k][k] == 0.0) {
            result = 0.0;
            return;
        }
        result = result * matrix[k][k];
        for (Index i = k + 1; i < n; ++i)
            detail::subtract_row(n, matrix, i, k, matrix[i][k] / matrix[k][k], k + 1);
    }
}

// Solves A X = 1 by elimination with partial pivoting; overwrites the matrix. Nan if singular.
// Golub and Van Loan, section 3.4.
template <class Matrix, class Result>
void inverse(Index n, Matrix& matrix, Result& result) {
    detail::set_to_identity(n, result);
    for (Index k = 0; k < n; ++k) {
        const Index pivot = detail::pivot_row(n, matrix, k);
        if (pivot != k) {
            detail::swap_rows(n, matrix, k, pivot);
            detail::swap_rows(n, result, k, pivot);
        }
        if (matrix[k][k] == 0.0) return detail::fill_with_nan(n, result);
        for (Index i = k + 1; i < n; ++i) {
            const double factor = matrix[i][k] / matrix[k][k];
            detail::subtract_row(n, matrix, i, k, factor, k + 1);
            detail::subtract_row(n, result, i, k, factor, 0);
        }
    }
    for (Index k = n - 1; k >= 0; --k) {
        for (Index i = k + 1; i < n; ++i) detail::subtract_row(n, result, k, i, matrix[k][i], 0);
        for (Index j = 0; j < n; ++j) result[k][j] = result[k][j] / matrix[k][k];
    }
}

namespace detail {

template <class Matrix>
constexpr double greatest_magnitude(Index n, const Matrix& matrix) {
    double greatest = 0.0;
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) greatest = maximum(greatest, absolute(matrix[i][j]));
    return greatest;
}

template <class Matrix>
constexpr double column_product(Index n, const Matrix& matrix, Index p, Index q) {
    double total = 0.0;
    for (Index i = 0; i < n; ++i) total = total + matrix[i][p] * matrix[i][q];
    return total;
}

template <class Matrix>
constexpr void rotate_columns(Index n, Matrix& matrix, Index p, Index q, double cosine,
                              double sine) {
    for (Index i = 0; i < n; ++i) {
        const double a = matrix[i][p];
        const double b = matrix[i][q];
        matrix[i][p] = cosine * a - sine * b;
        matrix[i][q] = sine * a + cosine * b;
    }
}

// Rotates columns p and q to be orthogonal; false if they are.
template <class Matrix, class Rotation>
bool orthogonalise(Index n, Matrix& matrix, Rotation& rotation, Index p, Index q) {
    const double pp = column_product(n, matrix, p, p);
    const double qq = column_product(n, matrix, q, q);
    const double pq = column_product(n, matrix, p, q);
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    if (absolute(pq) <= epsilon * sqrt(pp) * sqrt(qq)) return false;
    const double zeta = (qq - pp) / (2.0 * pq);
    const double size = 1.0 / (absolute(zeta) + sqrt(1.0 + zeta * zeta));
    const double tangent = zeta < 0.0 ? -size : size;
    const double cosine = 1.0 / sqrt(1.0 + tangent * tangent);
    rotate_columns(n, matrix, p, q, cosine, cosine * tangent);
    rotate_columns(n, rotation, p, q, cosine, cosine * tangent);
    return true;
}

// Rotates until all columns of the matrix are orthogonal: A V = U S. A handful of sweeps is usual.
template <class Matrix, class Rotation>
void orthogonalise_columns(Index n, Matrix& matrix, Rotation& rotation) {
    constexpr int sweep_limit = 60;
    set_to_identity(n, rotation);
    bool rotated = true;
    for (int sweep = 0; rotated && sweep < sweep_limit; ++sweep) {
        rotated = false;
        for (Index p = 0; p < n; ++p)
            for (Index q = p + 1; q < n; ++q)
                rotated = orthogonalise(n, matrix, rotation, p, q) || rotated;
    }
}

}  // namespace detail

// Moore and Penrose's inverse by one-sided Jacobi rotations; overwrites the matrix, and uses
// `rotation` as room. Singular values below 1e-15 (as numpy) or n roundings of the greatest count
// as 0. Nan if an element is nan or infinite. J. Demmel, K. Veselic, "Jacobi's method is more
// accurate than QR", SIAM Journal on Matrix Analysis and Applications 13 (1992), 1204-1245:
// section 4.
template <class Matrix, class Rotation, class Result>
void pseudo_inverse(Index n, Matrix& matrix, Rotation& rotation, Result& result) {
    const double scale = detail::greatest_magnitude(n, matrix);
    if (!(scale <= std::numeric_limits<double>::max())) return detail::fill_with_nan(n, result);
    detail::fill_matrix(n, result, 0.0);
    if (scale == 0.0) return;
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) matrix[i][j] = matrix[i][j] / scale;

    detail::orthogonalise_columns(n, matrix, rotation);
    double greatest = 0.0;
    for (Index k = 0; k < n; ++k)
        greatest = maximum(greatest, sqrt(detail::column_product(n, matrix, k, k)));
    const double negligible =
        greatest * maximum(1e-15, to_real(n) * std::numeric_limits<double>::epsilon());
    for (Index k = 0; k < n; ++k) {
        const double singular = sqrt(detail::column_product(n, matrix, k, k));
        if (singular <= negligible) continue;
        for (Index i = 0; i < n; ++i)
            for (Index j = 0; j < n; ++j)
                result[i][j] =
                    result[i][j] + rotation[i][k] / singular * (matrix[j][k] / singular) / scale;
    }
}

}  // namespace rddl
