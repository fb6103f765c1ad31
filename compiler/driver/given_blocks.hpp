// Chooses the blocks of the given files that a compilation takes.
#pragma once

#include "ast/ast.hpp"
#include "support/diagnostic.hpp"
#include "support/source.hpp"

#include <string>

namespace rddlc {

// Leaves the policy block alone of what `file` holds: a policy may come in the file of a whole
// problem, which is not the one that is compiled.
void take_policy_alone(ast::Program& tree, FileId file, const Sources& sources,
                       Diagnostics& diagnostics);

// Leaves the instance of that name alone, and of the non-fluents blocks the one that it names. If
// that is not there, the instance may have non-fluents of its own, else the blocks stay.
void take_instance(ast::Program& tree, const std::string& name, Diagnostics& diagnostics);

}  // namespace rddlc
