// Checks the invariants that ir.hpp states: of a correct compiler, always an empty list.
#pragma once

#include "ir/ir.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rddlc::ir {

// One sentence a complaint.
std::vector<std::string> verify(const Program& program);

// Stops the process with the complaints, if there are any. For debug builds, between stages.
void expect_valid(const Program& program, std::string_view stage);

}  // namespace rddlc::ir
