// What the compiler computes for the simulator, with the evaluator that would run it.
#pragma once

#include "ir/evaluator.hpp"
#include "ir/ir.hpp"

#include <optional>
#include <vector>

namespace rddlc::passes {

// The values of an expression that depends on constants and these variables only, row-major, the
// first variable outermost. None if it faults for any of them.
std::optional<std::vector<ir::Value>> constant_values(const ir::Evaluator& evaluator,
                                                      const ir::Program& program, ir::NodeId id,
                                                      const std::vector<ir::VariableId>& variables);

}  // namespace rddlc::passes
