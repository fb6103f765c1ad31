// Visits of the same objects, one after the other.
#pragma once

#include "ir/ir.hpp"

namespace rddlc::ir {

// Whether two visits that follow each other have the same objects and entries and, where one object
// alone is true, may take turns: for each entry first the marks of the one and then of the other.
bool may_take_turns(const Program& program, const Visit& first, const Visit& second);

}  // namespace rddlc::ir
