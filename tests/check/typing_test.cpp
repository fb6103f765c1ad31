// The types of expressions and the casts between them: section 5 of the language's meaning, read
// off the printed model.
#include "checking.hpp"
#include "model/expression_text.hpp"
#include "probes.hpp"

#include <gtest/gtest.h>

namespace rddlc::testing {
namespace {

// The checked right-hand side of the definition, or the diagnostics.
std::string typed(const std::string& definition) {
    DiagnosticOptions options;
    options.all_warnings_disabled = true;
    const Checked checked = check_text(problem_with(definition), options);
    if (!checked.model) return checked.rendered();
    const std::string name = definition.substr(0, definition.find_first_of("'( ="));
    for (const model::Cpf& cpf : checked.model->cpfs)
        if (checked.model->fluents[cpf.fluent].name == name)
            return model::text_of(*checked.model, cpf.body, 0);
    return "no CPF of " + name;
}

TEST(Typing, LiteralsAreWhatTheyLookLike) {
    EXPECT_EQ(typed("i' = 3;"), "3");
    EXPECT_EQ(typed("r' = 3.0;"), "3.0");
    EXPECT_EQ(typed("b' = true;"), "true");
    EXPECT_EQ(typed("r' = 3;"), "real(3)");
    EXPECT_EQ(typed("r' = true;"), "real(true)");
    EXPECT_EQ(typed("i' = true;"), "int(true)");
    EXPECT_EQ(typed("hue' = blue;"), "@blue");
}

TEST(Typing, ArithmeticCountsBoolsAsInts) {
    EXPECT_EQ(typed("i' = b + ab;"), "(int(b) + int(ab))");
    EXPECT_EQ(typed("i' = -b;"), "-int(b)");
    EXPECT_EQ(typed("i' = +b;"), "int(b)");
    EXPECT_EQ(typed("r' = i * r;"), "(real(i) * r)");
    EXPECT_EQ(typed("r' = b - r;"), "(real(b) - r)");
}

TEST(Typing, DivisionIsReal) {
    EXPECT_EQ(typed("r' = 4 / 2;"), "(real(4) / real(2))");
    EXPECT_EQ(typed("i' = div[4, b];"), "div[4, int(b)]");
}

TEST(Typing, ComparisonsPromote) {
    EXPECT_EQ(typed("b' = i == 1.5;"), "(real(i) == 1.5)");
    EXPECT_EQ(typed("b' = b == ab;"), "(b == ab)");
    EXPECT_EQ(typed("b' = b < ab;"), "(int(b) < int(ab))");
    EXPECT_EQ(typed("b' = true == i;"), "(int(true) == i)");
    EXPECT_EQ(typed("b' = hue ~= @red;"), "(hue ~= @red)");
    EXPECT_EQ(typed("b' = 3 > 2 > 1;"), "(int((3 > 2)) > 1)");
}

TEST(Typing, AggregationsOfBoolsAreInts) {
    EXPECT_EQ(typed("i' = sum_{?x : t} bt(?x);"), "sum_{?x: t} [int(bt(?x))]");
    EXPECT_EQ(typed("r' = avg_{?x : t} it(?x);"), "avg_{?x: t} [real(it(?x))]");
    EXPECT_EQ(typed("r' = max_{?x : t} bt(?x);"), "real(max_{?x: t} [int(bt(?x))])");
    EXPECT_EQ(typed("b' = forall_{?x : t} bt(?x);"), "forall_{?x: t} [bt(?x)]");
    EXPECT_EQ(typed("where'(?v) = argmax_{?x : t} bt(?x);"), "argmax_{?x: t} [int(bt(?x))]");
}

TEST(Typing, FunctionsKeepOrChangeTheType) {
    EXPECT_EQ(typed("i' = abs[b];"), "abs[int(b)]");
    EXPECT_EQ(typed("r' = abs[r];"), "abs[r]");
    EXPECT_EQ(typed("i' = sgn[r];"), "sgn[r]");
    EXPECT_EQ(typed("i' = round[r];"), "round[r]");
    EXPECT_EQ(typed("i' = floor[i];"), "i");
    EXPECT_EQ(typed("r' = min[i, r];"), "min[real(i), r]");
    EXPECT_EQ(typed("i' = max[b, i];"), "max[int(b), i]");
    EXPECT_EQ(typed("i' = pow[i, 2];"), "pow[i, 2]");
    EXPECT_EQ(typed("r' = pow[i, 0.5];"), "pow[real(i), 0.5]");
    EXPECT_EQ(typed("i' = fmod[i, 2];"), "mod[i, 2]");
    EXPECT_EQ(typed("r' = fmod[i, 2.5];"), "fmod[real(i), 2.5]");
    EXPECT_EQ(typed("r' = exp[i];"), "exp[real(i)]");
}

TEST(Typing, DistributionsTakeReals) {
    EXPECT_EQ(typed("b' = Bernoulli(b);"), "Bernoulli(real(b))");
    EXPECT_EQ(typed("r' = Normal(i, 1);"), "Normal(real(i), real(1))");
    EXPECT_EQ(typed("i' = Binomial(b, 1);"), "Binomial(int(b), real(1))");
    EXPECT_EQ(typed("r' = Poisson(1);"), "real(Poisson(real(1)))");
    EXPECT_EQ(typed("r' = KronDelta(i);"), "real(KronDelta(i))");
    EXPECT_EQ(typed("hue' = Discrete(colour, green : 1, @blue : b, red : 0.0);"),
              "Discrete(@red: 0.0, @green: real(1), @blue: real(b))");
}

TEST(Typing, BranchesArePromotedTogether) {
    EXPECT_EQ(typed("r' = if (b) then 1 else 2.5;"), "if (b, real(1), 2.5)");
    EXPECT_EQ(typed("i' = if (b) then ab else 2;"), "if (b, int(ab), 2)");
    EXPECT_EQ(typed("r' = if (b) then 1 else 2;"), "real(if (b, 1, 2))");
    EXPECT_EQ(typed("r' = switch (hue) { default : b, case @green : 2 };"),
              "real(switch (hue, @green: 2, default: int(b)))");
}

TEST(Typing, CastsThatFailOnSomePathsBecomeFaults) {
    EXPECT_EQ(typed("i' = if (b) then 1 else 2.5;"),
              "if (b, 1, fault<int>(\"'2.5' is real, the value of 'i'' must be int\"))");
    EXPECT_EQ(typed("i' = switch (hue) { case @red : 1.5, default : 2 };"),
              "switch (hue, @red: fault<int>(\"'1.5' is real, the value of 'i'' must be int\"), "
              "default: 2)");
    EXPECT_EQ(typed("b' = if (b) then ab else 1;"),
              "if (b, ab, fault<bool>(\"'1' is int, the value of 'b'' must be bool\"))");
}

TEST(Typing, CastsGoThroughOperationsThatKeepInts) {
    EXPECT_EQ(typed("i' = 2 + sum_{?x : t} if (bt(?x)) then 1 else rt(?x);"),
              "(2 + sum_{?x: t} [if (bt(?x), 1, "
              "fault<int>(\"'rt(?x)' is real, the value of 'i'' must be int\"))])");
}

TEST(Typing, LongExpressionsAreBrokenIntoLines) {
    EXPECT_EQ(typed("r' = if (bt(NEXT(argmax_{?y : t} rt(?y)))) then (sum_{?x : t} rt(?x) * P(?x)) "
                    "else hypot[m, r - i * 0.125];"),
              "if (\n"
              "    bt(NEXT(argmax_{?y: t} [rt(?y)])),\n"
              "    sum_{?x: t} [(rt(?x) * P(?x))],\n"
              "    hypot[m, (r - (real(i) * 0.125))]\n"
              ")");
}

TEST(Typing, TheOperandThatMayBeSkippedMayFault) {
    EXPECT_EQ(typed("b' = 1 | b;"),
              "(b | fault<bool>(\"'1' is int, the left operand of '|' must be bool\"))");
    EXPECT_EQ(typed("b' = (i > 1) ^ (i + 1);"),
              "((i > 1) ^ fault<bool>(\"'i + 1' is int, the right operand of '^' must be bool\"))");
}

TEST(Typing, ExternalFunctionsGiveWhatIsNeeded) {
    EXPECT_EQ(typed("i' = $f[](R) + 1;"), "($f[](R) + 1)");
    EXPECT_EQ(typed("b' = $f[](R);"), "$f[](R)");
    EXPECT_EQ(typed("r' = $f[](R) + 1;"), "($f[](R) + real(1))");
}

TEST(Typing, VectorsAndMatrices) {
    EXPECT_EQ(typed("rt'(?x) = MultivariateNormal[?x](P(_), COV(_, _));"),
              "MultivariateNormal[?x](P(_), COV(_, _))");
    EXPECT_EQ(typed("rt'(?x) = Multinomial[?x](N, P(_));"), "real(Multinomial[?x](N, P(_)))");
    EXPECT_EQ(typed("r' = det_{?x : t, ?y : t} LINK(?x, ?y);"),
              "det_{?x: t, ?y: t} [real(LINK(?x, ?y))]");
    EXPECT_EQ(typed("rt'(?x) = sum_{?y : t} pinverse[row=?x, col=?y][COV(?x, ?y)];"),
              "sum_{?y: t} [pinverse[row=?x, col=?y][COV(?x, ?y)]]");
}

TEST(Typing, ArgumentsMayBeNested) {
    EXPECT_EQ(typed("rt'(?x) = P(NEXT(argmin_{?y : t} it'(?y)));"),
              "P(NEXT(argmin_{?y: t} [it'(?y)]))");
    EXPECT_EQ(typed("rt'(?x) = BY(red) * BY(ct(?x));"), "(BY(@red) * BY(ct(?x)))");
}

}  // namespace
}  // namespace rddlc::testing
