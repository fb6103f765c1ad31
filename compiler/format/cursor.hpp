// Walks over the tokens of a file, in their order: what is laid out is what was written.
#pragma once

#include "format/comments.hpp"
#include "support/document.hpp"

#include <stdexcept>
#include <utility>

namespace rddlc::format {

using namespace document;

// The comments and blank lines above a declaration.
struct Lead {
    std::vector<CommentAbove> comments;
    bool blank_line_before = false;  // between the comments, if any, and the declaration

    bool separates() const { return blank_line_before || !comments.empty(); }
};

class Cursor {
  public:
    explicit Cursor(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

    const Token& next() const { return tokens_[at_]; }
    // The k-th after the next one; the end of the file from there on.
    const Token& ahead(std::size_t k) const {
        return tokens_[std::min(at_ + k, tokens_.size() - 1)];
    }
    bool is_at(std::string_view text) const { return next().text == text; }

    // The next token's comments above, which are then no longer part of it.
    Lead take_lead() {
        return {std::exchange(tokens_[at_].above, {}), next().has_blank_line_before()};
    }

    // The next token with its comments.
    Doc take() {
        const Token& token = next();
        if (token.text.empty()) throw std::logic_error("format: tokens do not match the tree");
        ++at_;
        Doc word = text(std::string(token.text));
        if (token.above.empty() && token.behind.empty()) return word;
        std::vector<Doc> parts;
        for (const CommentAbove& comment : token.above)
            parts.push_back(own_line_comment(std::string(comment.text)));
        parts.push_back(std::move(word));
        if (!token.behind.empty())
            parts.push_back(trailing_comment({token.behind.begin(), token.behind.end()}));
        return concat(std::move(parts));
    }

    // The same for a token that the syntax tree foretells.
    Doc take(std::string_view expected) {
        if (!is_at(expected)) throw std::logic_error("format: tokens do not match the tree");
        return take();
    }

  private:
    std::vector<Token> tokens_;
    std::size_t at_ = 0;
};

}  // namespace rddlc::format
