// Non-fluents that are to be fitted.
#pragma once

#include "ast/ast.hpp"

#include <string>
#include <vector>

namespace rddlc::workbench {

// Makes state-fluents of these real non-fluents, which keep their value:
//
//     GAIN : { non-fluent, real, ... };   =>   GAIN : { state-fluent, real, ... };  GAIN' = GAIN;
//
// and moves their values to the initial state. Derivatives by the state are then also those by the
// parameters. Throws Failure where a name is not that of a real non-fluent.
void open_parameters(ast::Program& program, const std::vector<std::string>& names);

}  // namespace rddlc::workbench
