#include "parse/hints.hpp"

#include "parse/distribution_names.hpp"
#include "support/standard.hpp"
#include "support/suggestion.hpp"
#include "vocabulary/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace rddlc {

namespace {

std::string in_small_letters(std::string_view word) {
    std::string small(word);
    std::ranges::transform(small, small.begin(), [](unsigned char c) { return std::tolower(c); });
    return small;
}

std::vector<std::string> all_distribution_names() {
    std::vector<std::string> distributions = distribution_names();
    distributions.insert(distributions.end(), {"Discrete", "UnnormDiscrete"});
    return distributions;
}

// The distribution that another language calls by this name.
std::string distribution_meant_by(std::string_view name) {
    const std::string small = in_small_letters(name);
    if (small == "gaussian" || small == "gauss") return "Normal";
    for (const std::string& each : all_distribution_names())
        if (in_small_letters(each) == small) return each;
    return "";
}

bool is(const Token* token, std::size_t type) {
    return token != nullptr && token->getType() == type;
}

bool inside(const SyntaxError& error, std::size_t rule) {
    const antlr4::tree::ParseTree* context = error.context;
    for (; context != nullptr; context = context->parent)
        if (static_cast<const antlr4::RuleContext*>(context)->getRuleIndex() == rule) return true;
    return false;
}

Span place_of(const SyntaxError& error, const Token& token) {
    return span_of(error.file, token);
}

Span place_of_found(const SyntaxError& error) {
    return place_of(error, error.found());
}

// Other brackets for those that begin at `tokens[open]`; nothing if they are not closed.
std::vector<Replacement> other_brackets(const SyntaxError& error, std::size_t open,
                                        std::string_view opener, std::string_view closer) {
    const auto close = matching_close(error.tokens, open);
    if (!close) return {};
    return {{place_of(error, *error.tokens[open]), std::string(opener)},
            {place_of(error, *error.tokens[*close]), std::string(closer)}};
}

// Whether the text has the name only here, and so declares no such fluent.
bool occurs_once(const SyntaxError& error, const std::string& name) {
    return std::ranges::count_if(error.tokens,
                                 [&](const auto& token) { return token->getText() == name; }) == 1;
}

// f(x + 1): the parentheses were read as those of a fluent.
Hint round_brackets_of_a_function(const SyntaxError& error) {
    const auto open = innermost_open(error.tokens, error.index);
    if (!open || *open == 0 || !is(error.tokens[*open], Parser::OPEN_ROUND)) return {};
    const Token& name = *error.tokens[*open - 1];
    if (!is(&name, Parser::ID) || error.context->getRuleIndex() == Parser::RuleExpr) return {};
    if (function_named(name.getText()))
        return {fmt::format("functions take square brackets: {}[...]", name.getText()),
                other_brackets(error, *open, "[", "]")};
    if (is_distribution_of_ours(name.getText()))
        return fmt::format("the distribution '{}' is an extension; {}", name.getText(),
                           extension_hint);
    if (const std::string meant = distribution_meant_by(name.getText()); !meant.empty())
        return {fmt::format("the distribution is written {}(...)", meant),
                {{place_of(error, name), meant}}};
    if (inside(error, Parser::RuleSymbols) || inside(error, Parser::RulePvariable)) return {};
    static const TokenTypes terms = {Parser::VAR, Parser::ENUM, Parser::ID};
    if (inside(error, Parser::RuleSimpleTerm) && !terms.contains(error.found().getType())) {
        const auto near = did_you_mean(name.getText(), all_distribution_names());
        if (near && occurs_once(error, name.getText()))
            return hint_of_name(near, place_of(error, name));
        return fmt::format(
            "'{}(...)' is a fluent, and the arguments of a fluent are variables, "
            "@values and fluents, not expressions",
            name.getText());
    }
    return {};
}

Hint square_brackets_of_a_distribution(const SyntaxError& error) {
    const bool distribution =
        is(error.before(1), Parser::DISTRIBUTION) || is(error.before(1), Parser::DISCRETE);
    if (!distribution || !is(&error.found(), Parser::OPEN_SQUARE)) return {};
    return {fmt::format("distributions take round brackets: {}(...)", error.before(1)->getText()),
            other_brackets(error, error.index, "(", ")")};
}

Hint binder_form(const SyntaxError& error) {
    if (error.context->getRuleIndex() == Parser::RuleTypedVariable && error.expects(Parser::VAR) &&
        is(&error.found(), Parser::ID))
        return {fmt::format("names of variables begin with '?': ?{}", error.found().getText()),
                {{point_before(place_of_found(error)), "?"}}};
    if (error.context->getRuleIndex() == Parser::RuleTypedVariable)
        return is(&error.found(), Parser::PRIMITIVE)
                   ? "variables range over types of objects, which are declared in 'types'"
                   : "every variable needs its type, as in sum_{?x : type} ...";
    const Token* name = error.before(is(error.before(1), Parser::UNDERSCORE) ? 2 : 1);
    if (name == nullptr || !reduction_named(name->getText())) return {};
    const bool wrong = is(&error.found(), Parser::OPEN_CURLY) ||
                       error.expects(Parser::OPEN_CURLY) || error.expects(Parser::UNDERSCORE);
    if (!wrong) return {};
    const bool lacks_underscore = name == error.before(1) && is(&error.found(), Parser::OPEN_CURLY);
    return {fmt::format("write the variables and their types as in {}_{{?x : type}} ...",
                        name->getText()),
            lacks_underscore ? std::vector<Replacement>{{point_before(place_of_found(error)), "_"}}
                             : std::vector<Replacement>{}};
}

Hint single_or_double_equals(const SyntaxError& error) {
    if (is(&error.found(), Parser::ASSIGN) && inside(error, Parser::RuleCpf))
        return {"'equal' is written '=='", {{place_of_found(error), "=="}}};
    if (is(&error.found(), Parser::EQUAL) && error.expects(Parser::ASSIGN))
        return {"a definition is written with a single '='", {{place_of_found(error), "="}}};
    return {};
}

Hint operators_of_other_languages(const SyntaxError& error) {
    const std::string found = error.found().getText();
    const std::string before = error.before(1) != nullptr ? error.before(1)->getText() : "";
    const bool is_next = error.index + 1 < error.tokens.size();
    const std::string next = is_next ? error.tokens[error.index + 1]->getText() : "";
    if (found == "=" && next == "<")
        return {"'at most' is written '<='",
                {{cover(place_of_found(error), place_of(error, *error.tokens[error.index + 1])),
                  "<="}}};
    if (found == ">" && before == "=")
        return {"'at least' is written '>='",
                {{cover(place_of(error, *error.before(1)), place_of_found(error)), ">="}}};
    return {};
}

// COST-1.0 is the name COST-1 and .0.
Hint minus_in_a_name(const SyntaxError& error) {
    const Token* name = error.before(1);
    if (!is(name, Parser::ID) || !error.found().getText().starts_with('.')) return {};
    const std::string text = name->getText();
    const std::size_t minus = text.rfind('-');
    if (minus == std::string::npos || minus == 0) return {};
    const std::string meant = fmt::format("{} - {}{}", text.substr(0, minus),
                                          text.substr(minus + 1), error.found().getText());
    return {fmt::format("write '{}' with blanks: a '-' may be part of a name", meant),
            {{cover(place_of(error, *name), place_of_found(error)), meant}}};
}

// if c then a else b: from 'if' to 'then'.
std::vector<Replacement> parentheses_around_condition(const SyntaxError& error) {
    std::size_t begin = error.index;
    while (begin > 0 && !is(error.tokens[begin - 1], Parser::IF)) --begin;
    std::size_t end = error.index;
    static const TokenTypes ends = {Parser::THEN, Parser::ELSE, Parser::SEMICOLON, Parser::IF};
    while (end < error.tokens.size() && !ends.contains(error.tokens[end]->getType())) ++end;
    if (begin == 0 || end <= begin ||
        !is(error.tokens[std::min(end, error.tokens.size() - 1)], Parser::THEN))
        return {};
    return {{point_before(place_of(error, *error.tokens[begin])), "("},
            {point_behind(place_of(error, *error.tokens[end - 1])), ")"}};
}

Hint parentheses_of_if(const SyntaxError& error) {
    const bool after = is(error.before(1), Parser::IF) || is(error.before(1), Parser::SWITCH);
    const bool before_then = is(&error.found(), Parser::THEN);
    if (!after && !before_then) return {};
    return {"the condition stands in parentheses: if (c) then a else b",
            parentheses_around_condition(error)};
}

Hint else_is_compulsory(const SyntaxError& error) {
    return error.expects(Parser::ELSE) ? "an 'if' always needs both: if (c) then a else b" : Hint{};
}

Hint random_vector_is_whole(const SyntaxError& error) {
    if (!is(&error.found(), Parser::RANDOM_VECTOR)) return {};
    return fmt::format("'{}' can only be the whole right-hand side of a definition",
                       error.found().getText());
}

Hint words_of_logic(const SyntaxError& error) {
    const std::string word = error.found().getText();
    const std::string before = error.before(1) != nullptr ? error.before(1)->getText() : "";
    if (word == "and") return {"'and' is written '^'", {{place_of_found(error), "^"}}};
    if (word == "or") return {"'or' is written '|'", {{place_of_found(error), "|"}}};
    if (before == "not")
        return {"'not' is written '~'", {{place_of(error, *error.before(1)), "~"}}};
    return {};
}

Hint cpf_parameters(const SyntaxError& error) {
    const bool parameter = error.expects(Parser::VAR) && !error.expects(Parser::INT);
    if (error.context->getRuleIndex() != Parser::RuleCpf || !parameter) return {};
    if (!is(&error.found(), Parser::ID))
        return "a definition is for all objects, so its parameters are variables; distinguish "
               "objects on the right-hand side: if (?x == @a) then ...";
    // The name may be that of an object, which no expression can name, or lack its '?'.
    const std::string name = error.found().getText();
    const std::string source =
        inside(error, Parser::RulePolicy)
            ? fmt::format("the policy declares THE-ONE : {{ non-fluent, TYPE, default = {} }};",
                          name)
            : "THE-ONE is a non-fluent that the instance sets";
    return fmt::format(
        "a definition is for all objects, so its parameters are variables such as ?{0}; "
        "distinguish objects on the right-hand side: if (?{0} == THE-ONE) then ..., where {1}",
        name, source);
}

Hint separators(const SyntaxError& error) {
    if (is(&error.found(), Parser::CASE) || is(&error.found(), Parser::DEFAULT))
        if (error.expects(Parser::COMMA))
            return {"the cases of a switch are separated by commas",
                    {{point_behind(place_of(error, *error.before(1))), ","}}};
    if (is(&error.found(), Parser::COLON) && error.expects(Parser::ASSIGN))
        return {"values are given with '='", {{place_of_found(error), "="}}};
    if (is(&error.found(), Parser::ASSIGN) && error.expects(Parser::COLON))
        return {"declarations are written with ':'", {{place_of_found(error), ":"}}};
    return {};
}

Hint otherwise(const SyntaxError& error) {
    const bool found = error.found().getText() == "otherwise";
    return found ? "'otherwise' has no meaning: give every value its probability" : Hint{};
}

Hint fluent_kind(const SyntaxError& error) {
    if (!error.expects(Parser::FLUENT_KIND)) return {};
    return "write the declaration as in p(t) : { state-fluent, bool, default = false };";
}

// The words that could have stood here.
std::vector<std::string> expected_words(const SyntaxError& error) {
    std::vector<std::string> words;
    for (const std::size_t type : error.expected) {
        const std::string literal = error.vocabulary.getLiteralName(type);  // in quotes
        if (literal.size() > 3) words.push_back(literal.substr(1, literal.size() - 2));
    }
    if (error.expects(Parser::CPFS)) words.emplace_back("cpfs");
    if (error.expects(Parser::CONSTRAINTS))
        words.insert(words.end(), {"termination", "action-preconditions",
                                   "state-action-constraints", "state-invariants"});
    if (error.expects(Parser::FLUENT_KIND))
        words.insert(words.end(), {"state-fluent", "non-fluent", "action-fluent", "interm-fluent",
                                   "derived-fluent", "observ-fluent"});
    return words;
}

Hint misspelt_word(const SyntaxError& error) {
    if (!is(&error.found(), Parser::ID) && !is(&error.found(), Parser::FLUENT_KIND)) return {};
    return hint_of_name(did_you_mean(error.found().getText(), expected_words(error)),
                        place_of_found(error));
}

// rddlsim writes "$s1" for an object; in RDDL of pyRDDLGym '$' calls an external function.
Hint object_with_dollar(const SyntaxError& error) {
    const bool is_found = is(&error.found(), Parser::DOLLAR);
    const bool is_before = is(error.before(2), Parser::DOLLAR) && is(error.before(1), Parser::ID) &&
                           error.expects(Parser::OPEN_SQUARE);
    if (!is_found && !is_before) return {};
    if (inside(error, Parser::RuleInstance) || inside(error, Parser::RuleNonFluents))
        return {"objects are written without '$'",
                {{place_of(error, is_found ? error.found() : *error.before(2)), ""}}};
    return "objects have no '$', and the domain cannot name objects of the instance: use a "
           "non-fluent that the instance sets for this object, or make its type a list of values "
           "{@a, @b}";
}

Hint case_of_a_number(const SyntaxError& error) {
    static const TokenTypes others = {Parser::INT,   Parser::REAL, Parser::BOOLEAN,
                                      Parser::MINUS, Parser::NOT,  Parser::OPEN_ROUND};
    if (!is(error.before(1), Parser::CASE) || !others.contains(error.found().getType())) return {};
    return "'switch' is for values of an enumerated type: 'case @a'; for numbers and bools write "
           "'if (x == 0) then ... else if ...'";
}

struct SectionMeant {
    std::string_view word, section;
};

// Names of a domain's sections in other readers and common language.
constexpr std::array sections_meant = {
    SectionMeant{"terminal", "termination"},
    SectionMeant{"terminals", "termination"},
    SectionMeant{"terminate", "termination"},
    SectionMeant{"terminate-when", "termination"},
    SectionMeant{"termination-conditions", "termination"},
    SectionMeant{"goal", "termination"},
    SectionMeant{"done", "termination"},
    SectionMeant{"preconditions", "action-preconditions"},
    SectionMeant{"action-constraints", "action-preconditions"},
    SectionMeant{"invariants", "state-invariants"},
    SectionMeant{"state-constraints", "state-invariants"},
};

Hint section_of_conditions(const SyntaxError& error) {
    constexpr std::string_view form = "write '{} {{ condition; ... }};'";
    if (is(error.before(1), Parser::CONSTRAINTS) && error.expects(Parser::OPEN_CURLY))
        return fmt::format(form, error.before(1)->getText());
    if (!error.expects(Parser::CONSTRAINTS)) return {};
    const std::string word = error.found().getText();
    const auto meant = std::ranges::find(sections_meant, word, &SectionMeant::word);
    if (meant == sections_meant.end()) return {};
    return {fmt::format(form, meant->section),
            {{place_of_found(error), std::string(meant->section)}}};
}

Hint type_form(const SyntaxError& error) {
    if (error.expects(Parser::OBJECT)) return "a type is an 'object' or a list of values {@a, @b}";
    const bool value = error.expects(Parser::ENUM) && !error.expects(Parser::ID);
    if (!value || !is(&error.found(), Parser::ID)) return {};
    return {fmt::format("values are written with '@': @{}", error.found().getText()),
            {{point_before(place_of_found(error)), "@"}}};
}

}  // namespace

Hint hint_for(const SyntaxError& error) {
    constexpr std::array guesses = {
        object_with_dollar,
        case_of_a_number,
        section_of_conditions,
        round_brackets_of_a_function,
        square_brackets_of_a_distribution,
        binder_form,
        operators_of_other_languages,
        single_or_double_equals,
        minus_in_a_name,
        else_is_compulsory,
        parentheses_of_if,
        random_vector_is_whole,
        words_of_logic,
        cpf_parameters,
        separators,
        otherwise,
        misspelt_word,
        fluent_kind,
        type_form,
    };
    for (const auto guess : guesses)
        if (Hint hint = guess(error); !hint.text.empty()) return hint;
    return {};
}

}  // namespace rddlc
