// Messages for the user: one message an error, with the cause where it can be guessed.
#include "parsed.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

// "E0101: message | hint", a line each.
std::string summary(const Parsed& parsed) {
    std::string text;
    for (const Diagnostic& diagnostic : parsed.diagnostics.all()) {
        if (!text.empty()) text += "\n";
        text += to_string(diagnostic.code) + ": " + diagnostic.message;
        if (!diagnostic.hint.empty()) text += " | " + diagnostic.hint;
    }
    return text;
}

std::string errors_in_reward(const std::string& expression) {
    return summary(parse_reward(expression));
}
std::string errors_in_domain(const std::string& sections) {
    return summary(parse_text("domain d {\n" + sections + "\n}"));
}
std::string errors_in_instance(const std::string& sections) {
    return summary(parse_text("instance i {\n" + sections + "\n}"));
}

// -------------------------------------------------------------------------------- expectations

TEST(Errors, SayWhatWasExpectedInWords) {
    EXPECT_EQ(errors_in_reward("a + "), "E0101: expected an expression, found ';'");
    EXPECT_EQ(errors_in_reward("a b"), "E0101: expected ';' or an operator, found 'b'");
    EXPECT_EQ(errors_in_reward("(a b)"), "E0101: expected ')' or an operator, found 'b'");
    EXPECT_EQ(errors_in_reward("p(?x ?y)"), "E0101: expected ',' or ')', found '?y'");
    EXPECT_EQ(errors_in_domain("pvariables { p(1) : { state-fluent, bool }; };"),
              "E0101: expected a type, found '1'");
    EXPECT_EQ(errors_in_domain("tipes { };"),
              "E0101: expected a section of the domain ('types', 'pvariables', 'cpfs', 'reward', "
              "...) or '}', found 'tipes' | did you mean 'types'?");
    EXPECT_EQ(errors_in_instance("horizons = 3;"),
              "E0101: expected a section of the instance ('objects', 'init-state', 'horizon', "
              "...) or '}', found 'horizons' | did you mean 'horizon'?");
    EXPECT_EQ(summary(parse_text("hello")),
              "E0101: expected a block ('domain', 'non-fluents' or 'instance') or the end of the "
              "file, found 'hello'");
    EXPECT_EQ(summary(parse_text("domain { }")), "E0101: expected a name, found '{'");
    EXPECT_EQ(errors_in_instance("horizon = -1;"),
              "E0101: expected an integer, 'pos-inf' or 'terminate-when', found '-'");
    EXPECT_EQ(errors_in_instance("init-state { p(a,) = 1; };"),
              "E0101: expected an object or value, found ')'");
    EXPECT_EQ(errors_in_instance("init-state { p = ; };"), "E0101: expected a constant, found ';'");
    EXPECT_EQ(errors_in_instance("objects { t : { }; };"), "E0101: expected a name, found '}'");
}

TEST(Errors, SayWhereTheConstructBegan) {
    const Parsed parsed = parse_text(
        "domain d {\n    cpfs {\n        x' = if (a)\n then b\n else ;"
        "\n    };\n}");
    EXPECT_EQ(parsed.report(),
              "test.rddl:5:7: error: expected an expression, found ';' [E0101]\n"
              "    5 |  else ;\n"
              "      |       ^   in the definition that begins at test.rddl:3:9\n");
}

// ------------------------------------------------------------------------ semicolons, brackets

TEST(Errors, MissingSemicolon) {
    EXPECT_EQ(errors_in_domain("cpfs {\n x' = 1\n y' = 2;\n z' = 3\n };\n reward = 1"),
              "E0102: missing ';' before 'y''\n"
              "E0102: missing ';' before '}'\n"
              "E0102: missing ';' before '}'");
    EXPECT_EQ(errors_in_domain("types { }\n pvariables { };"),
              "E0102: missing ';' before 'pvariables' | sections and declarations end in '};'");
    const Parsed parsed = parse_text("domain d {\n reward = a\n}");
    EXPECT_EQ(parsed.report(),
              "test.rddl:2:12: error: missing ';' before '}' [E0102]\n"
              "    2 |  reward = a\n"
              "      |            ^\n");
}

TEST(Errors, UnbalancedBrackets) {
    EXPECT_EQ(errors_in_reward("(a + [b * c)"), "E0103: missing ']' before ')'");
    EXPECT_EQ(errors_in_reward("((a + b)"), "E0103: missing ')' before ';'");
    EXPECT_EQ(errors_in_reward("a + b)"), "E0103: ')' closes nothing");
    EXPECT_EQ(errors_in_reward("f[a"), "E0103: missing ']' before ';'");
    EXPECT_EQ(errors_in_reward("(a + ]"), "E0103: ']' does not close '('");
    EXPECT_EQ(summary(parse_text("domain d { } }")), "E0103: '}' closes nothing");
    const Parsed parsed = parse_text("domain d {\n reward = (a\n  + b;\n}");
    EXPECT_EQ(parsed.report(),
              "test.rddl:3:6: error: missing ')' before ';' [E0103]\n"
              "    3 |   + b;\n"
              "      |      ^   '(' opened at test.rddl:2:11\n");
}

TEST(Errors, UnclosedSectionsAndBlocks) {
    EXPECT_EQ(errors_in_domain("cpfs {\n x' = 1;\n reward = 1;\n termination { a; };"),
              "E0103: missing '}' before 'reward'");
    EXPECT_EQ(summary(parse_text("domain d {\n reward = 1;\ninstance i {\n horizon = 1;\n}")),
              "E0103: missing '}' before 'instance'");
    EXPECT_EQ(summary(parse_text("domain d {\n types {")),
              "E0103: missing '}' at the end of the file");
}

// ---------------------------------------------------------------------------------------- names

TEST(Errors, ReservedWords) {
    EXPECT_EQ(errors_in_domain("pvariables {\n horizon : { state-fluent, bool };\n };"),
              "E0104: 'horizon' is a reserved word and cannot be a name");
    EXPECT_EQ(errors_in_reward("a + level"),
              "E0104: 'level' is a reserved word and cannot be a name");
    EXPECT_EQ(errors_in_reward("row"), "E0104: 'row' is a reserved word and cannot be a name");
    EXPECT_EQ(errors_in_domain("types { object : object; };"),
              "E0104: 'object' is a reserved word and cannot be a name");
    EXPECT_EQ(errors_in_domain("pvariables { p : { state-fluent, object }; };"),
              "E0104: 'object' is a reserved word and cannot be a name");
    EXPECT_EQ(errors_in_reward("Discrete(t, @a : 1, otherwise : 0)"),
              "E0104: 'otherwise' is a reserved word and cannot be a name | 'otherwise' has no "
              "meaning: give every value its probability");
}

// ----------------------------------------------------------------------------- forms of others

TEST(Errors, FormsOfIf) {
    EXPECT_EQ(errors_in_reward("if (a) then b"),
              "E0105: missing 'else' before ';' | an 'if' always needs both: if (c) then a else b");
    EXPECT_EQ(errors_in_reward("(if (a) then b)"),
              "E0105: missing 'else' before ')' | an 'if' always needs both: if (c) then a else b");
    EXPECT_EQ(errors_in_reward("if a then b else c"),
              "E0101: expected '(', found 'a' | the condition stands in parentheses: if (c) then a "
              "else b");
    EXPECT_EQ(errors_in_reward("if (a > 1 then b else c"),
              "E0101: expected ')' or an operator, found 'then' | the condition stands in "
              "parentheses: if (c) then a else b");
}

TEST(Errors, IllegalCharacters) {
    EXPECT_EQ(errors_in_reward("a \xE2\x89\xA4 b"),
              "E0106: '\xE2\x89\xA4' means nothing in RDDL | write '<='");
    EXPECT_EQ(errors_in_reward("a ? b : c"),
              "E0106: '?' means nothing in RDDL | a choice is written: if (c) then a else b");
    EXPECT_EQ(errors_in_reward("\"a\""),
              "E0106: '\"' means nothing in RDDL\n"
              "E0106: '\"' means nothing in RDDL");
    EXPECT_EQ(errors_in_reward("a \x01 + b"), "E0106: illegal character with code 1");
    EXPECT_EQ(errors_in_domain("types { l : {@0 .. @3}; };"),
              "E0106: '..' means nothing in RDDL | list all values: {@a, @b, @c}");
}

TEST(Errors, Numbers) {
    EXPECT_EQ(errors_in_reward("1e-3 + a"),
              "E0108: RDDL numbers have no exponent | write all digits: 0.001; --std=rddlc "
              "allows it");
    EXPECT_EQ(errors_in_reward("2.5E+2"),
              "E0108: RDDL numbers have no exponent | write all digits: 250.0; --std=rddlc "
              "allows it");
    EXPECT_EQ(errors_in_reward("1e-300"),
              "E0108: RDDL numbers have no exponent | write all digits, or use pow[10, n]; "
              "--std=rddlc allows it");
    EXPECT_EQ(errors_in_reward("1.e-3"),
              "E0108: a number cannot end in a point | write at least one digit behind the "
              "point: 1.0e-3");
    EXPECT_EQ(errors_in_reward("a + 1. + b"),
              "E0108: a number cannot end in a point | write at least one digit behind the "
              "point: 1.0");
    EXPECT_EQ(parse_reward("9223372036854775808").codes(), "E0112");
    EXPECT_EQ(parse_reward(std::string(400, '9') + ".5").codes(), "E0112");
    EXPECT_EQ(parse_reward("0." + std::string(400, '0') + "1").codes(), "");
    EXPECT_EQ(parse_text("instance i { init-state { p = -9223372036854775808; }; }").codes(), "");
    EXPECT_EQ(parse_text("instance i { init-state { p = -9223372036854775809; }; "
                         "horizon = 99999999999999999999; }")
                  .codes(),
              "E0112 E0112");
}

TEST(Errors, Operators) {
    EXPECT_EQ(errors_in_reward("!a"), "E0109: RDDL has no operator '!' | 'not' is written '~'");
    EXPECT_EQ(errors_in_reward("a != b + c"),
              "E0109: RDDL has no operator '!=' | 'not equal' is written '~='");
    EXPECT_EQ(errors_in_reward("a && b"),
              "E0109: RDDL has no operator '&&' | 'and' is written '^'");
    EXPECT_EQ(errors_in_reward("a || b"), "E0109: RDDL has no operator '||' | 'or' is written '|'");
    EXPECT_EQ(errors_in_reward("a % b"),
              "E0109: RDDL has no operator '%' | the remainder is a function: mod[a, b]");
    EXPECT_EQ(errors_in_reward("a ** b"),
              "E0109: RDDL has no operator '**' | a power is a function: pow[a, b]");
    EXPECT_EQ(errors_in_reward("a -> b"),
              "E0109: RDDL has no operator '->' | 'implies' is written '=>'");
    EXPECT_EQ(errors_in_reward("a and b"),
              "E0101: expected ';' or an operator, found 'and' | 'and' is written '^'");
    EXPECT_EQ(errors_in_reward("not a"),
              "E0101: expected ';' or an operator, found 'a' | 'not' is written '~'");
}

TEST(Errors, Comments) {
    const std::string hint = " | comments begin with '//' and end with the line";
    EXPECT_EQ(errors_in_reward("a /* b \n c */ + d"),
              "E0110: '/*' does not begin a comment in RDDL" + hint);
    EXPECT_EQ(errors_in_reward("a # b \n + d"),
              "E0110: '#' does not begin a comment in RDDL" + hint);
    EXPECT_EQ(parse_text("/* domain d { }").codes(), "E0110 E0114");
}

TEST(Errors, Primes) {
    EXPECT_EQ(errors_in_reward("p(?x)' + 1"),
              "E0111: an apostrophe must follow a name at once | the next value of a fluent is "
              "written with the apostrophe before the parentheses: p'(?x)");
}

// ----------------------------------------------------------------------------- wrong constructs

TEST(Errors, BracketsOfFunctionsAndDistributions) {
    EXPECT_EQ(errors_in_reward("abs(a + 1)"),
              "E0101: expected ',' or ')', found '+' | functions take square brackets: abs[...]");
    EXPECT_EQ(
        errors_in_reward("pow(a, 2)"),
        "E0101: expected an argument (a variable, a value or a fluent), found '2' | functions "
        "take square brackets: pow[...]");
    EXPECT_EQ(
        errors_in_reward("p(a + 1)"),
        "E0101: expected ',' or ')', found '+' | 'p(...)' is a fluent, and the arguments of a "
        "fluent are variables, @values and fluents, not expressions");
    EXPECT_EQ(errors_in_reward("Normal[0, 1]"),
              "E0101: expected '(', found '[' | distributions take round brackets: Normal(...)");
}

TEST(Errors, FormsOfAggregations) {
    EXPECT_EQ(
        errors_in_reward("sum_{r : room} a"),
        "E0101: expected a variable such as ?x, found 'r' | names of variables begin with '?': ?r");
    const std::string hint = " | write the variables and their types as in sum_{?x : type} ...";
    EXPECT_EQ(errors_in_reward("sum{?x : t} a"),
              "E0101: expected ';' or an operator, found '{'" + hint);
    EXPECT_EQ(errors_in_reward("sum_?x : t a"), "E0101: expected '{', found '?x'" + hint);
    EXPECT_EQ(errors_in_reward("sum_{?x} a"),
              "E0101: expected ':', found '}' | every variable needs its type, as in sum_{?x : "
              "type} ...");
}

TEST(Errors, DistributionsOfOtherLanguages) {
    for (const auto& [written, meant] : {std::pair{"normal", "Normal"},
                                         {"Gaussian", "Normal"},
                                         {"BERNOULLI", "Bernoulli"},
                                         {"chisquare", "ChiSquare"}})
        EXPECT_TRUE(
            errors_in_reward(std::string(written) + "(0.0, 1.0)")
                .ends_with(" | the distribution is written " + std::string(meant) + "(...)"))
            << errors_in_reward(std::string(written) + "(0.0, 1.0)");
    EXPECT_TRUE(errors_in_reward("Norml(0.0, 1.0)").ends_with(" | did you mean 'Normal'?"))
        << errors_in_reward("Norml(0.0, 1.0)");
}

TEST(Errors, AMisspeltBlockIsOneError) {
    EXPECT_EQ(summary(parse_text("domain d {\n reward = 1;\n}\ninstances i {\n domain = d;\n "
                                 "non-fluents = n;\n objects { o : { a }; };\n horizon = 3;\n}\n"
                                 "non-fluents n { domain = d; }")),
              "E0101: expected a block ('domain', 'non-fluents' or 'instance') or the end of the "
              "file, found 'instances' | did you mean 'instance'?");
}

TEST(Errors, EqualSigns) {
    EXPECT_EQ(errors_in_domain("cpfs { x' = a = b; };"),
              "E0101: expected ';' or an operator, found '=' | 'equal' is written '=='");
    EXPECT_EQ(errors_in_domain("cpfs { x' == a; };"),
              "E0101: expected '=' or '(', found '==' | a definition is written with a single '='");
    EXPECT_EQ(errors_in_domain("cpfs { x' : a; };"),
              "E0101: expected '=' or '(', found ':' | values are given with '='");
}

TEST(Errors, PlacesOfConstructs) {
    EXPECT_EQ(
        errors_in_domain("cpfs { x' = 1 + Dirichlet[?a](b(_)); };"),
        "E0101: expected an expression, found 'Dirichlet' | 'Dirichlet' can only be the whole "
        "right-hand side of a definition");
    EXPECT_EQ(errors_in_reward("switch (a) { case @b : 1 case @c : 2 }"),
              "E0101: expected ',' or '}', found 'case' | the cases of a switch are separated by "
              "commas");
    EXPECT_EQ(parse_text("domain d { cpfs { p'(@a) = 1; q'(b) = 2; }; }").codes(), "E0101 E0101");
    EXPECT_EQ(errors_in_domain("cpfs { p'(b) = 2; };"),
              "E0101: expected a variable such as ?x or ')', found 'b' | a definition is for all "
              "objects, "
              "so its parameters are variables such as ?b; distinguish objects on the right-hand "
              "side: if (?b == THE-ONE) then ..., where THE-ONE is a non-fluent that the instance "
              "sets");
    EXPECT_EQ(
        summary(parse_text("policy p { cpfs { pour(rose) = true; }; }")),
        "E0101: expected a variable such as ?x or ')', found 'rose' | a definition is for all "
        "objects, so its parameters are variables such as ?rose; distinguish objects on the "
        "right-hand side: if (?rose == THE-ONE) then ..., where the policy declares THE-ONE "
        ": { non-fluent, TYPE, default = rose };");
    EXPECT_EQ(errors_in_domain("types { l : {a, @b}; };"),
              "E0101: expected a value such as @a or '}', found 'a' | values are written with '@': "
              "@a");
    EXPECT_EQ(errors_in_domain("types { l : m; };"),
              "E0101: expected '{' or 'object', found 'm' | a type is an 'object' or a list of "
              "values {@a, @b}");
    EXPECT_EQ(errors_in_domain("pvariables { p : { statefluent, bool }; };"),
              "E0101: expected a kind of fluent ('state-fluent', 'non-fluent', ...), found "
              "'statefluent' | did you mean 'state-fluent'?");
    EXPECT_EQ(
        errors_in_domain("pvariables { p : { bool }; };"),
        "E0101: expected a kind of fluent ('state-fluent', 'non-fluent', ...), found 'bool' | "
        "write the declaration as in p(t) : { state-fluent, bool, default = false };");
}

TEST(Errors, Attributes) {
    const auto errors = [](const std::string& fluent) {
        return parse_text("domain d { pvariables { p : { " + fluent + " }; }; }").codes();
    };
    EXPECT_EQ(errors("action-fluent, bool"), "E0113");
    EXPECT_EQ(errors("interm-fluent, bool, default = true"), "E0113");
    EXPECT_EQ(errors("derived-fluent, bool, default = true, level = 1"), "E0113");
    EXPECT_EQ(errors("observ-fluent, bool, level = 1"), "E0113");
    EXPECT_EQ(errors("state-fluent, bool, level = 1"), "E0113");
    EXPECT_EQ(errors("state-fluent, bool, default = true, default = false"), "E0113");
    EXPECT_EQ(errors("action-fluent, bool, default = true"), "");
    EXPECT_EQ(errors("interm-fluent, bool, level = 2"), "");
    EXPECT_EQ(errors("non-fluent, bool"), "");
}

// ------------------------------------------------------------------------------------- recovery

TEST(Errors, AreAllReportedAndOnlyOnce) {
    const Parsed parsed = parse_text(R"(domain d {
    types {
        a : objct;
        b : object;
        c : { x };
    };
    pvariables {
        p(a : { state-fluent, bool, default = false };
        q : { state-fluent bool, default = false };
        r : { state-fluent, bool, default = false };
    };
    cpfs {
        p'(?x) = if p(?x) then true else (false | abs(1 + 2;
        q' = [a + b;
        r' = sum{?x : a} 1 + switch (a) { case };
        s' = 1;
    };
    reward = 3 + * 4;
}
)");
    EXPECT_EQ(parsed.codes(), "E0101 E0101 E0101 E0101 E0101 E0103 E0101 E0101") << parsed.report();
}

TEST(Errors, DoNotSpreadFromABracketTooMany) {
    const Parsed parsed =
        parse_text("domain d {\n cpfs {\n  x' = a };\n  y' = b;\n };\n reward = 1;\n}\n");
    EXPECT_EQ(parsed.codes(), "E0102 E0101") << parsed.report();
}

TEST(Errors, StandInTheOrderOfTheFile) {
    Parsed parsed = parse_text("domain d { cpfs { x' = 1e3 + ; y' = ! ; }; }");
    parsed.diagnostics.sort_by_position();
    EXPECT_EQ(parsed.codes(), "E0108 E0101 E0109");
}

}  // namespace
}  // namespace rddlc
