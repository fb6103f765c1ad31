// Bounds of state- and action-fluents, read off invariants and preconditions (docs/ir.md).
//
//     forall_{?r : res} [release(?r) >= 0 ^ release(?r) <= CAPACITY(?r)]
//
// A condition contributes if, below any nest of forall and ^, it compares a plain reference to a
// numeric action-fluent (in a precondition) or state-fluent (in an invariant) with a value that
// the instance fixes. All else contributes nothing.
#pragma once

#include "ground/declare.hpp"
#include "ir/ir.hpp"
#include "model/model.hpp"
#include "support/diagnostic.hpp"

#include <vector>

namespace rddlc::grounding {

// Fills Fluent::lower and upper. Contradictions are errors (E0602).
void find_bounds(const model::Model& model, const std::vector<FluentBuffers>& buffers,
                 ir::Program& program, Diagnostics& diagnostics);

}  // namespace rddlc::grounding
