// Calls of external functions: which tables they get, how often they are made.
#include "problem.hpp"

namespace rddlc {
namespace {

Problem market(const std::string& cpfs) {
    return {.pvariables =
                "K : { non-fluent, int, default = 4 };\n"
                "B(obj, pair) : { non-fluent, bool, default = false };\n"
                "v(obj) : { state-fluent, real, default = 1.0 };\n"
                "m(obj, pair) : { state-fluent, real, default = 1.0 };\n"
                "n(obj) : { state-fluent, int, default = 1 };\n"
                "p : { state-fluent, bool, default = false };\n"
                "q(color) : { state-fluent, real, default = 0.0 };",
            .cpfs = cpfs + "\nn'(?o) = n(?o); p' = p; q'(?c) = q(?c);"};
}

// The part of the last CPF.
std::string step_of(const std::string& cpf_of_v) {
    const std::string step =
        step_text(grounded(market("v'(?o) = " + cpf_of_v + "; m'(?o, ?p) = m(?o, ?p);")));
    const std::string before = "next.q[c] = state.q[c]\n";
    return step.substr(step.find(before) + before.size());
}

TEST(External, TakesTablesAsTheyAre) {
    EXPECT_EQ(step_of("$f[?o](v(_), m(_, _), B(_, _), K, p, q(@green))"),
              "fill scratch.f = $f(state.v, state.m, B, K, state.p, state.q[1])\n"
              "for o in obj\n"
              "    next.v[o] = scratch.f[o]\n");
}

TEST(External, IsCalledForEachCombinationThatItsArgumentsDependOn) {
    EXPECT_EQ(step_of("$f[](v(?o), m(?o, _))"),
              "for o in obj\n"
              "    fill scratch.f[o] = $f(state.v[o], state.m[o])\n"
              "for o in obj\n"
              "    next.v[o] = scratch.f[o]\n");
    EXPECT_EQ(step_of("sum_{?p : pair} $f[?p](v(?o))"),
              "for o in obj\n"
              "    fill scratch.f[o] = $f(state.v[o])\n"
              "for o in obj\n"
              "    next.v[o] = sum[p in pair](scratch.f[o, p])\n");
    EXPECT_EQ(step_of("$f[](K)"),
              "fill scratch.f = $f(K)\n"
              "for o in obj\n"
              "    next.v[o] = scratch.f\n");
}

TEST(External, GetsACopyWhereItsAxesAreNotTheLast) {
    EXPECT_EQ(step_of("sum_{?p : pair} $f[?o](m(_, ?p), p)"),
              "for p in pair\n"
              "    for axis1 in obj\n"
              "        scratch.argument[p, axis1] = state.m[axis1, p]\n"
              "for p in pair\n"
              "    fill scratch.f[p] = $f(scratch.argument[p], state.p)\n"
              "for o in obj\n"
              "    next.v[o] = sum[p in pair](scratch.f[p, o])\n");
}

TEST(External, GivesTablesInTheOrderOfItsBrackets) {
    const std::string step = step_text(
        grounded(market("v'(?o) = v(?o); m'(?o, ?p) = $f[?p, ?o](v(_)) + $f[?o, ?p](v(_));")));
    EXPECT_NE(step.find("next.m[o, p] = scratch.f[p, o] + scratch.f_2[o, p]\n"), step.npos) << step;
}

TEST(External, GivesWhatItsPlaceNeeds) {
    const ir::Program program = grounded(
        market("v'(?o) = if ($f[](K)) then $g[](K) else 0; m'(?o, ?p) = m(?o, ?p) + $h[?p](K);"));
    const auto scalar_of = [&](const std::string& name) {
        for (const ir::Buffer& buffer : program.buffers)
            if (buffer.name == name) return buffer.scalar;
        throw std::logic_error("no buffer " + name);
    };
    EXPECT_EQ(scalar_of("f"), ir::Scalar::Bool);
    EXPECT_EQ(scalar_of("g"), ir::Scalar::Real);
    EXPECT_EQ(scalar_of("h"), ir::Scalar::Real);
    EXPECT_EQ(program.externals.size(), 3u);
}

TEST(External, NeedsNoArguments) {
    EXPECT_EQ(step_of("$f[?o]"),
              "fill scratch.f = $f()\n"
              "for o in obj\n"
              "    next.v[o] = scratch.f[o]\n");
}

TEST(External, MayBeInfinite) {
    // So 0 times it is not folded to an ordinary product outside of any scope.
    const ir::Program program = grounded(usual_problem("f * $f[](f)"));
    EXPECT_NE(step_text(program).find("select("), std::string::npos) << step_text(program);
}

}  // namespace
}  // namespace rddlc
