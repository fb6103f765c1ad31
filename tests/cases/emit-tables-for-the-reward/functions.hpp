#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace rddl_extern {

template <class T, std::size_t rows, std::size_t columns>
double trace(std::span<const std::array<T, columns>, rows> table) {
    double sum = 0;
    for (std::size_t k = 0; k < rows; ++k) sum += table[k][k];
    return sum;
}

}  // namespace rddl_extern
