#include "parse/recovery.hpp"

#include <algorithm>

namespace rddlc {

using antlr4::atn::ATNState;

namespace {

TokenTypes to_set(const antlr4::misc::IntervalSet& intervals) {
    TokenTypes types;
    for (const ssize_t type : intervals.toList())
        if (type != static_cast<ssize_t>(Token::EPSILON))
            types.insert(static_cast<std::size_t>(type));
    return types;
}

ATNState& current_state(antlr4::Parser& parser) {
    return *parser.getATN().states[parser.getState()];
}

// The tokens that could have come instead. If the parser looked further than one token, these are
// the tokens that its last configurations were waiting for.
TokenTypes expected_by(const antlr4::RecognitionException& error) {
    const auto* choice = dynamic_cast<const antlr4::NoViableAltException*>(&error);
    const bool looked_ahead = choice != nullptr && choice->getDeadEndConfigs() != nullptr &&
                              choice->getStartToken() != choice->getOffendingToken();
    if (!looked_ahead) return to_set(error.getExpectedTokens());
    const auto* parser = static_cast<antlr4::Parser*>(error.getRecognizer());
    TokenTypes types;
    for (const auto& configuration : choice->getDeadEndConfigs()->configs)
        types.merge(to_set(parser->getATN().nextTokens(configuration->state)));
    return types;
}

bool is_section(std::size_t rule) {
    return rule == Parser::RuleDomainSection || rule == Parser::RulePolicySection ||
           rule == Parser::RuleInstanceSection || rule == Parser::RuleNonFluentsSection;
}

bool is_block(std::size_t rule) {
    return rule == Parser::RuleDomain || rule == Parser::RuleInstance ||
           rule == Parser::RuleNonFluents || rule == Parser::RulePolicy;
}

bool is_item(std::size_t rule) {
    return rule == Parser::RuleTypeDeclaration || rule == Parser::RulePvariable ||
           rule == Parser::RuleCpf || rule == Parser::RuleCondition ||
           rule == Parser::RuleObjectList || rule == Parser::RuleAssignment;
}

// A loop over the items of a section, the sections of a block or the blocks of the file.
bool is_loop(ATNState& state, std::size_t rule) {
    const auto type = state.getStateType();
    return (is_section(rule) || is_block(rule) || rule == Parser::RuleText) &&
           (type == ATNState::STAR_LOOP_ENTRY || type == ATNState::STAR_LOOP_BACK);
}

}  // namespace

ErrorStrategy::ErrorStrategy(FileId file, std::vector<Token*> tokens, std::size_t limit,
                             Diagnostics& diagnostics)
    : file_(file), tokens_(std::move(tokens)), limit_(limit), diagnostics_(diagnostics) {
    for (const Diagnostic& diagnostic : diagnostics.all())
        if (diagnostic.span && diagnostic.span->file == file)
            lexical_errors_.push_back(*diagnostic.span);
}

void ErrorStrategy::reset(antlr4::Parser*) {
    recovering_ = false;
}

bool ErrorStrategy::inErrorRecoveryMode(antlr4::Parser*) {
    return recovering_;
}

void ErrorStrategy::reportMatch(antlr4::Parser*) {
    recovering_ = false;
}

void ErrorStrategy::reportError(antlr4::Parser* parser, const antlr4::RecognitionException& error) {
    if (!recovering_)
        report(*parser, error.getOffendingToken()->getTokenIndex(), expected_by(error));
}

// ---------------------------------------------------------------------------------- reporting

void ErrorStrategy::report(antlr4::Parser& parser, std::size_t index, TokenTypes expected) {
    recovering_ = true;
    if (follows_lexical_error(index)) return;
    diagnostics_.report(describe(
        {file_, tokens_, index, std::move(expected), parser.getContext(), parser.getVocabulary()}));
    if (++reported_ == limit_) throw antlr4::ParseCancellationException();
}

// If characters were dropped before a token, the token is not the cause.
bool ErrorStrategy::follows_lexical_error(std::size_t index) const {
    const std::uint32_t begin = index == 0 ? 0 : span_of(file_, *tokens_[index - 1]).begin;
    const std::uint32_t end = span_of(file_, *tokens_[index]).end;
    return std::any_of(lexical_errors_.begin(), lexical_errors_.end(),
                       [&](Span span) { return begin <= span.begin && span.end <= end; });
}

// -------------------------------------------------------------------------- a token that lacks

// A missing ';' or '}' is put in where an item, section or block clearly ends, and a missing name
// before a block's '{'. Nothing else: one error an item is enough.
Token* ErrorStrategy::recoverInline(antlr4::Parser* parser) {
    const TokenTypes expected = to_set(parser->getExpectedTokens());
    const Token& found = *parser->getCurrentToken();
    if (expected.size() == 1 && may_insert(*parser, *expected.begin())) {
        if (!recovering_) report(*parser, found.getTokenIndex(), expected);
        return conjure(*expected.begin(), found);
    }
    throw antlr4::InputMismatchException(parser);
}

bool ErrorStrategy::may_insert(antlr4::Parser& parser, std::size_t missing) const {
    const std::size_t index = parser.getCurrentToken()->getTokenIndex();
    const bool ends_section = missing == Parser::CLOSE_CURLY || missing == Parser::SEMICOLON;
    if (ends_section && (begins_section(tokens_, index) || begins_block(tokens_, index) ||
                         type_at(tokens_, index) == Token::EOF))
        return true;
    if (missing == Parser::SEMICOLON)
        return begins_line(tokens_, index) || type_at(tokens_, index) == Parser::CLOSE_CURLY;
    return missing == Parser::ID && type_at(tokens_, index) == Parser::OPEN_CURLY &&
           is_block(parser.getContext()->getRuleIndex());
}

Token* ErrorStrategy::conjure(std::size_t type, const Token& at) {
    auto token = std::make_unique<antlr4::CommonToken>(type, "");
    token->setLine(at.getLine());
    token->setStartIndex(at.getStartIndex());
    token->setStopIndex(at.getStartIndex());
    token->setTokenIndex(at.getTokenIndex());
    conjured_.push_back(std::move(token));
    return conjured_.back().get();
}

// ---------------------------------------------------------------------- a token that is too much

// Runs before each choice. Tokens that do not fit a loop are skipped here, so that the loop
// continues.
void ErrorStrategy::sync(antlr4::Parser* parser) {
    ATNState& state = current_state(*parser);
    const auto& next = parser->getATN().nextTokens(&state);
    const std::size_t found = parser->getCurrentToken()->getType();
    if (next.contains(found) || next.contains(Token::EPSILON)) return;
    if (!is_loop(state, parser->getContext()->getRuleIndex()))
        throw antlr4::InputMismatchException(parser);
    const TokenTypes expected = to_set(next);
    // Text between blocks that follows an error probably belongs to a block that ended too early.
    const bool doubtful = reported_ > 0 && parser->getContext()->getRuleIndex() == Parser::RuleText;
    if (!recovering_ && !doubtful)
        report(*parser, parser->getCurrentToken()->getTokenIndex(), expected);
    skip_to_loop(*parser, expected);
}

// An item, section or block with an error is given up; errors inside expressions go up to it.
void ErrorStrategy::recover(antlr4::Parser* parser, std::exception_ptr error) {
    const std::size_t rule = parser->getContext()->getRuleIndex();
    const std::size_t begin = parser->getContext()->getStart()->getTokenIndex();
    if (is_item(rule))
        skip_item(*parser, begin, true);
    else if (is_section(rule) || is_block(rule))
        skip_item(*parser, begin, false);
    else if (rule != Parser::RuleText)
        std::rethrow_exception(error);
}

// Skips to behind the ';' that ends what began at token `begin`, or to the '}' around it.
void ErrorStrategy::skip_item(antlr4::Parser& parser, std::size_t begin,
                              bool nested_semicolons_end) {
    std::size_t depth = 0;
    const auto descend = [&](std::size_t type) {
        if (type == Parser::OPEN_CURLY) ++depth;
        if (type == Parser::CLOSE_CURLY && depth > 0) --depth;
    };
    std::size_t index = parser.getCurrentToken()->getTokenIndex();
    for (std::size_t i = begin; i < index; ++i) descend(type_at(tokens_, i));
    while (type_at(tokens_, index) != Token::EOF) {
        const std::size_t type = type_at(tokens_, index);
        const bool outside = depth == 0 || nested_semicolons_end;
        if (type == Parser::CLOSE_CURLY && depth == 0) return;
        if (index > begin && (begins_section(tokens_, index) || begins_block(tokens_, index)))
            return;
        descend(type);
        parser.consume();
        ++index;
        if (type == Parser::SEMICOLON && outside) return;
    }
}

// Skips to where the loop over items or sections can continue. If a section or block begins before
// that, a '}' is missing: the loop ends.
void ErrorStrategy::skip_to_loop(antlr4::Parser& parser, const TokenTypes& next) {
    const bool items = is_section(parser.getContext()->getRuleIndex());
    while (true) {
        const std::size_t index = parser.getCurrentToken()->getTokenIndex();
        const std::size_t type = type_at(tokens_, index);
        // 'domain = d;' is of a block whose keyword was not known.
        const bool is_of_unknown = parser.getContext()->getRuleIndex() == Parser::RuleText &&
                                   type_at(tokens_, index + 1) == Parser::ASSIGN;
        const bool fits = next.contains(type) && !is_of_unknown;
        if (type == Token::EOF || fits) return;
        if (begins_block(tokens_, index) || (items && begins_section(tokens_, index))) return;
        const std::size_t before = index;
        skip_item(parser, index, items);
        if (parser.getCurrentToken()->getTokenIndex() == before) parser.consume();
    }
}

}  // namespace rddlc
