#include "parse/limits.hpp"

#include "parse/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace rddlc {

namespace {

// A bracket that is open, and the tree under construction inside it. A ',' ends a chunk, whose
// depth is at most that of all its operators in a row upon its deepest bracket. A ';' ends it all:
// the bracket is that of a section, and a new tree begins.
struct Level {
    std::size_t opened_at = 0;
    std::size_t chunk_begin = 0;  // its first token
    bool chunk_is_empty = true;
    std::size_t operators = 0;      // of the current chunk
    std::size_t deepest = 0;        // bracket of the current chunk
    std::size_t deepest_chunk = 0;  // of those that have ended

    std::size_t chunk_depth() const { return operators + deepest; }
    void token_at(std::size_t offset) {
        if (std::exchange(chunk_is_empty, false)) chunk_begin = offset;
    }
    void end_chunk() {
        deepest_chunk = std::max(deepest_chunk, chunk_depth());
        operators = deepest = 0;
        chunk_is_empty = true;
    }
};

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_word_part(char c) {
    return is_letter(c) || is_digit(c) || c == '-' || c == '_';
}
bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}
bool is_one_of(char c, std::string_view set) {
    return set.find(c) != set.npos;
}

// Reads the text once, without a grammar: unbalanced and garbled texts are measured as well.
class Scanner {
  public:
    Scanner(FileId file, std::string_view text) : file_(file), text_(text), levels_(1) {}

    // The first limit exceeded.
    std::optional<Diagnostic> scan() {
        while (at_ < text_.size()) {
            step();
            if (auto problem = exceeded_limit()) return problem;
        }
        return std::nullopt;
    }

  private:
    void step() {
        const char c = text_[at_];
        if (is_blank(c)) {
            ++at_;
            return;
        }
        if (c == '/' && peek() == '/') return skip_comment();
        ++tokens_;
        levels_.back().token_at(at_);
        if (is_letter(c) || c == '?' || c == '@') return word();
        if (is_digit(c)) return number();
        if (c == '(' || c == '[' || c == '{') open();
        if (c == ')' || c == ']' || c == '}') close();
        if (c == ',') levels_.back().end_chunk();
        if (c == ';') levels_.back() = {.opened_at = levels_.back().opened_at};
        if (is_operator(c)) ++levels_.back().operators;
        ++at_;
    }

    char peek() const { return at_ + 1 < text_.size() ? text_[at_ + 1] : '\0'; }

    void skip_comment() { at_ = std::min(text_.find_first_of("\r\n", at_), text_.size()); }

    // A word ends in a letter or digit; "if" makes the tree deeper like an operator.
    void word() {
        const std::size_t begin = at_++;
        while (at_ < text_.size() && is_word_part(text_[at_])) ++at_;
        while (at_ > begin + 1 && (text_[at_ - 1] == '-' || text_[at_ - 1] == '_')) --at_;
        if (text_.substr(begin, at_ - begin) == "if") ++levels_.back().operators;
    }

    void number() {
        while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
    }

    // "<=>" and its like count once; "_" is that of "sum_{"; a single "=" defines.
    bool is_operator(char c) const {
        const bool continues =
            at_ > 0 && (c == '=' || c == '>') && is_one_of(text_[at_ - 1], "<=>~");
        const bool defines = c == '=' && !is_one_of(peek(), "=>");
        return !continues && !defines && is_one_of(c, "^&|~+-*/=<>_");
    }

    void open() { levels_.push_back({.opened_at = at_}); }

    void close() {
        if (levels_.size() == 1) return;
        levels_.back().end_chunk();
        const std::size_t depth = levels_.back().deepest_chunk + 1;
        levels_.pop_back();
        levels_.back().deepest = std::max(levels_.back().deepest, depth);
    }

    std::optional<Diagnostic> exceeded_limit() const {
        const Level& level = levels_.back();
        if (levels_.size() > max_nesting + 1)
            return Diagnostic{nested_too_deeply, span_at(level.opened_at),
                              fmt::format("more than {} brackets inside each other", max_nesting)}
                .with_hint("split the expression with interm-fluents");
        if (level.chunk_depth() > max_depth)
            return Diagnostic{
                expression_too_long, span_at(level.chunk_begin),
                fmt::format("this expression is more than {} operators and brackets deep",
                            max_depth)}
                .with_hint("split it with interm-fluents, or write it as a sum_{...} over objects");
        if (tokens_ > max_tokens)
            return Diagnostic{file_too_large, span_at(at_ - 1),
                              fmt::format("more than {} words and marks in one file", max_tokens)};
        return std::nullopt;
    }

    Span span_at(std::size_t offset) const {
        return {file_, static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(offset + 1)};
    }

    FileId file_;
    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t tokens_ = 0;
    std::vector<Level> levels_;
};

}  // namespace

bool within_limits(FileId file, const Source& source, Diagnostics& diagnostics) {
    if (source.text().size() > max_bytes) {
        diagnostics.report({file_too_large, Span{file, 0, 0},
                            fmt::format("the file is larger than {} MiB", max_bytes >> 20)});
        return false;
    }
    std::optional<Diagnostic> problem = Scanner(file, source.text()).scan();
    if (problem) diagnostics.report(std::move(*problem));
    return !problem;
}

}  // namespace rddlc
