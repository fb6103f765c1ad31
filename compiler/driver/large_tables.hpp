// The limits of an emitted file.
#pragma once

#include "ir/ir.hpp"
#include "support/diagnostic.hpp"

namespace rddlc {

// Reports the constant tables that are too large to be written out: `emit` must not see them.
void report_large_constant_tables(const ir::Program& program, Diagnostics& diagnostics);

}  // namespace rddlc
