// Values that the compiler computes for the simulator, with the evaluator that would run it.
#pragma once

#include "ir/evaluator.hpp"
#include "ir/ir.hpp"

#include <optional>
#include <vector>

namespace rddlc::passes {

// A value for a local that no statement defines.
struct Assumed {
    ir::LocalId local;
    ir::Value value;
};

// The values of an expression that depends only on constants, these variables and the assumptions,
// row-major, the first variable outermost. Nothing if it faults for any of them.
std::optional<std::vector<ir::Value>> constant_values(const ir::Evaluator& evaluator,
                                                      const ir::Program& program, ir::NodeId id,
                                                      const std::vector<ir::VariableId>& variables,
                                                      const std::optional<Assumed>& assumed = {});

}  // namespace rddlc::passes
