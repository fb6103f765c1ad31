// Tables of a step that hold the values of an expression.
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <vector>

namespace rddlc::ir {

// Adds to `block` the loops that store the value in the table for all objects of these variables,
// which are the table's dimensions. Without any variable that is one store. Returns the element
// for the variables.
NodeId fill_table(Builder& builder, Block& block, BufferId table,
                  const std::vector<VariableId>& variables, NodeId value);

}  // namespace rddlc::ir
