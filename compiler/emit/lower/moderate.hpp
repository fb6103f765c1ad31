// The step for moderate values (ir::Program::moderate): a namespace of its own inside that of the
// simulator.
#pragma once

#include "emit/lower/unit.hpp"

#include <string>

namespace rddlc::cpp {

// `around` is the unit of the simulator, whose tables need not be written again. Empty if its
// program has no such step.
std::string moderate_section(const Unit& around);

// The C++ types that step packs and one environment: the simulator, with that step if they take it.
std::string type_for_packs(const Unit& unit);
std::string type_for_one(const Unit& unit);

}  // namespace rddlc::cpp
