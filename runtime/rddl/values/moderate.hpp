// Moderate numbers: products of four of them, and sums of those, are finite, in floats as well. For
// them `0 * x` is 0, so a step of moderate values may leave out terms that another step must add.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/values/ops.hpp>

#include <array>
#include <cstddef>

namespace rddl {

// The greatest magnitude of a moderate number.
inline constexpr double moderate = 0x1p30;

// Whether a real of a record is moderate; nan is not.
template <class L>
typename L::Bool is_moderate(const typename L::Real& value) {
    return absolute(value) <= typename L::Real(moderate);
}

// Whether all elements of a table are.
template <class L, class Element, std::size_t n>
typename L::Bool is_moderate(const std::array<Element, n>& table) {
    typename L::Bool result{true};
    for (const Element& element : table) result = result && is_moderate<L>(element);
    return result;
}

}  // namespace rddl
