// Emits all that the instance fixes (rddl/interface/constants.hpp).
#pragma once

#include "emit/cpp/tree.hpp"
#include "emit/lower/unit.hpp"

#include <cstddef>

namespace rddlc::cpp {

// "rddl::constant(4, -1.2)": the values of a non-fluent. Names of tables that it needs are claimed
// in `scope`, and they are added to `tables`.
tree::Expression constants_of(const Unit& unit, std::size_t fluent, Scope& scope,
                              tree::Block& tables);

}  // namespace rddlc::cpp
