// The tables that describe the simulator: rddl_problem and the sites, in namespace about.
#pragma once

#include "emit/unit.hpp"

#include <string>

namespace rddlc::cpp {

std::string about(const Unit& unit);

// The table of sites as an argument; it may be empty.
std::string sites_argument(const Unit& unit);

}  // namespace rddlc::cpp
