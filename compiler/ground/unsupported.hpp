// What is valid RDDL but has no IR yet: external functions.
#pragma once

#include "model/model.hpp"
#include "support/diagnostic.hpp"

namespace rddlc::grounding {

// Reports every use (E0601).
void report_unsupported(const model::Model& model, Diagnostics& diagnostics);

}  // namespace rddlc::grounding
