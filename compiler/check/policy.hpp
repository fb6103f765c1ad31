// Policy blocks: how the agent chooses its actions (docs/policies.md).
#pragma once

#include "check/blocks.hpp"
#include "check/context.hpp"

namespace rddlc::checking {

// Model::policy and its fluents. After all expressions of the domain have been checked, which must
// not see what the policy declares.
void check_policy(const Blocks& blocks, Context& context);

}  // namespace rddlc::checking
