// The text form of a program: stable, readable, for golden files and --print=ir.
//
//     next.running[c] = select(action.reboot[c], true, sample bernoulli@3[c](p))
//
// Constants are bare names, other buffers have their storage before the dot. "@3[c]" is the place
// of a draw or a possible fault: site 3, index c.
#pragma once

#include "ir/ir.hpp"

#include <string>

namespace rddlc::ir {

std::string print(const Program& program);

// One expression.
std::string print(const Program& program, NodeId id);

}  // namespace rddlc::ir
