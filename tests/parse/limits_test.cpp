// The limits of size and depth: at the limit all works, behind it there is one message.
#include "parse/limits.hpp"

#include "ast/equal.hpp"
#include "ast/print.hpp"
#include "parsed.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

std::string repeated(std::string_view text, std::size_t times) {
    std::string result;
    for (std::size_t i = 0; i < times; ++i) result += text;
    return result;
}

// Everything that recurses on the tree, as deep as is allowed.
void expect_accepted(const std::string& expression) {
    const Parsed parsed = parse_reward(expression);
    ASSERT_FALSE(parsed.diagnostics.has_errors()) << parsed.report();
    const ast::Program copy = parsed.program;
    EXPECT_TRUE(ast::equal(parsed.program, copy));
    const Parsed again = parse_text(ast::print(parsed.program));
    EXPECT_FALSE(again.diagnostics.has_errors()) << again.report();
    EXPECT_TRUE(ast::equal(parsed.program, again.program));
}

TEST(Limits, AcceptWhatIsJustInside) {
    expect_accepted(repeated("a + ", max_depth) + "a");
    expect_accepted(repeated("~", max_depth) + "a");
    expect_accepted(repeated("- ", max_depth) + "a");
    expect_accepted(repeated("if (a) then b else ", max_depth - 1) + "c");
    expect_accepted(repeated("forall_{?x : t} ", max_depth - 1) + "a");
    const std::size_t inner = max_nesting - 1;  // the domain's own bracket is one
    expect_accepted(repeated("(", inner) + "a" + repeated(" + a)", inner) +
                    repeated(" + a", max_depth - 2 * inner));
    expect_accepted(repeated("p(", inner) + "a" + repeated(")", inner));
    expect_accepted(repeated("f[", inner) + "a" + repeated("]", inner));
    expect_accepted(repeated("switch (a) { case @b : ", inner) + "a" + repeated(" }", inner));
    expect_accepted(repeated("if (", inner) + "a" + repeated(") then b else c", inner));
}

TEST(Limits, DoNotAddUpWhatStandsSideBySide) {
    std::string list = "a";
    for (int i = 0; i < 20; ++i) list += ", " + repeated("a * ", 200) + "a";
    expect_accepted("f[" + list + "]");
    EXPECT_EQ(
        parse_text("domain d { cpfs { " + repeated("x' = a + b * c; ", 2000) + "}; }").codes(), "");
}

TEST(Limits, RefuseDeepExpressions) {
    EXPECT_EQ(parse_reward(repeated("a + ", max_depth + 1) + "a").codes(), "E0116");
    EXPECT_EQ(parse_reward(repeated("~", max_depth + 1) + "a").codes(), "E0116");
    EXPECT_EQ(parse_reward(repeated("if (a) then b else ", max_depth + 1) + "c").codes(), "E0116");
    EXPECT_EQ(parse_reward(repeated("(", 201) + "a" + repeated(" + a + a + a + a)", 201)).codes(),
              "E0116");
    EXPECT_EQ(
        parse_reward(repeated("(", 200) + repeated("a + ", 900) + "a" + repeated(")", 200)).codes(),
        "E0116");
}

TEST(Limits, RefuseDeepNesting) {
    for (const char* bracket : {"(", "[", "{", "f[", "p(", "switch (a) { case @b : "})
        EXPECT_EQ(parse_reward(repeated(bracket, max_nesting)).codes(), "E0115") << bracket;
}

TEST(Limits, PointAtTheExpression) {
    const Parsed parsed = parse_text(
        "domain d {\n  // first\n  reward = " + repeated("a + ", max_depth + 1) + "a; }");
    EXPECT_EQ(parsed.sources.location(*parsed.diagnostics.all().at(0).span), "test.rddl:3:3");
}

TEST(Limits, IgnoreComments) {
    EXPECT_EQ(parse_text("// " + repeated("(~", 5000) + "\ndomain d { }").codes(), "");
}

// Ten megabytes of each, in a moment and without the memory for a token each.
TEST(Limits, EndGarbageQuickly) {
    constexpr std::size_t size = 10'000'000;
    const std::string begin = "domain d { reward = ";
    for (const char* unit : {"(", "[", "{", ")", "~", "- ", "if(a)then ", "if(a)then b else ", "a+",
                             ";", "!", ",", "forall_{?x:t}", "\x80"}) {
        const std::string text = begin + repeated(unit, size / std::string_view(unit).size());
        const Parsed parsed = parse_text(text);
        EXPECT_TRUE(parsed.diagnostics.has_errors()) << unit;
        EXPECT_LT(parsed.report().size(), 20'000u) << unit;
    }
}

TEST(Limits, RefuseLargeFiles) {
    EXPECT_EQ(parse_text(std::string(max_bytes + 1, ' ')).codes(), "E0117");
    EXPECT_EQ(parse_text(repeated(";", max_tokens + 1)).codes(), "E0117");
}

}  // namespace
}  // namespace rddlc
