// Precedence and association, by the shape of the tree: every operator in brackets.
#include "ast/print.hpp"
#include "parsed.hpp"
#include "support/match.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rddlc {
namespace {

// "(a + (b * c))"; expressions other than operators are printed as they were written.
std::string shape(const ast::Expr& expr) {
    return match(
        expr.node,
        [](const ast::Binary& b) {
            ast::Binary leaves = b;
            leaves.left = ast::Expr{ast::Variable{"l"}, {}};
            leaves.right = ast::Expr{ast::Variable{"r"}, {}};
            const std::string text = ast::print(ast::Expr{leaves, {}});
            return "(" + shape(*b.left) + text.substr(2, text.size() - 4) + shape(*b.right) + ")";
        },
        [](const ast::Unary& u) {
            const char* mark = u.op == ast::UnaryOperator::Not     ? "~"
                               : u.op == ast::UnaryOperator::Minus ? "-"
                                                                   : "+";
            return "(" + std::string(mark) + shape(*u.operand) + ")";
        },
        [](const ast::Group& g) { return shape(*g.inner); },
        [](const ast::If& i) {
            return "(if " + shape(*i.condition) + " then " + shape(*i.then_branch) + " else " +
                   shape(*i.else_branch) + ")";
        },
        [](const ast::Aggregation& a) { return "(" + a.op.text + "_ " + shape(*a.body) + ")"; },
        [](const ast::DiscreteOver& d) {
            return "(" + d.name.text + "_ " + shape(*d.weight) + ")";
        },
        [](const ast::Determinant& d) { return "(det_ " + shape(*d.element) + ")"; },
        [&](const auto&) { return ast::print(expr); });
}

const ast::Expr& reward_of(const Parsed& parsed) {
    const auto& domain = std::get<ast::Domain>(parsed.program.blocks.at(0));
    return std::get<ast::Reward>(domain.sections.at(0).node).value;
}

std::string shape_of(const std::string& expression) {
    const Parsed parsed = parse_reward(expression);
    return parsed.diagnostics.has_errors() ? parsed.report() : shape(reward_of(parsed));
}

TEST(Precedence, OrdersBinaryOperators) {
    EXPECT_EQ(shape_of("a <=> b => c | d ^ e == f + g * h"),
              "(a <=> (b => (c | (d ^ (e == (f + (g * h)))))))");
    EXPECT_EQ(shape_of("a * b + c == d ^ e | f => g <=> h"),
              "(((((((a * b) + c) == d) ^ e) | f) => g) <=> h)");
}

TEST(Precedence, AssociatesToTheLeft) {
    for (const char* op : {"<=>", "=>", "|", "^", "==", "-", "/"})
        EXPECT_EQ(shape_of(fmt::format("a {0} b {0} c", op)), fmt::format("((a {0} b) {0} c)", op));
    EXPECT_EQ(shape_of("a - b + c - d"), "(((a - b) + c) - d)");
    EXPECT_EQ(shape_of("a / b * c"), "((a / b) * c)");
    EXPECT_EQ(shape_of("a ^ b & c ^ d"), "(((a ^ b) & c) ^ d)");
    EXPECT_EQ(shape_of("3 > 2 > 1"), "((3 > 2) > 1)");
    EXPECT_EQ(shape_of("a < b ~= c >= d"), "(((a < b) ~= c) >= d)");
}

TEST(Precedence, BindsUnaryOperatorsTightest) {
    EXPECT_EQ(shape_of("~a == b"), "((~a) == b)");
    EXPECT_EQ(shape_of("~a ^ b"), "((~a) ^ b)");
    EXPECT_EQ(shape_of("-a * b"), "((-a) * b)");
    EXPECT_EQ(shape_of("a - - -b"), "(a - (-(-b)))");
    EXPECT_EQ(shape_of("+a + +b"), "((+a) + (+b))");
    EXPECT_EQ(shape_of("~~a | ~b"), "((~(~a)) | (~b))");
}

TEST(Precedence, LetsOpenEndedConstructsSwallowWhatFollows) {
    EXPECT_EQ(shape_of("sum_{?o : t} v(?o) + 10"), "(sum_ (v(?o) + 10))");
    EXPECT_EQ(shape_of("10 + sum_{?o : t} v(?o) + 10"), "(10 + (sum_ (v(?o) + 10)))");
    EXPECT_EQ(shape_of("sum_{?o : t} [v(?o)] + 10"), "(sum_ (v(?o) + 10))");
    EXPECT_EQ(shape_of("2 * sum_{?o : t} v * 2"), "(2 * (sum_ (v * 2)))");
    EXPECT_EQ(shape_of("2 * sum_{?o : t} v + 2"), "(2 * (sum_ (v + 2)))");
    EXPECT_EQ(shape_of("-sum_{?o : t} v + 1"), "(-(sum_ (v + 1)))");
    EXPECT_EQ(shape_of("~forall_{?o : t} p ^ q"), "(~(forall_ (p ^ q)))");
    EXPECT_EQ(shape_of("5 + if (c) then a else b + 10"), "(5 + (if c then a else (b + 10)))");
    EXPECT_EQ(shape_of("5 * if (c) then a + 1 else b => c"),
              "(5 * (if c then (a + 1) else (b => c)))");
    EXPECT_EQ(shape_of("[sum_{?o : t} v] + 10"), "((sum_ v) + 10)");
    EXPECT_EQ(shape_of("1 - Discrete_{?o : t} a + b"), "(1 - (Discrete_ (a + b)))");
    EXPECT_EQ(shape_of("1 - det_{?o : t, ?p : t} a + b"), "(1 - (det_ (a + b)))");
    EXPECT_EQ(shape_of("argmax_{?o : t} a | b"), "(argmax_ (a | b))");
    EXPECT_EQ(shape_of("a ^ exists_{?o : t} b ^ if (c) then d else e | f"),
              "(a ^ (exists_ (b ^ (if c then d else (e | f)))))");
}

TEST(Precedence, BindsDanglingElseToTheInnermostIf) {
    EXPECT_EQ(shape_of("if (a) then if (b) then c else d else e"),
              "(if a then (if b then c else d) else e)");
    EXPECT_EQ(shape_of("if (a) then b else if (c) then d else e"),
              "(if a then b else (if c then d else e))");
}

TEST(Tokens, KeepAMinusInsideAWord) {
    EXPECT_EQ(shape_of("a-b"), "a-b");
    EXPECT_EQ(shape_of("x-1"), "x-1");
    EXPECT_EQ(shape_of("x -1"), "(x - 1)");
    EXPECT_EQ(shape_of("x- 1"), "(x - 1)");
    EXPECT_EQ(shape_of("1-x"), "(1 - x)");
    EXPECT_EQ(shape_of("?a-b-?c"), "(?a-b - ?c)");
    EXPECT_EQ(shape_of("a'-b"), "(a' - b)");
}

TEST(Tokens, DoNotEndInAMark) {
    EXPECT_EQ(shape_of("sum_{?x : t} a_b"), "(sum_ a_b)");
    EXPECT_EQ(shape_of("sum _ { ?x_1 : t } ?x_1"), "(sum_ ?x_1)");
    EXPECT_EQ(shape_of("a- -b"), "(a - (-b))");
}

TEST(Tokens, ReadEnumeratedValuesAndNumbers) {
    EXPECT_EQ(shape_of("@1 == @2-a"), "(@1 == @2-a)");
    EXPECT_EQ(shape_of("@x_y ~= .5"), "(@x_y ~= .5)");
    EXPECT_EQ(shape_of("007 + 1.50"), "(7 + 1.50)");
    EXPECT_EQ(shape_of("9223372036854775807"), "9223372036854775807");
}

TEST(Tokens, DistinguishReservedWordsFromLongerNames) {
    EXPECT_EQ(shape_of("iffy + horizons + Normal1 + true-x"),
              "(((iffy + horizons) + Normal1) + true-x)");
    EXPECT_EQ(shape_of("sum + prod + min[a, b] + max"), "(((sum + prod) + min[a, b]) + max)");
    EXPECT_EQ(shape_of("horizon'"), "horizon'");
}

TEST(Expressions, HaveSpansOfExactBytes) {
    const Parsed parsed =
        parse_text("// \xC3\xA9 comment\r\ndomain d {\r\n reward = [ab + \t c'(?x)]; // e\r\n}");
    ASSERT_FALSE(parsed.diagnostics.has_errors()) << parsed.report();
    const ast::Expr& group = reward_of(parsed);
    EXPECT_EQ(parsed.sources.text(group.span), "[ab + \t c'(?x)]");
    EXPECT_EQ(parsed.sources.location(group.span), "test.rddl:3:11");
    const auto& sum = std::get<ast::Binary>(std::get<ast::Group>(group.node).inner->node);
    EXPECT_EQ(parsed.sources.text(sum.op_span), "+");
    EXPECT_EQ(parsed.sources.text(sum.right->span), "c'(?x)");
    const auto& reference = std::get<ast::Reference>(sum.right->node);
    EXPECT_EQ(reference.name.text, "c");
    EXPECT_TRUE(reference.primed);
    EXPECT_EQ(parsed.sources.text(reference.name.span), "c'");
    EXPECT_EQ(std::get<ast::Variable>(reference.arguments.at(0).node).name, "x");
}

TEST(Expressions, ReadNestedTerms) {
    const Parsed parsed = parse_reward("p(q(?x), @a, b, argmax_{?y : t} r(?y) + 1, q())");
    const auto& reference = std::get<ast::Reference>(reward_of(parsed).node);
    ASSERT_EQ(reference.arguments.size(), 5u);
    EXPECT_EQ(shape(reference.arguments[3]), "(argmax_ (r(?y) + 1))");
    EXPECT_TRUE(std::get<ast::Reference>(reference.arguments[4].node).arguments.empty());
}

TEST(Expressions, AcceptAnyNameOfAnAggregation) {
    EXPECT_EQ(shape_of("median_{?x : t} a"), "(median_ a)");
}

}  // namespace
}  // namespace rddlc
