#include "emit/cpp/print.hpp"

#include <gtest/gtest.h>

namespace rddlc::cpp::tree {
namespace {

const Operator plus{"+", Level::Additive, Level::Additive, Level::Multiplicative};
const Operator times{"*", Level::Multiplicative, Level::Multiplicative, Level::Unary};
const Operator both{"&&", Level::And, Level::Comparison, Level::Comparison, true};
const Operator either{"||", Level::Or, Level::Comparison, Level::Comparison, true};

Expression named(char letter, std::size_t length = 1) {
    return word(std::string(length, letter));
}

Expression operation(const Operator& op, Expression left, Expression right) {
    return {Operation{op, list(std::move(left), std::move(right))}};
}

std::string printed(Statement statement, std::size_t level = 0) {
    return print({std::move(statement)}, level);
}

TEST(Print, PutsParenthesesWhereTheTreeNeedsThem) {
    const Expression sum = operation(plus, named('a'), named('b'));
    EXPECT_EQ(printed({operation(times, sum, named('c'))}), "(a + b) * c;\n");
    EXPECT_EQ(printed({operation(plus, sum, named('c'))}), "a + b + c;\n");
    EXPECT_EQ(printed({operation(plus, named('c'), sum)}), "c + (a + b);\n");
}

TEST(Print, PutsParenthesesWhereReadersWantThem) {
    const Expression conjunction = operation(both, named('a'), named('b'));
    EXPECT_EQ(printed({operation(either, conjunction, named('c'))}), "(a && b) || c;\n");
    EXPECT_EQ(printed({operation(both, named('c'), conjunction)}), "c && a && b;\n");
}

TEST(Print, BreaksChainsBehindOperators) {
    Expression chain = named('a', 40);
    for (const char letter : {'b', 'c'}) chain = operation(plus, chain, named(letter, 40));
    const std::string first = std::string(40, 'a') + " + " + std::string(40, 'b') + " +\n";
    EXPECT_EQ(printed({Return{chain}}),
              "return " + first + "       " + std::string(40, 'c') + ";\n");
    EXPECT_EQ(printed(assign("x", chain)),
              "x =\n    " + first + "    " + std::string(40, 'c') + ";\n");
}

TEST(Print, PutsArgumentsUnderTheFirst) {
    EXPECT_EQ(printed({call("f", {named('a', 60), call("g", {named('b', 30), named('c')})})}, 1),
              "    f(" + std::string(60, 'a') + ",\n      g(" + std::string(30, 'b') + ", c));\n");
}

TEST(Print, PutsABodyIntoTheLineIfThereIsRoom) {
    const auto sum = [](std::size_t length) {
        const Expression body{Lambda{{declared("Index", "r")}, {{Return{named('x', length)}}}}};
        return assign("total", call("sum", {named('n'), body}));
    };
    EXPECT_EQ(printed(sum(3)), "total = sum(n, [&](Index r) { return xxx; });\n");
    EXPECT_EQ(printed(sum(80)),
              "total = sum(n, [&](Index r) {\n    return " + std::string(80, 'x') + ";\n});\n");
}

TEST(Print, PutsSeveralBodiesUnderEachOther) {
    const Expression long_one{Lambda{{}, {{Return{named('x', 70)}}}}};
    const Expression short_one{Lambda{{}, {{Return{named('y')}}}}};
    EXPECT_EQ(printed(assign("a", call("branch", {named('c'), long_one, short_one}))),
              "a = branch(\n    c,\n    [&] { return " + std::string(70, 'x') +
                  "; },\n    [&] { return y; });\n");
}

TEST(Print, FillsLinesWithNumbers) {
    const Expression numbers{Words{std::vector<std::string>(30, "12345")}};
    const std::string text = printed(assign("x", braces("", {numbers})));
    EXPECT_TRUE(text.starts_with("x = {\n    12345, 12345,")) << text;
    EXPECT_TRUE(text.ends_with("12345\n};\n")) << text;
    for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
        EXPECT_LE(text.find('\n', at) - at, line_width) << text;
}

TEST(Print, CutsLongTextsAtBlanks) {
    const std::string half(60, 'a');
    EXPECT_EQ(printed(assign("x", text(half + " " + half))),
              "x =\n    \"" + half + " \"\n    \"" + half + "\";\n");
}

TEST(Print, AlignsCommentsBehindMembers) {
    const Block members = {{.form = declared("Real", "x"), .remark = "first"},
                           {.form = declared("Bool", "longer"), .remark = "second"}};
    EXPECT_EQ(printed({.form = Record{"State", members}, .is_template = true}),
              "template <class L>\nstruct State {\n    Real x;       // first\n"
              "    Bool longer;  // second\n};\n");
}

TEST(Print, SeparatesDefinitionsOfSeveralLines) {
    const Statement line = assign("a", named('b'));
    const Statement function{Function{"static ", "void", "f", {declared("int", "x")}, {line}}};
    EXPECT_EQ(print({line, line, function, line}, 0),
              "a = b;\na = b;\n\nstatic void f(int x) {\n    a = b;\n}\n\na = b;\n");
}

TEST(Print, RepeatsADirectiveAboveEachLine) {
    Statement loop{For{"i", "n", {assign("a", named('b'))}}};
    loop.directive = "#line 7";
    EXPECT_EQ(printed({Function{"", "void", "f", {}, {std::move(loop)}}}),
              "void f() {\n#line 7\n    for (rddl::Index i = 0; i < n; ++i) {\n#line 7\n"
              "        a = b;\n#line 7\n    }\n#line here\n}\n");
}

}  // namespace
}  // namespace rddlc::cpp::tree
