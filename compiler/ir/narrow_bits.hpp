// Bits of ints that packs may have in narrow lanes (rddl/values/narrow_bits.hpp).
#pragma once

#include "ir/analysis.hpp"
#include "ir/ir.hpp"

#include <vector>

namespace rddlc::ir {

// Whether a node has the bits of a whole row of at most 31 bools, or joins such bits bit by bit,
// and is only compared or joined further, with constants that have no more bits than they, or
// counted if there are 15 at most: then lanes of 16 bits, or of 32 for more, give the same results.
// By NodeId.
std::vector<bool> narrow_bits(const Program& program, const std::vector<Properties>& properties);

}  // namespace rddlc::ir
