// External functions: what the emitted file asks of them, and the file that exports them to the
// interpreter.
#pragma once

#include "emit/lower/unit.hpp"
#include "ir/ir.hpp"

#include <string>
#include <vector>

namespace rddlc::cpp {

// The #includes of the user's headers and of the headers that calls need; nothing if the program
// calls no external function.
std::string external_includes(const ir::Program& program, const std::vector<std::string>& headers);

// Assertions that each function can be called as the program calls it.
std::string external_asserts(const Unit& unit);

}  // namespace rddlc::cpp
