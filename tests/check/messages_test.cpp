// Diagnostics name the cause: the sentence, the notes and the hint, as the user sees them.
#include "checking.hpp"
#include "probes.hpp"

#include <gtest/gtest.h>

namespace rddlc::testing {
namespace {

using ::testing::Test;

// "line:column: message" and, a line each, "note line:column: ..." and "hint: ...".
std::string report(const std::string& probe) {
    DiagnosticOptions options;
    options.disabled_warnings.insert({'W', 202});
    const Checked checked = check_text(problem_with(probe), options);
    std::string text;
    for (const Diagnostic& diagnostic : checked.diagnostics.all()) {
        if (!text.empty()) text += "\n";
        text += diagnostic.message;
        for (const Note& note : diagnostic.notes)
            text += "\nnote at '" + std::string(checked.sources.text(*note.span)) +
                    "': " + note.message;
        if (!diagnostic.hint.empty()) text += "\nhint: " + diagnostic.hint;
    }
    return text;
}

TEST(Messages, WrongArity) {
    EXPECT_EQ(report("rt'(?x) = LINK(?x);"),
              "'LINK' takes 2 arguments (t, t), found 1\n"
              "note at 'LINK': declared here");
    EXPECT_EQ(report("rt'(?x) = R(?x);"),
              "'R' takes 0 arguments, found 1\n"
              "note at 'R': declared here");
}

TEST(Messages, MisspelledName) {
    EXPECT_EQ(report("rt'(?x) = LIMK(?x, ?x);"),
              "'LIMK' is not declared\nhint: did you mean 'LINK'?");
    EXPECT_EQ(report("hue' = @gren;"),
              "no type has the member '@gren'\nhint: did you mean '@green'?");
    EXPECT_EQ(report("b' = Bernouli(r);"),
              "'Bernouli' is not declared\nhint: did you mean 'Bernoulli'?");
    EXPECT_EQ(report("r' = flor[r];"), "there is no function 'flor'\nhint: did you mean 'floor'?");
}

TEST(Messages, NamesOfOtherLanguages) {
    EXPECT_EQ(report("r' = Gaussian(r, r);"),
              "'Gaussian' is not declared\nhint: the distribution is 'Normal(mean, variance)'");
    EXPECT_EQ(report("hue' = purple;"),
              "'purple' is not declared\nhint: the values of 'colour' are @red, @green, @blue");
    EXPECT_TRUE(report("{ state-fluent, real ==> { state-fluent, Float")
                    .starts_with("type 'Float' is not declared\nhint: 'Float' is written 'real'"));
    EXPECT_EQ(report("rt(o2) = -1.5; ==> rt(o2) = True;"),
              "'rt' is real, found the unknown name 'True'\n"
              "note at 'rt': declared here\n"
              "hint: 'True' is written 'true'");
}

TEST(Messages, ComparisonsOfComparisons) {
    EXPECT_TRUE(report("b' = 1 == i == 2;").starts_with("this compares the truth of the left"));
    EXPECT_EQ(report("b' = (1 == i) == 2;"), "");
    EXPECT_EQ(report("b' = b == ab == b;"), "");
}

TEST(Messages, PowersOfBools) {
    const std::string hint = "hint: '^' is 'and'; a power is written 'pow[x, y]'";
    for (const char* probe : {"r' = 2.0 * (b ^ 2);", "b' = i ^ 2 > 3;",
                              "r' = 2.0 * (b ^ 2.0 > 1.0);", "b' = r ^ 2 + i;"})
        EXPECT_TRUE(report(probe).ends_with(hint)) << probe << '\n' << report(probe);
    EXPECT_TRUE(report("rt'(?x) = bt(?x)^3 * 2.0;").ends_with(hint.substr(6)));
    EXPECT_EQ(report("b' = b ^ 0 < i;"), "");
    EXPECT_EQ(report("b' = b ^ i > 2;"), "");
}

TEST(Messages, SubtractionWithoutBlanks) {
    EXPECT_EQ(report("r' = r-i;"),
              "'r-i' is not declared\nhint: write 'r - i' with blanks: 'r-i' is one name");
    EXPECT_EQ(report("r' = r-1;"),
              "'r-1' is not declared\nhint: write 'r - 1' with blanks: 'r-1' is one name");
    EXPECT_EQ(report("r' = r-i-m;"),
              "'r-i-m' is not declared\nhint: write 'r - i - m' with blanks: 'r-i-m' is one name");
}

TEST(Messages, ObjectInTheDomain) {
    EXPECT_EQ(report("rt'(?x) = P(o1);"),
              "'o1' is an object of the instance: the domain cannot name it\n"
              "note at 'o1': object of type 't'\n"
              "hint: use a variable, or a non-fluent that the instance sets for this object");
}

TEST(Messages, VariableOfAnAggregationThatEnded) {
    EXPECT_EQ(report("r' = [sum_{?x : t} P(?x)] + P(?x);"),
              "variable '?x' is not bound here\n"
              "note at ')': the 'sum' that binds '?x' ends here");
    EXPECT_EQ(report("rt'(?x) = P(?y);"), "variable '?y' is not bound here\nhint: bound here: ?x");
    EXPECT_EQ(report("r' = P(?y);"),
              "variable '?y' is not bound here\nhint: no variable is bound here");
}

TEST(Messages, Primes) {
    EXPECT_EQ(report("rt(?x) = 1;"),
              "the CPF of state-fluent 'rt' defines its next value 'rt''\n"
              "note at 'rt': declared here\n"
              "hint: you forgot a prime: rt'(...) = ...");
    EXPECT_EQ(report("r' = m';"),
              "'m' is an interm-fluent: only state-fluents have a next value\n"
              "note at 'm': declared here\n"
              "hint: write 'm' without the prime");
}

TEST(Messages, FunctionsAndAggregations) {
    EXPECT_EQ(report("r' = abs(i);"),
              "'abs' is not a fluent\nhint: functions take square brackets: 'abs[...]'");
    EXPECT_EQ(report("r' = log[8];"),
              "'log' takes 2 arguments, found 1\n"
              "hint: the natural logarithm is 'ln[x]'; 'log[x, base]' has a base");
    EXPECT_EQ(report("r' = min[1, 2, 3];"),
              "'min' takes 2 arguments, found 3\n"
              "hint: nest it: 'min[a, min[b, c]]'; over objects it is 'min_{?x : type} ...'");
    EXPECT_EQ(report("r' = Normal(1);"),
              "'Normal' takes 2 arguments, found 1\nhint: write 'Normal(mean, variance)'");
    EXPECT_EQ(report("r' = exp[1, 2];"), "'exp' takes 1 argument, found 2\nhint: write 'exp[x]'");
    EXPECT_EQ(report("r' = atan2[1, 2];"),
              "there is no function 'atan2'\n"
              "hint: use 'atan[y / x]' and distinguish the quadrants; --std=rddlc allows it");
    EXPECT_EQ(report("r' = sum[1];"),
              "there is no function 'sum'\n"
              "hint: an aggregation is written 'sum_{?x : type} ...'");
    EXPECT_EQ(report("r' = average_{?x : t} P(?x);"), "there is no aggregation 'average'");
}

TEST(Messages, TypesOfValues) {
    EXPECT_EQ(
        report("i' = i / 2;"),
        "the value of 'i'' must be int, found real\n"
        "note at 'i': declared here\n"
        "hint: 'round[...]', 'floor[...]' and 'ceil[...]' give an int; '/' always gives a real, "
        "'div[a, b]' an int");
    EXPECT_EQ(report("hue' = i;"),
              "the value of 'hue'' must be an object of type 'colour', found int\n"
              "note at 'hue': declared here");
    EXPECT_EQ(report("b' = hue == 1;"), "cannot compare an object of type 'colour' with int");
    EXPECT_EQ(report("i' = if (i) then 1 else 2;"),
              "the condition of 'if' must be bool, found int\n"
              "hint: compare it with something, as in '... > 0'");
    EXPECT_EQ(report("rt'(?x) = OF(?x);"),
              "argument 1 of 'OF' must be an object of type 'u', found an object of type 't'\n"
              "note at 'OF': declared here");
}

TEST(Messages, ForbiddenDependencies) {
    EXPECT_EQ(report("m = r';"),
              "'m' may not depend on 'r'', a next-state fluent\n"
              "note at 'r': declared here\n"
              "hint: write 'r' without the prime: an interm-fluent may depend on non-fluents, "
              "state-fluents, action-fluents, derived-fluents and interm-fluents");
    EXPECT_EQ(report("termination { ab; };"),
              "a termination condition may not depend on 'ab', an action-fluent\n"
              "note at 'ab': declared here\n"
              "hint: store in a state-fluent what the action does, and test that: a termination "
              "condition may depend on non-fluents and state-fluents");
}

TEST(Messages, CyclesAreShownWhole) {
    EXPECT_EQ(report("m = r;\\n        k = i; ==> m = k;\\n        k = round[m];"),
              "'m' depends on itself: m -> k -> m\n"
              "note at 'k': 'm' needs 'k'\n"
              "note at 'm': 'k' needs 'm'");
    EXPECT_EQ(report("rt'(?x) = rt'(NEXT(?x));"),
              "'rt'' depends on itself: rt' -> rt'\n"
              "note at 'rt'': 'rt'' needs 'rt''\n"
              "hint: dependencies are between fluents, whatever their arguments");
}

TEST(Messages, MissingValuesAreCounted) {
    EXPECT_EQ(report("COV(t, t) : { non-fluent, real, default = 0.0 }; ==> "
                     "COV(t, t) : { non-fluent, real };"),
              "'COV' has no default, and the instance gives no value to 6 of its 9 groundings: "
              "COV(o1, o2), COV(o1, o3), COV(o2, o1), ...\n"
              "hint: give the values in the instance's 'non-fluents', or a default here");
}

TEST(Messages, ValuesInTheInstance) {
    EXPECT_EQ(report("LINK(o1, o2); ==> LINK(o1, v2);"),
              "argument 2 of 'LINK' is of type 't', but 'v2' is of type 'u'\n"
              "note at 'LINK': declared here");
    EXPECT_EQ(report("LINK(o1, o2); ==> lynk(o1, o2);"),
              "there is no non-fluent 'lynk'\nhint: did you mean 'LINK'?");
    EXPECT_EQ(report("LINK(o1, o2); ==> b;"),
              "'b' is a state-fluent; 'non-fluents' sets non-fluents only\n"
              "note at 'b': declared here");
    EXPECT_EQ(report("LINK(o1, o2); ==> LINK(o1, o2); ~LINK(o1, o2);"),
              "'LINK(o1, o2)' is set twice, to different values\n"
              "note at 'LINK(o1, o2);': first set here");
    EXPECT_EQ(report("LINK(o1, o2); ==> N = 5.5;"),
              "'N' is int, found the real '5.5'\nnote at 'N': declared here");
}

TEST(Messages, ABodyThatGoesOn) {
    EXPECT_EQ(report("r' = sum_{?x : t} [P(?x)] + 10;"),
              "this belongs to the body of 'sum', which extends to the end\n"
              "note at '[P(?x)]': the body does not end with these brackets\n"
              "hint: RDDL reads 'sum_{?x : t} [[P(?x)] + 10]'; '[sum_{?x : t} [P(?x)]] + 10' was "
              "probably "
              "meant");
}

// One cause, one message: what depends on something wrong is not reported again.
TEST(Messages, DoNotCascade) {
    EXPECT_EQ(report("r' = 1 + 2 * sum_{?x : nothing} [P(?x) + P(?x)] ^ true;"),
              "type 'nothing' is not declared");
    EXPECT_EQ(report("NEXT(t) : { non-fluent, t }; ==> NEXT(t) : { non-fluent, things };"),
              "type 'things' is not declared");
    EXPECT_EQ(report("t : {o1, o2, o3}; ==>"),
              "type 't' has no objects in the instance\n"
              "hint: add 't : { ... };' to its 'objects'");
    EXPECT_EQ(report("bt'(?x) = bt(?x); ==> btt'(?x) = bt(?x);"),
              "'btt' is not declared in 'pvariables'\n"
              "hint: did you mean 'bt'?");
}

TEST(Messages, AllErrorsAreReportedAtOnce) {
    EXPECT_EQ(report("b' = ~i ^ ~r ^ unknown;"),
              "the operand of '~' must be bool, found int\n"
              "hint: compare it with something, as in '... > 0'\n"
              "the operand of '~' must be bool, found real\n"
              "hint: compare it with something, as in '... > 0'\n"
              "'unknown' is not declared");
}

}  // namespace
}  // namespace rddlc::testing
