// External functions for the interpreter, from a shared object (rddl/external.h).
#pragma once

#include "ir/ir.hpp"

#include <rddl/external.h>

#include <cstddef>
#include <vector>

namespace rddlc::ir {

using ExternalFunctions = std::vector<rddl_external_function>;  // by ExternalId::index

// The part of a table that a call passes on, which begins at `data`.
rddl_array array_of(const Program& program, const TableView& view, std::byte* data);

// Does the function take what the call passes?
bool accepts(rddl_external_function function, const Program& program, const Call& call);

}  // namespace rddlc::ir
