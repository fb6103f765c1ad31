// The declarations in pvariables.
#pragma once

#include "check/blocks.hpp"
#include "check/context.hpp"

namespace rddlc::checking {

// Fluents in the order of declaration, with defaults but without values.
void declare_fluents(const Blocks& blocks, Context& context);

// Declares the fluents of the policy, with their values. The domain cannot see them: to be called
// after all its expressions have been checked.
void declare_policy_fluents(const Blocks& blocks, Context& context);

// Fluents that no expression mentions; after all expressions have been checked.
void warn_of_unused_fluents(Context& context);

}  // namespace rddlc::checking
