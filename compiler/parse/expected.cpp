#include "parse/expected.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc {

namespace {

// A group of tokens with one name. It stands for them where all of them are expected.
struct Group {
    TokenTypes types;
    std::string_view words;
};

// Larger groups first: what a group explains is not explained again.
const std::vector<Group>& groups() {
    static const std::vector<Group> all = {
        {{Parser::BOOLEAN,      Parser::INT,      Parser::REAL,       Parser::VAR,
          Parser::ENUM,         Parser::ID,       Parser::OPEN_ROUND, Parser::OPEN_SQUARE,
          Parser::DISTRIBUTION, Parser::DISCRETE, Parser::MATRIX,     Parser::NOT,
          Parser::MINUS,        Parser::PLUS,     Parser::IF,         Parser::QUANTIFIER,
          Parser::ARGUMENT_OF,  Parser::SWITCH,   Parser::DET,        Parser::DOLLAR,
          Parser::RANDOM_VECTOR},
         "an expression"},
        {{Parser::BOOLEAN,      Parser::INT,      Parser::REAL,       Parser::VAR,
          Parser::ENUM,         Parser::ID,       Parser::OPEN_ROUND, Parser::OPEN_SQUARE,
          Parser::DISTRIBUTION, Parser::DISCRETE, Parser::MATRIX,     Parser::NOT,
          Parser::MINUS,        Parser::PLUS,     Parser::IF,         Parser::QUANTIFIER,
          Parser::ARGUMENT_OF,  Parser::SWITCH,   Parser::DET,        Parser::DOLLAR},
         "an expression"},
        {{Parser::TIMES, Parser::DIVIDE, Parser::PLUS, Parser::MINUS, Parser::EQUAL,
          Parser::NOT_EQUAL, Parser::LESS, Parser::LESS_EQUAL, Parser::GREATER,
          Parser::GREATER_EQUAL, Parser::AND, Parser::AMPERSAND, Parser::OR, Parser::IMPLIES,
          Parser::EQUIVALENT},
         "an operator"},
        {{Parser::DOMAIN, Parser::NON_FLUENTS, Parser::INSTANCE, Parser::POLICY},
         "a block ('domain', 'non-fluents' or 'instance')"},
        {{Parser::REQUIREMENTS, Parser::TYPES, Parser::PVARIABLES, Parser::CPFS, Parser::REWARD,
          Parser::CONSTRAINTS},
         "a section of the domain ('types', 'pvariables', 'cpfs', 'reward', ...)"},
        {{Parser::DOMAIN, Parser::OBJECTS, Parser::NON_FLUENTS, Parser::INIT_STATE,
          Parser::MAX_NONDEF_ACTIONS, Parser::HORIZON, Parser::DISCOUNT},
         "a section of the instance ('objects', 'init-state', 'horizon', ...)"},
        {{Parser::DOMAIN, Parser::OBJECTS, Parser::NON_FLUENTS},
         "'domain', 'objects' or 'non-fluents'"},
        // An instance may also hold a distribution, but that is seldom what is missing.
        {{Parser::BOOLEAN, Parser::INT, Parser::REAL, Parser::MINUS, Parser::POS_INF,
          Parser::NEG_INF, Parser::ID, Parser::ENUM, Parser::DISTRIBUTION, Parser::DISCRETE},
         "a constant"},
        {{Parser::BOOLEAN, Parser::INT, Parser::REAL, Parser::MINUS, Parser::POS_INF,
          Parser::NEG_INF, Parser::ID, Parser::ENUM},
         "a constant"},
        {{Parser::VAR, Parser::ENUM, Parser::ID, Parser::ARGUMENT_OF, Parser::DISCRETE},
         "an argument (a variable, a value or a fluent)"},
        {{Parser::VAR, Parser::ENUM, Parser::UNDERSCORE}, "a variable, a value or '_'"},
        {{Parser::ID, Parser::ENUM}, "an object or value"},
        {{Parser::ID, Parser::PRIMITIVE}, "a type"},
        {{Parser::INT, Parser::REAL}, "a number"},
        {{Parser::VAR}, "a variable such as ?x"},
        {{Parser::ENUM}, "a value such as @a"},
        {{Parser::ID}, "a name"},
        {{Parser::INT}, "an integer"},
        {{Parser::REAL}, "a number with a point"},
        {{Parser::FLUENT_KIND}, "a kind of fluent ('state-fluent', 'non-fluent', ...)"},
    };
    return all;
}

// "a, b or c"
std::string alternatives(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

bool ends_operand(const Token* token) {
    static const TokenTypes ends = {Parser::ID,          Parser::VAR,         Parser::ENUM,
                                    Parser::INT,         Parser::REAL,        Parser::BOOLEAN,
                                    Parser::CLOSE_ROUND, Parser::CLOSE_SQUARE};
    return token != nullptr && ends.contains(token->getType());
}

// An operator is always possible between an operand and the token that must follow it; the user may
// still want one where the parser no longer expects it.
bool operator_possible(const SyntaxError& error) {
    static const TokenTypes follows = {Parser::SEMICOLON, Parser::CLOSE_ROUND, Parser::CLOSE_SQUARE,
                                       Parser::THEN, Parser::ELSE};
    const std::size_t rule = error.context->getRuleIndex();
    const bool holds_expression =
        rule == Parser::RuleExpr || rule == Parser::RuleCondition ||
        rule == Parser::RuleTerminateWhen ||
        (rule == Parser::RuleCpf && error.expects(Parser::SEMICOLON)) ||
        dynamic_cast<const Parser::RewardContext*>(error.context) != nullptr;
    return holds_expression && ends_operand(error.before(1)) &&
           std::any_of(error.expected.begin(), error.expected.end(),
                       [](std::size_t type) { return follows.contains(type); });
}

}  // namespace

std::string describe_expected(const SyntaxError& error) {
    TokenTypes left = error.expected;
    std::vector<std::string> words;
    bool names_operator = false;
    for (const Group& group : groups()) {
        if (!std::includes(left.begin(), left.end(), group.types.begin(), group.types.end()))
            continue;
        for (const std::size_t type : group.types) left.erase(type);
        words.emplace_back(group.words);
        names_operator |= group.words == "an operator";
    }
    for (const std::size_t type : left)
        words.push_back(type == Token::EOF ? "the end of the file"
                                           : error.vocabulary.getDisplayName(type));
    if (!names_operator && operator_possible(error)) words.emplace_back("an operator");
    return alternatives(words);
}

bool is_reserved_word(const Token& token) {
    static const TokenTypes names = {Parser::ID, Parser::VAR, Parser::ENUM};
    const std::string text = token.getText();
    const bool word =
        !text.empty() && ((text[0] >= 'a' && text[0] <= 'z') || (text[0] >= 'A' && text[0] <= 'Z'));
    return word && token.getType() != Token::EOF && !names.contains(token.getType());
}

std::string describe_found(const Token& token) {
    constexpr std::size_t longest = 40;
    if (token.getType() == Token::EOF) return "the end of the file";
    std::string text = token.getText();
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    return fmt::format("'{}'", text);
}

}  // namespace rddlc
