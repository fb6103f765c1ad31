// Tables of the state of which few bools are true when an episode begins. Another state has the
// same values and takes longer.
#pragma once

#include "ir/ir.hpp"

#include <cstdint>

namespace rddlc::passes {

// Whether it is such a table: one bool at least is true, and one of `least_per_true` at most.
bool begins_with_few_true(const ir::Buffer& buffer, std::int64_t least_per_true);

}  // namespace rddlc::passes
