// Tables that passes add.
#pragma once

#include "ir/ir.hpp"

#include <string>
#include <vector>

namespace rddlc::passes {

// The name, or the name with the first number that no buffer has.
std::string unused_name(const ir::Program& program, const std::string& wish);

// Gives a table a dimension for each of these loop indices, in this order.
void set_dimensions(const ir::Program& program, ir::Buffer& table,
                    const std::vector<ir::VariableId>& variables);

// A table that the step fills with the values of an expression, with a dimension for each of these
// loop indices, named as it wishes if nobody else is.
ir::BufferId scratch_table(ir::Program& program, const std::string& wish, ir::Scalar scalar,
                           bool finite, const std::vector<ir::VariableId>& variables, Span span);

// A constant table like this one, if there is one already; else a new one, named as it wishes if
// nobody else is.
ir::BufferId constant_table(ir::Program& program, ir::Buffer table);

}  // namespace rddlc::passes
