#include "parse/distribution_names.hpp"

#include "vocabulary/vocabulary.hpp"

#include <set>
#include <string>

namespace rddlc {
namespace {

bool has_type(const TokenList& tokens, std::size_t index, std::size_t type) {
    return index < tokens.size() && tokens[index]->getType() == type;
}

// The name in front of `: { state-fluent` or `(t1, t2) : { state-fluent`.
std::string declared_before(const TokenList& tokens, std::size_t kind) {
    if (kind < 3 || !has_type(tokens, kind - 2, Parser::COLON)) return "";
    std::size_t name = kind - 3;
    if (has_type(tokens, name, Parser::CLOSE_ROUND)) {
        while (name > 0 && !has_type(tokens, name, Parser::OPEN_ROUND)) --name;
        if (name > 0) --name;
    }
    return tokens[name]->getText();
}

std::set<std::string> declared_fluents(const TokenList& tokens) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < tokens.size(); ++i)
        if (has_type(tokens, i, Parser::FLUENT_KIND)) names.insert(declared_before(tokens, i));
    return names;
}

}  // namespace

void mark_distributions(const TokenList& tokens,
                        const std::function<bool(std::string_view)>& is_distribution) {
    const std::set<std::string> fluents = declared_fluents(tokens);
    int depth = 0;
    bool in_domain = false;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (depth == 0 && has_type(tokens, i + 2, Parser::OPEN_CURLY))
            in_domain = has_type(tokens, i, Parser::DOMAIN);
        depth += has_type(tokens, i, Parser::OPEN_CURLY) - has_type(tokens, i, Parser::CLOSE_CURLY);
        const bool is_called = in_domain && has_type(tokens, i, Parser::ID) &&
                               has_type(tokens, i + 1, Parser::OPEN_ROUND);
        if (!is_called) continue;
        const std::string name = tokens[i]->getText();
        if (is_distribution(name) && !fluents.contains(name))
            static_cast<antlr4::CommonToken&>(*tokens[i]).setType(Parser::DISTRIBUTION);
    }
}

bool is_distribution_of_ours(std::string_view name) {
    const auto distribution = distribution_named(name);
    return distribution && is_extension(*distribution);
}

}  // namespace rddlc
