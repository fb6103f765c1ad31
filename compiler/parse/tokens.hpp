// One file as tokens. Spellings of other languages are already repaired (parse/spelling.hpp).
#pragma once

#include "grammar/RDDLLexer.h"
#include "grammar/RDDLParser.h"
#include "support/diagnostic.hpp"
#include "support/source.hpp"
#include "support/standard.hpp"

#include <memory>
#include <vector>

namespace rddlc {

using Parser = grammar::RDDLParser;
using antlr4::Token;

// Owns the characters that the tokens point into. Token positions are byte offsets of the file.
class TokenizedFile {
  public:
    TokenizedFile(FileId file, const Source& source, Standard standard, Diagnostics& diagnostics);

    antlr4::CommonTokenStream& stream() { return *stream_; }
    // All of them; the last is the end of the file.
    std::vector<Token*> tokens() { return stream_->getTokens(); }

  private:
    antlr4::ANTLRInputStream characters_;
    std::unique_ptr<antlr4::TokenSource> source_;
    std::unique_ptr<antlr4::CommonTokenStream> stream_;
};

Span span_of(FileId file, const Token& token);
// The span from the first byte of one token to the last of another.
Span span_of(FileId file, const Token& first, const Token& last);

}  // namespace rddlc
