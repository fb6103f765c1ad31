// Random values in init-state, which --std=rddlc allows: "p(a) = Normal(MEAN(a), 1.0);"
#pragma once

#include "check/context.hpp"

#include <string>

namespace rddlc::checking {

// The distribution that is assigned, if it is one.
const ast::Expr* draw_of(const ast::Assignment& assignment);

// Adds the draw to the model. `assignment` names a grounding of the fluent, `grounded_name`.
void check_initial_draw(const ast::Assignment& assignment, model::FluentId fluent,
                        const std::string& grounded_name, Context& context);

}  // namespace rddlc::checking
