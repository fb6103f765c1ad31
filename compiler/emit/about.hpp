// The tables that describe the simulator: rddl_problem and the sites, in namespace about.
#pragma once

#include "emit/unit.hpp"

#include <string>

namespace rddlc::cpp {

std::string about(const Unit& unit);

// The variable `table`, made of description, sites, engine and policy; indented by one level.
std::string table_definition(const Unit& unit);

}  // namespace rddlc::cpp
