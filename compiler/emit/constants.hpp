// What the instance fixes, as emitted code tells it (rddl/interface/constants.hpp).
#pragma once

#include "emit/unit.hpp"

#include <cstddef>
#include <string>

namespace rddlc::cpp {

struct ConstantText {
    std::string tables;  // definitions that the value needs
    std::string value;   // "rddl::constant(4, -1.2)"
};

// The values of a non-fluent. Names of tables are claimed in `scope`.
ConstantText constants_of(const Unit& unit, std::size_t fluent, Scope& scope);

}  // namespace rddlc::cpp
