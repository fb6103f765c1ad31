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

// Remembers the aggregation that is being checked for hint_for_comparison_in_body().
void note_aggregation(const std::vector<model::VariableId>& variables, Scope& scope);

// Both readings of an aggregation at the end of `misfit`, a number where a bool is needed, if its
// body has taken in a comparison that has nothing to do with its variables; else "".
std::string hint_for_comparison_in_body(Span misfit, const Scope& scope);

// Both readings of the 'forall' or 'exists' that is being checked, if its body is a number only
// because it takes in what stands behind a bool; else "".
std::string hint_for_number_as_body(const model::Expr& body, const Scope& scope);

// Both readings of an 'argmax' or 'argmin' whose body takes in the comparison that is being
// checked, which compares a number with an object; else "".
std::string hint_for_compared_object(const Scope& scope);

// The hint if the construct that is being checked binds `name` again: it may stand behind another
// one, and be in the body of that one only because nothing ends it.
std::string hint_for_bound_again(const std::string& name, const Scope& scope);

bool uses_any(Span span, const std::vector<model::VariableId>& variables, const Scope& scope);

}  // namespace rddlc::checking
