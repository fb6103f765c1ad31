// The step for moderate values (ir::Program::moderate): a namespace of its own inside that of the
// simulator.
#pragma once

#include "emit/lower/unit.hpp"

#include <string>

namespace rddlc::cpp {

// `around` is the unit of the simulator, whose tables need not be written again. Empty if its
// program has no such step.
std::string moderate_section(const Unit& around);

// The C++ type that steps: the simulator, with that step if there is one.
std::string stepping_type(const Unit& unit);

}  // namespace rddlc::cpp
