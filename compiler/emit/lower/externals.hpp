// External functions: what the emitted file asks of them, and the file that exports them to the
// interpreter.
#pragma once

#include "emit/lower/unit.hpp"
#include "ir/ir.hpp"

#include <string>
#include <vector>

namespace rddlc::cpp {

// #include of the user's headers and of what calls need; nothing if the program calls none.
std::string external_includes(const ir::Program& program, const std::vector<std::string>& headers);

// That each function can be called as the program does.
std::string external_asserts(const Unit& unit);

}  // namespace rddlc::cpp
