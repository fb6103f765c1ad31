// Layout of blocks, sections and declarations.
#pragma once

#include "ast/ast.hpp"
#include "format/comments.hpp"
#include "support/document.hpp"

namespace rddlc::format {

using namespace document;

// The lines of a file. `program` holds the blocks of that file and nothing else.
std::vector<TextLine> layout(const ast::Program& program, std::vector<Token> tokens);

}  // namespace rddlc::format
