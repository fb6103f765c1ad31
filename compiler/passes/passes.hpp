// The optimisations. Each keeps the value of every fluent bit for bit.
#pragma once

#include "ir/ir.hpp"

namespace rddlc {

// All of them, in the order that passes.cpp lists.
ir::Program optimise(ir::Program program);

}  // namespace rddlc
