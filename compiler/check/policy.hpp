// Policy blocks: read, checked for names, not executed.
#pragma once

#include "check/blocks.hpp"
#include "check/context.hpp"

namespace rddlc::checking {

// Declarations, CPFs of all action-fluents, and that every fluent mentioned exists.
void check_policy(const Blocks& blocks, Context& context);

}  // namespace rddlc::checking
