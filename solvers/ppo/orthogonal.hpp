// First weights of networks: matrices whose rows or columns are orthogonal.
#pragma once

#include <functional>
#include <vector>

namespace rddlc::solvers {

// Orthogonal rows of length `gain`, of which there are at most `columns`, one behind the other.
// Every direction is equally likely (F. Mezzadri, "How to generate random matrices from the
// classical compact groups", 2007): Q of the QR decomposition, by Householder's reflections, of the
// matrix whose columns are such rows of numbers of `normal`, with R's diagonal positive. Nothing of
// use where `stops` says so.
std::vector<double> orthogonal_rows(int rows, int columns, double gain,
                                    const std::function<double()>& normal,
                                    const std::function<bool()>& stops);

}  // namespace rddlc::solvers
