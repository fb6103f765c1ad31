#include "solvers/ppo/orthogonal.hpp"

#include <Eigen/Core>
#include <Eigen/Householder>
#include <cstddef>

namespace rddlc::solvers {

// One reflection after the other and not Eigen's HouseholderQR: that takes several at once, in
// blocks that depend on the processor's caches, as would the last digits; and it cannot be stopped.
std::vector<double> orthogonal_rows(int rows, int columns, double gain,
                                    const std::function<double()>& normal,
                                    const std::function<bool()>& stops) {
    std::vector<double> result(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    Eigen::MatrixXd reflected(columns, rows);  // below its diagonal, then, the reflections
    Eigen::VectorXd factors(rows), room(rows), diagonal(rows);
    for (int k = 0; k < rows; ++k) {
        if (stops && stops()) return result;
        for (int c = 0; c < columns; ++c) reflected(c, k) = normal();
    }
    for (int k = 0; k < rows; ++k) {
        if (stops && stops()) return result;
        const int size = columns - k, others = rows - k - 1;
        reflected.col(k).tail(size).makeHouseholderInPlace(factors[k], diagonal[k]);
        reflected.bottomRightCorner(size, others)
            .applyHouseholderOnTheLeft(reflected.col(k).tail(size - 1), factors[k], room.data());
    }
    using RowsOfResult = Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>;
    RowsOfResult q_transposed(result.data(), rows, columns);
    auto q = q_transposed.transpose();
    q.setIdentity();
    for (int k = rows - 1; k >= 0; --k) {
        if (stops && stops()) return result;
        const int size = columns - k;
        q.bottomRightCorner(size, rows - k)
            .applyHouseholderOnTheLeft(reflected.col(k).tail(size - 1), factors[k], room.data());
    }
    for (int k = 0; k < rows; ++k) q_transposed.row(k) *= diagonal[k] < 0 ? -gain : gain;
    return result;
}

}  // namespace rddlc::solvers
