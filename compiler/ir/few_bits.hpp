// Tests and counts of few bits of a row of bools, which packs make of masks
// (rddl/values/few_bits.hpp).
#pragma once

#include "ir/ir.hpp"

#include <optional>
#include <vector>

namespace rddlc::ir {

// Bits of a row of bools, and the element of a constant table whose ones, four at most, choose
// some.
struct FewBits {
    NodeId bits;
    const Load* ones;
};

// `bit_and(bits, ONES[x])`, if the bits are narrow (ir/narrow_bits.hpp); `narrow_bits` is by
// NodeId.
std::optional<FewBits> few_bits(const Program& program, const std::vector<bool>& narrow_bits,
                                NodeId joined);

}  // namespace rddlc::ir
