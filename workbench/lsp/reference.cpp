#include "lsp/reference.hpp"

#include "driver/explain.hpp"
#include "vocabulary/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace rddlc::lsp {

namespace {

struct Keyword {
    std::string_view word;
    std::string_view sentence;
    std::array<std::string_view, 2> rules = {};  // of docs/semantics.md
};

constexpr Keyword keywords[] = {
    {"domain",
     "A block that declares types and fluents, and says how they change and what is rewarded.",
     {"4.1"}},
    {"non-fluents",
     "A block, or a section of an instance, with the values that do not change in an episode.",
     {"4.1", "4.3"}},
    {"instance",
     "A block with the objects, the initial state, the horizon and the discount of one problem.",
     {"4.1", "4.8"}},
    {"policy", "A block that chooses the actions.", {"9.1"}},
    {"requirements", "Parts of the language that the domain says it uses.", {"4.9"}},
    {"types", "The section that declares types of objects and enumerated types.", {"4.2"}},
    {"pvariables", "The section that declares the fluents.", {"4.4"}},
    {"cpfs", "The section that defines next values, interm- and observ-fluents.", {"4.4", "4.6"}},
    {"cdfs", "The same as `cpfs`.", {"4.4", "4.6"}},
    {"reward", "The reward of a step.", {"4.5", "8.2"}},
    {"termination", "Conditions that end an episode; any one is enough.", {"8.2"}},
    {"action-preconditions", "Conditions that legal actions satisfy.", {"8.2", "8.4"}},
    {"state-invariants",
     "Conditions that all states satisfy; an episode is truncated where one does not hold.",
     {"8.2", "8.4"}},
    {"state-action-constraints", "Conditions that nothing enforces.", {"4.9"}},
    {"objects", "The objects of each type, in order.", {"4.2"}},
    {"init-state",
     "The values of state-fluents before the first step, where they differ from the default.",
     {"4.3", "8.1"}},
    {"max-nondef-actions",
     "The number of actions that may differ from their defaults in one step.",
     {"8.2"}},
    {"horizon", "The number of steps after which an episode is truncated.", {"4.8", "8.2"}},
    {"discount", "How much a reward counts one step later.", {"4.8"}},
    {"non-fluent", "A constant of the instance.", {"4.3"}},
    {"state-fluent",
     "A part of the state. Its next value is written with an apostrophe: `p'`.",
     {"4.4", "4.5"}},
    {"action-fluent", "A value that the agent chooses in each step.", {"3.7", "8.2"}},
    {"interm-fluent", "A value that is computed within a step.", {"4.5"}},
    {"derived-fluent", "A value that is computed within a step, from the state.", {"4.5"}},
    {"observ-fluent",
     "A value that the agent sees. If there are some, it does not see the state.",
     {"8.3"}},
    {"param-fluent", "A constant of a policy that is meant to be varied.", {"9.1"}},
    {"bool", "`true` or `false`; 1 or 0 where a number is needed.", {"5.1", "5.4"}},
    {"int", "A whole number of 64 bits.", {"5.1", "5.5"}},
    {"real", "A number with a point, an IEEE double.", {"5.1", "5.5"}},
    {"object", "A type whose objects the instance lists.", {"4.2", "4.7"}},
    {"default",
     "The value of all groundings to which the instance gives no other; or the case of a `switch` "
     "for all other labels.",
     {"4.3", "6.4"}},
    {"level", "Ignored.", {"4.9"}},
    {"if", "`if (condition) then a else b`", {"3.5", "6.4"}},
    {"then", "`if (condition) then a else b`", {"3.5", "6.4"}},
    {"else", "`if (condition) then a else b`", {"3.5", "6.4"}},
    {"switch", "`switch (p(?x)) { case @a : 1, default : 0 }`", {"6.4"}},
    {"case", "`switch (p(?x)) { case @a : 1, default : 0 }`", {"6.4"}},
    {"Discrete", "`Discrete(type, @a : 0.3, @b : 0.7)`", {"7.5"}},
    {"UnnormDiscrete", "`UnnormDiscrete(type, @a : 3, @b : 7)`", {"7.5"}},
    {"MultivariateNormal", "`MultivariateNormal[?x](mean(_), covariance(_, _))`", {"7.1"}},
    {"MultivariateStudent",
     "`MultivariateStudent[?x](mean(_), covariance(_, _), degrees)`",
     {"7.1"}},
    {"Dirichlet", "`Dirichlet[?x](weights(_))`", {"7.1"}},
    {"Multinomial", "`Multinomial[?x](trials, probabilities(_))`", {"7.1"}},
    {"det", "`det_{?r : t1, ?c : t2} element(?r, ?c)`", {"7.2"}},
    {"inverse", "`inverse[row = ?r, col = ?c][element(?r, ?c)]`", {"7.2"}},
    {"pinverse", "`pinverse[row = ?r, col = ?c][element(?r, ?c)]`", {"7.2"}},
    {"cholesky", "`cholesky[row = ?r, col = ?c][element(?r, ?c)]`", {"7.2"}},
    {"pos-inf", "No limit.", {"4.8"}},
};

std::string with_rules(std::string text, const std::array<std::string_view, 2>& numbers) {
    for (const std::string_view number : numbers)
        if (!number.empty()) text += fmt::format("\n\n{}", rule(number));
    return text;
}

// The cells of the row of a table that begins with "| `Name(".
std::vector<std::string> row_of_distribution(std::string_view name) {
    const std::string begin = fmt::format("| `{}(", name);
    const std::size_t at = pages::distributions.find(begin);
    if (at == std::string_view::npos) return {};
    std::string_view line = pages::distributions.substr(at);
    line = line.substr(0, line.find('\n'));
    std::vector<std::string> cells;
    for (line.remove_prefix(1); !line.empty();) {
        const std::size_t end = std::min(line.find('|'), line.size());
        cells.emplace_back(line.substr(0, end));
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return cells;
}

std::string explanation_of_distribution(Distribution distribution) {
    std::string text = in_code(form_of(distribution));
    const std::vector<std::string> cells = row_of_distribution(name_of(distribution));
    if (cells.size() < 4) return text;
    return text + fmt::format("\n\n{}; must hold: {}", cells[1], cells[3]);
}

}  // namespace

std::string in_code(std::string_view rddl) {
    return fmt::format("```rddl\n{}\n```", rddl);
}

std::string_view rule(std::string_view number) {
    const std::size_t at = pages::semantics.find(fmt::format("**{}**", number));
    if (at == std::string_view::npos) return {};
    const std::string_view text = pages::semantics.substr(at);
    return text.substr(0, std::min(text.find("\n\n**"), text.find("\n\n## ")));
}

std::string explanation_of(std::string_view word) {
    for (const Keyword& keyword : keywords)
        if (keyword.word == word)
            return with_rules(fmt::format("**{}**: {}", word, keyword.sentence), keyword.rules);
    if (const auto distribution = distribution_named(word))
        return explanation_of_distribution(*distribution);
    if (const auto function = function_named(word))
        return in_code(form_of(*function)) +
               (is_extension(*function) ? "\n\nOnly with `--std=rddlc`." : "");
    if (reduction_named(word))
        return with_rules(in_code(fmt::format("{}_{{?x : type}} expression", word)),
                          {"6.5", "3.3"});
    return "";
}

std::string explanation_of(Code code) {
    const auto page = explain(code);
    if (!page) return "";
    const std::size_t end = page->find("\nFor example");
    return fmt::format("{}\n\n`rddl --explain {}` has examples.",
                       page->substr(0, std::min(end, page->size())), to_string(code));
}

std::vector<std::string_view> explained_keywords() {
    std::vector<std::string_view> words;
    for (const Keyword& keyword : keywords) words.push_back(keyword.word);
    return words;
}

}  // namespace rddlc::lsp
