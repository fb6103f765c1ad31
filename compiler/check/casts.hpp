// Types of values and the casts between them: bool -> int -> real, never back.
#pragma once

#include "check/scope.hpp"

#include <optional>
#include <string>

namespace rddlc::checking {

// A checked expression; nothing if a part of it was reported, so that it is not reported again.
using Typed = std::optional<model::Expr>;

bool is_object(model::ValueType type);
// Both primitive.
bool castable(model::ValueType from, model::ValueType to);
// The larger of two primitive types.
model::ValueType promoted(model::ValueType a, model::ValueType b);

// Upward, or no cast at all where the type is right already.
model::Expr convert(model::Expr expression, model::ValueType to);

// A place that needs a value of one type, and how messages speak of it.
struct Need {
    model::ValueType type;
    std::string what;  // "the condition of 'if'"
    Code code;
    std::optional<Note> note = {};
    std::string hint = {};  // what is probably meant instead; empty: what suits the types
};

// The expression at the needed type. RDDL types values, not expressions: where a branch of an
// `if` or a case of a `switch` has a forbidden type, the others may still be taken, so that branch
// becomes a TypeFault with a warning. Reported as an error if no path gives the needed type.
Typed require(Typed expression, const Need& need, Scope& scope);
Typed require_bool(Typed expression, std::string what, Scope& scope);
Typed require_int(Typed expression, std::string what, Scope& scope);
// Any of bool, int and real.
Typed require_number(Typed expression, std::string_view what, Scope& scope);
// A number, cast to real.
Typed require_real(Typed expression, std::string_view what, Scope& scope);

// The same as require(), but nothing is reported if no path fits.
Typed try_require(model::Expr expression, const Need& need, Scope& scope);
// A fault in place of `expression`, whose type is wrong on this path; with the warning.
model::Expr fault_instead_of(const model::Expr& expression, const Need& need, Scope& scope);

}  // namespace rddlc::checking
