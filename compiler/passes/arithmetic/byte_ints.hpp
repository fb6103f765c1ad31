// Whether every int that steps of packs compute fits into a byte, so that a register holds those of
// 64 environments.
//
// The ints of the state do where invariants bound them and episodes start within the bounds: an
// episode ends where they do not hold. A caller may set any other state; its batch is then stepped
// one by one (rddl/interface/abi.hpp).
//
// A word of at most 7 bools is a byte too, and so are counts of its ones and objects of the
// caller's actions. A byte may be the index of a constant table, which a register then permutes.
// Words and indices are looked at only where packs of 64 suit the program without byte ints too: in
// smaller packs words lie in narrow lanes (ir/narrow_bits.hpp), and fewer draws are made.
#pragma once

#include "ir/ir.hpp"

namespace rddlc::passes {

// False for programs without ints, for ints from the caller's actions that are no objects, and for
// operators that packs have for ints of 64 bits alone.
bool has_byte_ints(const ir::Program& program);

}  // namespace rddlc::passes
