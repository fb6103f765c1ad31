// Names of distributions that pyRDDLGym does not have are not reserved.
#include "parse/distribution_names.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rddlc {
namespace {

constexpr std::size_t name_token = Parser::ID, distribution = Parser::DISTRIBUTION;

// The types of the tokens "Made", in their order, where Made is a distribution of ours.
std::vector<std::size_t> types_of_made(const std::string& text) {
    antlr4::ANTLRInputStream characters(text);
    grammar::RDDLLexer lexer(&characters);
    TokenList tokens;
    do tokens.push_back(lexer.nextToken());
    while (tokens.back()->getType() != Token::EOF);
    mark_distributions(tokens, [](std::string_view name) { return name == "Made"; });
    std::vector<std::size_t> types;
    for (const auto& token : tokens)
        if (token->getText() == "Made") types.push_back(token->getType());
    return types;
}
using Types = std::vector<std::size_t>;

TEST(DistributionNames, AreWordsBeforeParentheses) {
    EXPECT_EQ(types_of_made("domain d { cpfs { x' = Made(0, 1) + Made; }; reward = Made[1]; }"),
              (Types{distribution, name_token, name_token}));
}

TEST(DistributionNames, AreNamesWhereAFluentHasThem) {
    EXPECT_EQ(types_of_made("domain d { pvariables { Made(t, t) : { state-fluent, real }; };"
                            " reward = Made(?x, ?y); }"),
              (Types{name_token, name_token}));
    EXPECT_EQ(types_of_made("domain d { pvariables { Made : { non-fluent, real }; };"
                            " reward = Made(); }"),
              (Types{name_token, name_token}));
}

TEST(DistributionNames, AreNamesOfTypesAndObjects) {
    EXPECT_EQ(types_of_made("domain d { types { Made : object; }; pvariables { p(Made) : "
                            "{ state-fluent, bool }; }; }"),
              (Types{name_token, name_token}));
    EXPECT_EQ(types_of_made("instance i { objects { t : {Made}; }; init-state { p(Made); }; }"),
              (Types{name_token, name_token}));
}

TEST(DistributionNames, AreNamesOutsideOfTheDomain) {
    const std::string domain = "domain d { reward = Made(1); }";
    EXPECT_EQ(types_of_made(domain + "non-fluents n { non-fluents { Made(a) = 1; }; }"),
              (Types{distribution, name_token}));
    EXPECT_EQ(types_of_made(domain + "policy p { cpfs { a = Made(?x); }; }"),
              (Types{distribution, name_token}));
}

}  // namespace
}  // namespace rddlc
