// The state of the parser when a token does not fit, and the diagnostic made from it.
#pragma once

#include "parse/tokens.hpp"

#include <set>
#include <vector>

namespace rddlc {

using TokenTypes = std::set<std::size_t>;

struct SyntaxError {
    FileId file;
    const std::vector<Token*>& tokens;
    std::size_t index;  // of the token that does not fit
    TokenTypes expected;
    const antlr4::ParserRuleContext* context;  // innermost
    const antlr4::dfa::Vocabulary& vocabulary;

    const Token& found() const { return *tokens[index]; }
    // The token `distance` before the one that does not fit; null before the first.
    const Token* before(std::size_t distance) const {
        return index >= distance ? tokens[index - distance] : nullptr;
    }
    bool expects(std::size_t type) const { return expected.contains(type); }
};

Diagnostic describe(const SyntaxError& error);

// The innermost bracket that is open before `tokens[index]`.
std::optional<std::size_t> innermost_open(const std::vector<Token*>& tokens, std::size_t index);
// The bracket that closes the one at `tokens[open]`.
std::optional<std::size_t> matching_close(const std::vector<Token*>& tokens, std::size_t open);
// The end of the file, from the last token on.
std::size_t type_at(const std::vector<Token*>& tokens, std::size_t index);
bool begins_line(const std::vector<Token*>& tokens, std::size_t index);
// Whether a section or block begins at a token. Its keyword alone proves nothing: it may be
// misused as a name.
bool begins_section(const std::vector<Token*>& tokens, std::size_t index);
bool begins_block(const std::vector<Token*>& tokens, std::size_t index);

}  // namespace rddlc
