// Model -> IR: objects become integers, non-fluents constant tables, CPFs loops around stores.
// Expressions are not copied for each grounding, so the IR does not grow with the objects.
#pragma once

#include "ir/ir.hpp"
#include "model/model.hpp"
#include "support/diagnostic.hpp"
#include "support/memory.hpp"

#include <optional>

namespace rddlc {

// Nothing if the model uses what is not supported yet (E0601) or has errors that only its values
// show (E0602, E0603), or takes more bytes than it may (E0604).
//
// Beside the program for any values there is one for moderate ones (ir::Program::moderate), unless
// no reals come from outside, or there is a policy block.
std::optional<ir::Program> ground(const model::Model& model, Diagnostics& diagnostics,
                                  std::int64_t memory_limit = default_memory_limit);

}  // namespace rddlc
