// Text to meaning: names resolved, types known, casts explicit, CPFs in order.
#pragma once

#include "ast/ast.hpp"
#include "model/model.hpp"
#include "support/diagnostic.hpp"
#include "support/source.hpp"
#include "support/standard.hpp"

#include <optional>

namespace rddlc {

// A domain without an instance.
bool is_domain_alone(const ast::Program& program);

// Reports every error of such a program that can be found without objects and values. Without
// errors it returns a model that lacks these: types have no objects, and fluents no values.
std::optional<model::Model> check_domain(const ast::Program& program, const Sources& sources,
                                         Diagnostics& diagnostics,
                                         Standard standard = Standard::PyRddlGym);

// Reports every error of the stage at once; nothing is returned if there was one.
std::optional<model::Model> check(const ast::Program& program, const Sources& sources,
                                  Diagnostics& diagnostics,
                                  Standard standard = Standard::PyRddlGym);

// The name in `non-fluents = NAME`; null without one. The last of several counts.
const ast::Name* named_non_fluents(const ast::Instance& instance);

}  // namespace rddlc
