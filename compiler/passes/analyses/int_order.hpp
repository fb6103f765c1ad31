// Comparisons of ints with constants: which of them implies which.
#pragma once

#include "ir/ir.hpp"

namespace rddlc::passes {

// Whether both compare the same int with a constant, and the second holds wherever the first does:
// x < 2 implies x <= 3.
bool implies(const ir::Program& program, ir::NodeId first, ir::NodeId second);

}  // namespace rddlc::passes
