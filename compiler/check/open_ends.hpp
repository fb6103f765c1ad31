// The body of `sum_{?x : t} ...` takes in everything to its right, also where brackets at its
// beginning look as if they ended it.
#pragma once

#include "check/scope.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rddlc::checking {

// Warns if the body of the aggregation or determinant that is being checked continues behind its
// brackets, though it has nothing to do with `variables` there, and if the value would differ if
// the brackets ended it. `op` is absent for a determinant.
void warn_of_long_body(std::optional<Reduction> op, const std::vector<model::VariableId>& variables,
                       const Scope& scope);

// The hint if the construct that is being checked binds `name` again: it may stand behind another
// one, and be in the body of that one only because nothing ends it.
std::string hint_for_bound_again(const std::string& name, const Scope& scope);

bool uses_any(Span span, const std::vector<model::VariableId>& variables, const Scope& scope);

}  // namespace rddlc::checking
