#include "parse/spelling.hpp"

#include "parse/characters.hpp"
#include "parse/codes.hpp"
#include "support/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace rddlc {

namespace {

// ------------------------------------------------------------------------ foreign spellings

struct ForeignOperator {
    std::string_view spelling;
    std::size_t meant;  // token type; if RDDL lacks it, one of similar use
    std::string_view hint;
    std::string_view instead = {};  // what to write; empty if it takes more than another word
};

constexpr ForeignOperator foreign_operators[] = {
    {"!", Parser::NOT, "'not' is written '~'", "~"},
    {"!=", Parser::NOT_EQUAL, "'not equal' is written '~='", "~="},
    {"<>", Parser::NOT_EQUAL, "'not equal' is written '~='", "~="},
    {"&&", Parser::AND, "'and' is written '^'", "^"},
    {"||", Parser::OR, "'or' is written '|'", "|"},
    {"%", Parser::DIVIDE, "the remainder is a function: mod[a, b]"},
    {"**", Parser::TIMES, "a power is a function: pow[a, b]"},
    {"->", Parser::IMPLIES, "'implies' is written '=>'", "=>"},
};

const ForeignOperator& find_foreign(std::string_view spelling) {
    return *std::find_if(std::begin(foreign_operators), std::end(foreign_operators),
                         [&](const ForeignOperator& op) { return op.spelling == spelling; });
}

struct CharacterHint {
    std::string_view characters;
    std::string_view hint;
    std::string_view instead = {};
};

constexpr CharacterHint character_hints[] = {
    {"?", "a choice is written: if (c) then a else b"},
    {"≤", "write '<='", "<="},
    {"≥", "write '>='", ">="},
    {"≠", "'not equal' is written '~='", "~="},
    {"∧", "'and' is written '^'", "^"},
    {"∨", "'or' is written '|'", "|"},
    {"¬", "'not' is written '~'", "~"},
    {"..", "list all values: {@a, @b, @c}"},
};

// `instead` may be empty.
Hint hint_to_write(std::string_view hint, std::string_view instead, Span place) {
    if (instead.empty()) return std::string(hint);
    return {std::string(hint), {{place, std::string(instead)}}};
}

Hint hint_for_character(std::string_view characters, Span place) {
    for (const CharacterHint& known : character_hints)
        if (known.characters == characters) return hint_to_write(known.hint, known.instead, place);
    return hint_for_lookalike(characters, place);
}

// The comment by lines that begin with "//", each to its end.
std::string as_lines_of_comment(std::string_view comment, bool ends_line) {
    comment.remove_prefix(comment.starts_with('#') ? 1 : 2);
    if (comment.ends_with("*/")) comment.remove_suffix(2);
    std::string text = "//";
    for (const char c : comment) {
        text += c;
        if (c == '\n') text += "//";
    }
    return ends_line ? text : text + "\n";
}

// A number with an exponent in the form that RDDL has, where that is of reasonable length.
std::optional<std::string> without_exponent(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || value > 1e15 || (value < 1e-15 && value != 0)) return std::nullopt;
    for (int digits = 1; digits <= 20; ++digits) {
        std::string fixed = fmt::format("{:.{}f}", value, digits);
        double again = 0;
        std::from_chars(fixed.data(), fixed.data() + fixed.size(), again);
        if (again == value) return fixed;
    }
    return std::nullopt;
}

// ------------------------------------------------------------------------------------ repair

class Repair {
  public:
    Repair(FileId file, const Source& source, Standard standard, Diagnostics& diagnostics)
        : file_(file), text_(source.text()), standard_(standard), diagnostics_(diagnostics) {}

    // The tokens for the parser.
    TokenList operator()(TokenList tokens) {
        TokenList kept;
        for (std::unique_ptr<Token>& token : tokens)
            if (keep(static_cast<antlr4::CommonToken&>(*token))) kept.push_back(std::move(token));
        report_illegal();
        return kept;
    }

  private:
    bool keep(antlr4::CommonToken& token) {
        switch (token.getType()) {
            case Parser::EXPONENT_NUMBER:
                return repair_exponent(token);
            case Parser::POINT_WITHOUT_DIGITS:
                return repair_point(token);
            case Parser::FOREIGN_OPERATOR:
                return repair_operator(token);
            case Parser::FOREIGN_COMMENT:
                return drop_comment(token);
            case Parser::LONE_PRIME:
                return drop_prime(token);
            case Parser::ILLEGAL:
                return drop_illegal(token);
            default:
                return true;
        }
    }

    bool repair_exponent(antlr4::CommonToken& token) {
        token.setType(Parser::REAL);
        if (standard_ == Standard::Rddlc) return true;
        const auto fixed = without_exponent(text(token));
        report(foreign_number, token, "RDDL numbers have no exponent",
               hint_to_write(
                   fmt::format("write all digits{}; {}",
                               fixed ? ": " + *fixed : ", or use pow[10, n]", extension_hint),
                   fixed.value_or(""), span_of(file_, token)));
        return true;
    }

    bool repair_point(antlr4::CommonToken& token) {
        std::string fixed = text(token);
        fixed.insert(fixed.find('.') + 1, "0");
        report(foreign_number, token, "a number cannot end in a point",
               hint_to_write("write at least one digit behind the point: " + fixed, fixed,
                             span_of(file_, token)));
        token.setType(Parser::REAL);
        return true;
    }

    bool repair_operator(antlr4::CommonToken& token) {
        const ForeignOperator& op = find_foreign(text(token));
        report(foreign_operator, token, fmt::format("RDDL has no operator '{}'", op.spelling),
               hint_to_write(op.hint, op.instead, span_of(file_, token)));
        token.setType(op.meant);
        return true;
    }

    bool drop_comment(const antlr4::CommonToken& token) {
        Span span = span_of(file_, token);
        const Span whole = span;
        span.end = std::min(span.end, span.begin + 2);
        if (text_[span.begin] == '#') span.end = span.begin + 1;
        report(foreign_comment, span,
               fmt::format("'{}' does not begin a comment in RDDL",
                           text_.substr(span.begin, span.end - span.begin)),
               {"comments begin with '//' and end with the line",
                {{whole, as_lines_of_comment(text(token), ends_line(whole.end))}}});
        return false;
    }

    bool ends_line(std::uint32_t offset) const {
        const std::size_t next = text_.find_first_not_of(" \t", offset);
        return next == text_.npos || text_[next] == '\n' || text_[next] == '\r';
    }

    bool drop_prime(const antlr4::CommonToken& token) {
        report(misplaced_prime, token, "an apostrophe must follow a name at once",
               {"the next value of a fluent is written with the apostrophe before the "
                "parentheses: p'(?x)",
                moved_prime(span_of(file_, token))});
        return false;
    }

    // From behind the parentheses, or a blank, to the end of the name.
    std::vector<Replacement> moved_prime(Span prime) const {
        std::size_t end = prime.begin;
        if (end > 0 && text_[end - 1] == ')') end = text_.rfind('(', end - 1);
        if (end == text_.npos) return {};
        while (end > 0 && text_[end - 1] == ' ') --end;
        const bool is_name = end > 0 && (std::isalnum(static_cast<unsigned char>(text_[end - 1])));
        if (!is_name) return {};
        const auto at = static_cast<std::uint32_t>(end);
        return {{{file_, at, at}, "'"}, {prime, ""}};
    }

    // Neighbours are reported together.
    bool drop_illegal(const antlr4::CommonToken& token) {
        const Span span = span_of(file_, token);
        if (illegal_ && illegal_->end == span.begin) {
            illegal_->end = span.end;
        } else {
            report_illegal();
            illegal_ = span;
        }
        return false;
    }

    void report_illegal() {
        if (!illegal_) return;
        const std::string_view found =
            text_.substr(illegal_->begin, illegal_->end - illegal_->begin);
        if (is_utf8(found))
            report(illegal_character, *illegal_, illegal_message(found),
                   hint_for_character(found, *illegal_));
        else
            report(not_utf8_text, *illegal_, "these bytes are not UTF-8 text",
                   "outside comments RDDL is written in ASCII; save the file in UTF-8");
        illegal_.reset();
    }

    static std::string illegal_message(std::string_view found) {
        constexpr std::size_t longest = 24;
        const bool control = found.size() == 1 && static_cast<unsigned char>(found[0]) < 0x20;
        if (control) return fmt::format("illegal character with code {}", int{found[0]});
        if (found.size() > longest) return "characters that mean nothing in RDDL";
        return fmt::format("{} means nothing in RDDL", spoken(found));
    }

    std::string text(const Token& token) const {
        const Span span = span_of(file_, token);
        return std::string(text_.substr(span.begin, span.end - span.begin));
    }

    void report(Code code, const Token& token, std::string message, Hint hint) {
        report(code, span_of(file_, token), std::move(message), std::move(hint));
    }

    // A file full of strange characters is not worth a message each.
    void report(Code code, Span span, std::string message, Hint hint) {
        if (reported_++ < max_reports)
            diagnostics_.report(
                Diagnostic{code, span, std::move(message)}.with_hint(std::move(hint)));
    }

    static constexpr std::size_t max_reports = 25;

    FileId file_;
    std::string_view text_;
    Standard standard_;
    Diagnostics& diagnostics_;
    std::optional<Span> illegal_;
    std::size_t reported_ = 0;
};

}  // namespace

TokenList repair_spelling(FileId file, const Source& source, Standard standard, TokenList tokens,
                          Diagnostics& diagnostics) {
    return Repair(file, source, standard, diagnostics)(std::move(tokens));
}

}  // namespace rddlc
