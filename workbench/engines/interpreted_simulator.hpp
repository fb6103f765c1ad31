// The C interface of a program that the interpreter runs.
#pragma once

#include "engines/external_library.hpp"
#include "ir/details.hpp"
#include "ir/ir.hpp"
#include "support/source.hpp"

#include <rddl/simulator.h>

#include <memory>
#include <optional>

namespace rddlc::workbench {

// The pointer owns everything that the simulator refers to. Without the library, a program that
// calls external functions only describes itself.
std::shared_ptr<const rddl_simulator> interpreted_simulator(
    ir::Program program, Sources sources, ExternalLibrary library = {},
    std::optional<ir::Details> details = {});

}  // namespace rddlc::workbench
