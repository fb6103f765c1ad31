// How emitted code reads the bools of actions.
#pragma once

#include "ir/ir.hpp"

namespace rddlc::ir {

// Whether it is a table of an action's bools.
bool is_action_bools(const Buffer& buffer);

// Whether one environment tests a byte of its action where the step reads it. Any byte but 0 is
// true, so the other way is to test all bytes before the step, which is faster for few bools and
// reads what no step needs of many. Tables are then read by elements and words alone: what reads
// them whole, or by indices of each object's own, expects bytes of 0 and 1.
bool tests_action_bools(const Program& program);

}  // namespace rddlc::ir
