// What was written -> what it means: names resolved, types known, casts explicit, CPFs in order.
#pragma once

#include "ast/ast.hpp"
#include "model/model.hpp"
#include "support/diagnostic.hpp"
#include "support/source.hpp"
#include "support/standard.hpp"

#include <optional>

namespace rddlc {

// Reports every error of the stage at once; nothing is returned if there was one.
std::optional<model::Model> check(const ast::Program& program, const Sources& sources,
                                  Diagnostics& diagnostics,
                                  Standard standard = Standard::PyRddlGym);

}  // namespace rddlc
