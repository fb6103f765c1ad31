// The intermediate values of a step, as a program of its own, for callers that ask about the last
// step (rddl/interface/details.hpp).
#pragma once

#include "ir/ir.hpp"

#include <cstddef>
#include <vector>

namespace rddlc::ir {

// The objects for which a precondition holds: those of the `forall`s that it begins with.
struct ConditionTable {
    BufferId holds;  // Observation, Bool, over the objects of `scope`
    std::vector<VariableId> scope;
};

// The step of the program computes nothing but Observation buffers: the interm- and derived-fluents
// in declaration order, where Fluent::buffer finds them, and behind them a table for each
// precondition. It reads State and Action buffers like the program that it comes from, and makes no
// next states.
struct Details {
    Program program;
    std::vector<ConditionTable> preconditions;
};

// The bytes of a record that hold fluents.
std::size_t interm_size(const Details& details);

}  // namespace rddlc::ir
