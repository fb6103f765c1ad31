// Draws and operators that fault whenever they are evaluated, such as Bernoulli(1.5).
#pragma once

#include "ir/builder.hpp"
#include "support/diagnostic.hpp"

namespace rddlc::grounding {

// Warns of expressions in the program whose parameters the instance fixes, and which fault for
// every object in scope. It is unknown whether a run ever gets there, so they are not errors.
void warn_of_certain_faults(const ir::Builder& builder, Diagnostics& diagnostics);

}  // namespace rddlc::grounding
