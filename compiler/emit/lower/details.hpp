// Emits the code that computes interm- and derived-fluents again on request
// (rddl/interface/details.hpp): a namespace of its own inside the simulator's.
#pragma once

#include "emit/lower/unit.hpp"
#include "ir/details.hpp"

#include <string>

namespace rddlc::cpp {

struct DetailsUnit {
    DetailsUnit(const ir::Details& of_problem, const Sources& sources, const EmitOptions& options);

    const ir::Details& details;
    Unit unit;  // of the program of the details
};

// `around` is the unit of the simulator, whose tables need not be written again.
std::string details_section(const DetailsUnit& details, const Unit& around);

}  // namespace rddlc::cpp
