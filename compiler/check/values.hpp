// Values that are written down: defaults, non-fluents, init-state.
#pragma once

#include "check/blocks.hpp"
#include "check/context.hpp"

namespace rddlc::checking {

// The constant as a value of the fluent's range, cast upward (bool -> int -> real) where needed;
// reported with `code` if it is not one.
std::optional<model::Value> value_of(const ast::Constant& constant, const model::Fluent& fluent,
                                     Code code, Context& context);

// Fills in the default once for each grounding of the fluent; zeros without a default.
void fill_with_default(model::Fluent& fluent, Context& context);

// The tables of non-fluents, state-fluents and action-fluents: defaults, then what the instance
// says.
void assign_values(const Blocks& blocks, Context& context);

}  // namespace rddlc::checking
