// The tables that describe the simulator: rddl_problem and the sites, in namespace about.
#pragma once

#include "emit/lower/details.hpp"
#include "emit/lower/unit.hpp"

#include <string>

namespace rddlc::cpp {

// `details` may be null.
std::string about(const Unit& unit, const DetailsUnit* details);

// The variable `table`, made of all that; indented by one level.
std::string table_definition(const Unit& unit, bool has_details);

}  // namespace rddlc::cpp
