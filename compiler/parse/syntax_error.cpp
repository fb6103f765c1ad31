#include "parse/syntax_error.hpp"

#include "parse/codes.hpp"
#include "parse/expected.hpp"
#include "parse/hints.hpp"

#include <fmt/format.h>

namespace rddlc {

namespace {

std::size_t closer_of(std::size_t opener) {
    switch (opener) {
        case Parser::OPEN_ROUND:
            return Parser::CLOSE_ROUND;
        case Parser::OPEN_SQUARE:
            return Parser::CLOSE_SQUARE;
        default:
            return Parser::CLOSE_CURLY;
    }
}

bool is_opener(std::size_t type) {
    return type == Parser::OPEN_ROUND || type == Parser::OPEN_SQUARE || type == Parser::OPEN_CURLY;
}

bool is_closer(std::size_t type) {
    return type == Parser::CLOSE_ROUND || type == Parser::CLOSE_SQUARE ||
           type == Parser::CLOSE_CURLY;
}

std::string_view closing_text(std::size_t opener) {
    switch (opener) {
        case Parser::OPEN_ROUND:
            return ")";
        case Parser::OPEN_SQUARE:
            return "]";
        default:
            return "}";
    }
}

// The point behind the token before: where something is missing.
Span span_after_previous(const SyntaxError& error) {
    const Span previous = span_of(error.file, *error.before(1));
    return {error.file, previous.end, previous.end};
}

Span span_of_found(const SyntaxError& error) {
    return span_of(error.file, error.found());
}

// ------------------------------------------------------------------------------------- causes

std::optional<Diagnostic> lacking_semicolon(const SyntaxError& error) {
    const std::size_t found = error.found().getType();
    const bool ends_item = found == Parser::CLOSE_CURLY || found == Token::EOF ||
                           begins_line(error.tokens, error.index);
    if (!error.expects(Parser::SEMICOLON) || !ends_item || error.index == 0) return std::nullopt;
    const Span place = span_after_previous(error);
    Hint hint = hint_for(error);
    if (error.before(1)->getType() == Parser::CLOSE_CURLY && hint.text.empty())
        hint = "sections and declarations end in '};'";
    if (hint.fix.empty()) hint.fix = {{place, ";"}};
    return Diagnostic{missing_semicolon, place,
                      fmt::format("missing ';' before {}", describe_found(error.found()))}
        .with_hint(std::move(hint));
}

// Tokens that cannot stand inside a bracket, so that the bracket must have been forgotten before
// it.
bool ends_bracket(const SyntaxError& error, std::size_t opener) {
    const std::size_t found = error.found().getType();
    return found == Parser::SEMICOLON || found == Token::EOF || is_closer(found) ||
           begins_section(error.tokens, error.index) || begins_block(error.tokens, error.index) ||
           (opener != Parser::OPEN_CURLY && begins_line(error.tokens, error.index));
}

// The hint; if it changes nothing, the missing bracket is the change.
Hint hint_that_closes(const SyntaxError& error, std::size_t opener) {
    Hint hint = hint_for(error);
    if (hint.fix.empty() && error.index > 0)
        hint.fix = {{span_after_previous(error), std::string(closing_text(opener))}};
    return hint;
}

std::optional<Diagnostic> unclosed_bracket(const SyntaxError& error) {
    const auto open = innermost_open(error.tokens, error.index);
    if (!open) return std::nullopt;
    const Token& opener = *error.tokens[*open];
    if (!ends_bracket(error, opener.getType())) return std::nullopt;
    const bool at_end = error.found().getType() == Token::EOF;
    if (!error.expects(closer_of(opener.getType())) && !at_end) return std::nullopt;
    const std::string place =
        at_end ? "at the end of the file" : "before " + describe_found(error.found());
    return Diagnostic{unbalanced_bracket, span_of_found(error),
                      fmt::format("missing '{}' {}", closing_text(opener.getType()), place)}
        .note(span_of(error.file, opener), fmt::format("'{}' opened here", opener.getText()))
        .with_hint(hint_that_closes(error, opener.getType()));
}

std::optional<Diagnostic> surplus_bracket(const SyntaxError& error) {
    const std::size_t found = error.found().getType();
    if (!is_closer(found)) return std::nullopt;
    const auto open = innermost_open(error.tokens, error.index);
    if (open && closer_of(error.tokens[*open]->getType()) == found) return std::nullopt;
    // A ')' or ']' does not close the '{' of a section or block.
    if (!open || error.tokens[*open]->getType() == Parser::OPEN_CURLY)
        return Diagnostic{unbalanced_bracket, span_of_found(error),
                          fmt::format("'{}' closes nothing", error.found().getText())}
            .fixed_by(span_of_found(error), "");
    const Token& opener = *error.tokens[*open];
    return Diagnostic{
        unbalanced_bracket, span_of_found(error),
        fmt::format("'{}' does not close '{}'", error.found().getText(), opener.getText())}
        .note(span_of(error.file, opener), fmt::format("'{}' opened here", opener.getText()))
        .fixed_by(span_of_found(error), std::string(closing_text(opener.getType())));
}

std::optional<Diagnostic> reserved_name(const SyntaxError& error) {
    static const TokenTypes structure = {Parser::THEN,    Parser::ELSE, Parser::CASE,
                                         Parser::DEFAULT, Parser::IF,   Parser::RANDOM_VECTOR};
    const bool reserved =
        is_reserved_word(error.found()) && !structure.contains(error.found().getType());
    const bool name = error.expects(Parser::ID) || error.expects(Parser::PRIMITIVE);
    if (!reserved || !name) return std::nullopt;
    return Diagnostic{
        reserved_word_as_name, span_of_found(error),
        fmt::format("'{}' is a reserved word and cannot be a name", error.found().getText())}
        .with_hint(hint_for(error));
}

std::optional<Diagnostic> lacking_else(const SyntaxError& error) {
    if (error.expected != TokenTypes{Parser::ELSE}) return std::nullopt;
    return Diagnostic{missing_else, span_of_found(error),
                      fmt::format("missing 'else' before {}", describe_found(error.found()))}
        .with_hint(hint_for(error));
}

// ---------------------------------------------------------------------------------- the place

std::string_view construct(std::size_t rule) {
    switch (rule) {
        case Parser::RuleTypeDeclaration:
            return "the type";
        case Parser::RulePvariable:
            return "the declaration";
        case Parser::RuleCpf:
            return "the definition";
        case Parser::RuleCondition:
            return "the condition";
        case Parser::RuleObjectList:
            return "the list of objects";
        case Parser::RuleAssignment:
            return "the value";
        case Parser::RuleDomainSection:
        case Parser::RulePolicySection:
        case Parser::RuleInstanceSection:
        case Parser::RuleNonFluentsSection:
            return "the section";
        case Parser::RuleDomain:
        case Parser::RuleInstance:
        case Parser::RuleNonFluents:
        case Parser::RulePolicy:
            return "the block";
        default:
            return "";
    }
}

// A note on the construct around the error, when that began on an earlier line.
std::optional<Note> enclosing_construct(const SyntaxError& error) {
    const antlr4::tree::ParseTree* tree = error.context;
    for (; tree != nullptr; tree = tree->parent) {
        const auto* context = static_cast<const antlr4::ParserRuleContext*>(tree);
        const std::string_view words = construct(context->getRuleIndex());
        const Token* begin = const_cast<antlr4::ParserRuleContext*>(context)->getStart();
        if (words.empty() || begin == nullptr) continue;
        if (begin->getLine() >= error.found().getLine()) return std::nullopt;
        return Note{span_of(error.file, *begin), fmt::format("in {} that begins here", words)};
    }
    return std::nullopt;
}

}  // namespace

Diagnostic describe(const SyntaxError& error) {
    for (const auto cause :
         {lacking_else, lacking_semicolon, unclosed_bracket, surplus_bracket, reserved_name})
        if (auto diagnostic = cause(error)) return std::move(*diagnostic);
    Diagnostic diagnostic{unexpected_token, span_of_found(error),
                          fmt::format("expected {}, found {}", describe_expected(error),
                                      describe_found(error.found()))};
    if (auto note = enclosing_construct(error)) diagnostic.notes.push_back(std::move(*note));
    return std::move(diagnostic).with_hint(hint_for(error));
}

std::optional<std::size_t> innermost_open(const std::vector<Token*>& tokens, std::size_t index) {
    std::size_t closed = 0;
    while (index-- > 0) {
        const std::size_t type = tokens[index]->getType();
        if (is_closer(type)) ++closed;
        if (is_opener(type) && closed-- == 0) return index;
    }
    return std::nullopt;
}

std::optional<std::size_t> matching_close(const std::vector<Token*>& tokens, std::size_t open) {
    std::size_t opened = 0;
    for (std::size_t index = open; index < tokens.size(); ++index) {
        const std::size_t type = tokens[index]->getType();
        if (is_opener(type)) ++opened;
        if (is_closer(type) && --opened == 0) return index;
    }
    return std::nullopt;
}

bool begins_line(const std::vector<Token*>& tokens, std::size_t index) {
    return index == 0 || tokens[index - 1]->getLine() < tokens[index]->getLine();
}

std::size_t type_at(const std::vector<Token*>& tokens, std::size_t index) {
    return index < tokens.size() ? tokens[index]->getType() : Token::EOF;
}

bool begins_section(const std::vector<Token*>& tokens, std::size_t index) {
    static const TokenTypes keywords = {
        Parser::REQUIREMENTS, Parser::TYPES,      Parser::PVARIABLES,
        Parser::CPFS,         Parser::REWARD,     Parser::CONSTRAINTS,
        Parser::OBJECTS,      Parser::INIT_STATE, Parser::MAX_NONDEF_ACTIONS,
        Parser::HORIZON,      Parser::DISCOUNT,   Parser::NON_FLUENTS,
        Parser::DOMAIN};
    const std::size_t next = type_at(tokens, index + 1);
    return keywords.contains(type_at(tokens, index)) &&
           (next == Parser::OPEN_CURLY || next == Parser::ASSIGN);
}

bool begins_block(const std::vector<Token*>& tokens, std::size_t index) {
    static const TokenTypes keywords = {Parser::DOMAIN, Parser::NON_FLUENTS, Parser::INSTANCE,
                                        Parser::POLICY};
    return keywords.contains(type_at(tokens, index)) && type_at(tokens, index + 1) == Parser::ID;
}

}  // namespace rddlc
