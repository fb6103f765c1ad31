// Run-time faults as text.
#pragma once

#include "solvers/batches/batch.hpp"

#include <rddl/simulator.h>

#include <string>

namespace rddlc::workbench {

using solvers::fault_text;

// "file:line:column"
std::string source_text(const rddl_source& source);

}  // namespace rddlc::workbench
