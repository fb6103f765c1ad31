// Parses a text into a syntax tree.
#pragma once

#include "ast/ast.hpp"
#include "support/diagnostic.hpp"
#include "support/standard.hpp"

#include <optional>
#include <span>

namespace rddlc {

// Reads the blocks of all files, in their order; domain and instance may stand in one file or in
// several. Reports what is wrong in each file; the result is meaningful only without errors.
// Whether the blocks of a problem are all there is the checker's business.
ast::Program parse(const Sources& sources, std::span<const FileId> files, Diagnostics& diagnostics,
                   Standard standard = Standard::PyRddlGym);

// The expression in these bytes of a file of another kind, such as a scene; nothing if it is wrong.
std::optional<ast::Expr> parse_expression(const Source& source, Span span, Diagnostics& diagnostics,
                                          Standard standard = Standard::PyRddlGym);

}  // namespace rddlc
