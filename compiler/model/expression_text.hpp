// Expressions as text: RDDL's operators, fully bracketed, with every cast written out.
#pragma once

#include "model/model.hpp"

#include <string>

namespace rddlc::model {

// "bool", "int", "real" or the name of the object type.
std::string text_of(const Model& model, ValueType type);
// "true", "3", "0.5", and an object's name: "@red" for an enumerated type, "t1" otherwise.
std::string text_of(const Model& model, ValueType type, const Value& value);
// "?x, ?y", "?x: t, ?y: t"
std::string variable_list(const Model& model, const std::vector<VariableId>& variables);
std::string typed_variable_list(const Model& model, const std::vector<VariableId>& variables);

// Broken into several lines where one line, begun at column `indent`, would be too long;
// continuation lines are indented by at least `indent`.
std::string text_of(const Model& model, const Expr& expression, int indent);

}  // namespace rddlc::model
