// Matrix functions and random vectors: which tables are filled, how often, and what faults.
#include "ir/interpreter.hpp"
#include "passes/passes.hpp"
#include "problem.hpp"

#include <rddl/random/random.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rddlc {
namespace {

Problem matrix_problem(const std::string& cpf_of_m, const std::string& blocks = {}) {
    return {.pvariables =
                "A(obj, obj) : { non-fluent, real, default = 0.0 };\n"
                "B(pair, obj, obj) : { non-fluent, real, default = 1.0 };\n"
                "m(obj, obj) : { state-fluent, real, default = 0.0 };\n"
                "x : { state-fluent, real, default = 2.0 };",
            .cpfs = "m'(?r, ?c) = " + cpf_of_m + ";\nx' = x;",
            .blocks = blocks,
            .non_fluents = "A(b1, b1) = 2.0; A(b2, b2) = 4.0; A(b3, b3) = 8.0;"};
}

// The fault of the first step of the unchanged program, which is that of the optimised one.
rddl::FaultRecord fault_of(const ir::Program& program) {
    const auto run = [](ir::Program which) {
        const ir::Interpreter engine(std::move(which));
        std::vector<std::byte> state(engine.state_size()), next(engine.state_size());
        std::vector<std::byte> action(engine.action_size()), scratch(engine.scratch_size());
        Context context{.key = rddl::stream_key(1, 0, 0), .step = 1, .fault = {}};
        engine.reset(state.data(), context);
        engine.step(state.data(), action.data(), scratch.data(), next.data(), nullptr, context);
        return context.fault;
    };
    const rddl::FaultRecord fault = run(program);
    const ir::Program optimised = optimise(program);
    EXPECT_EQ(ir::verify(optimised), std::vector<std::string>());
    EXPECT_EQ(run(optimised).kind, fault.kind);
    return fault;
}

TEST(Tables, AreFilledOnceForWhatTheyDependOn) {
    EXPECT_EQ(step_text(grounded(matrix_problem("det_{?x : obj, ?y : obj} A(?x, ?y)"))),
              "for x in obj\n"
              "    for y in obj\n"
              "        scratch.matrix[x, y] = A[x, y]\n"
              "fill scratch.determinant = det(scratch.matrix)\n"
              "for r in obj\n"
              "    for c in obj\n"
              "        next.m[r, c] = scratch.determinant\n"
              "next.x = state.x\n");
    const std::string of_pairs = step_text(grounded(
        matrix_problem("sum_{?p : pair} inverse[row=?r, col=?c][A(?r, ?c) + B(?p, ?r, ?c)]")));
    EXPECT_NE(of_pairs.find("for p in pair\n"
                            "    fill scratch.inverse[p] = inverse(scratch.matrix[p])\n"),
              std::string::npos)
        << of_pairs;
}

TEST(Tables, OfNestedMatricesFollowEachOther) {
    const std::string text = step_text(grounded(matrix_problem(
        "cholesky[row=?r, col=?c][A(?r, ?c) * det_{?x : obj, ?y : obj} [A(?x, ?y) + A(?x, ?r)]]")));
    const std::size_t inner = text.find("fill scratch.determinant[r] = det(scratch.matrix[r])");
    const std::size_t outer = text.find("fill scratch.cholesky = cholesky(scratch.matrix_2)");
    ASSERT_NE(inner, std::string::npos) << text;
    ASSERT_NE(outer, std::string::npos) << text;
    EXPECT_LT(inner, outer);
}

TEST(Tables, MatricesWithoutAResultFaultWhereTheyAreUsed) {
    const std::string singular = "inverse[row=?r, col=?c][A(?r, ?c) * (x - 2)]";
    const ir::Program program = grounded(matrix_problem(singular));
    const rddl::FaultRecord fault = fault_of(program);
    EXPECT_EQ(fault.kind, rddl::FaultKind::Undefined);
    EXPECT_EQ(program.sites[fault.place.site].what,
              "the matrix of 'inverse' is singular, or has elements that are not numbers");
    EXPECT_FALSE(fault_of(grounded(matrix_problem("if (x > 9) then " + singular + " else 1"))));
    EXPECT_TRUE(fault_of(grounded(matrix_problem("if (x < 9) then " + singular + " else 1"))));
    EXPECT_FALSE(fault_of(grounded(matrix_problem("det_{?a : obj, ?b : obj} (x - 2)"))));
}

TEST(Tables, ServeConditionsToo) {
    const ir::Program program = grounded(
        matrix_problem("0",
                       "termination { [det_{?a : obj, ?b : obj} A(?a, ?b)] > x * 31; };\n"
                       "state-invariants { [det_{?a : obj, ?b : obj} [A(?a, ?b) * x]] < 512; };"));
    const ir::Interpreter engine(optimise(program));
    std::vector<std::byte> state(engine.state_size());
    Context context;
    engine.reset(state.data(), context);
    EXPECT_TRUE(engine.terminal(state.data(), context));            // 64 > 62
    EXPECT_TRUE(engine.violates_invariant(state.data(), context));  // 512 < 512
    EXPECT_FALSE(context.fault);
}

TEST(Tables, TooLargeOnesAreErrors) {
    const Grounded result = ground_text([] {
        std::string text = matrix_problem(
                               "sum_{?p : obj, ?q : obj, ?s : obj} inverse[row=?r, col=?c]"
                               "[A(?r, ?p) * A(?q, ?s) * A(?c, ?c)]")
                               .text();
        std::string objects = "b1";
        for (int i = 2; i <= 50; ++i) objects += ", b" + std::to_string(i);
        text.replace(text.find("b1, b2, b3"), 10, objects);
        return text;
    }());
    EXPECT_FALSE(result.program);
    EXPECT_NE(result.messages.find("this needs a table of 312500000 numbers, more than 134217728 "
                                   "[E0603]"),
              std::string::npos)
        << result.messages;
}

Problem vector_problem(const std::string& cpf_of_v) {
    return {.pvariables =
                "MEAN(obj) : { non-fluent, real, default = 1.0 };\n"
                "COV(obj, obj) : { non-fluent, real, default = 0.5 };\n"
                "FLAT(obj, obj) : { non-fluent, real, default = 1.0 };\n"
                "TWISTED(obj, pair, obj) : { non-fluent, real, default = 0.25 };\n"
                "WEIGHT(pair, obj) : { non-fluent, real, default = 0.0 };\n"
                "v(pair, obj) : { state-fluent, real, default = 0.0 };",
            .cpfs = "v'(?p, ?o) = " + cpf_of_v + ";",
            .non_fluents =
                "COV(b1, b1) = 1.0; COV(b2, b2) = 1.0; COV(b3, b3) = 1.0; WEIGHT(a1, b2) = 1.0;"};
}

TEST(Vectors, PassFluentsThemselvesAndShareFactors) {
    EXPECT_EQ(step_text(grounded(vector_problem("MultivariateNormal[?o](MEAN(_), COV(_, _))"))),
              "fill scratch.factor = cholesky(COV)\n"
              "for p in pair\n"
              "    fill scratch.draw[p] = sample multivariatenormal@0[p](MEAN, scratch.factor)\n"
              "for p in pair\n"
              "    for o in obj\n"
              "        next.v[p, o] = scratch.draw[p, o]\n");
}

TEST(Vectors, GatherWhatDoesNotLieTogether) {
    EXPECT_EQ(
        step_text(grounded(vector_problem("MultivariateNormal[?o](v(?p, _), TWISTED(_, ?p, _))"))),
        "for p in pair\n"
        "    for o in obj\n"
        "        for o2 in obj\n"
        "            scratch.covariance[p, o, o2] = TWISTED[o, p, o2]\n"
        "for p in pair\n"
        "    fill scratch.factor[p] = cholesky(scratch.covariance[p])\n"
        "for p in pair\n"
        "    fill scratch.draw[p] = sample multivariatenormal@0[p](state.v[p], "
        "scratch.factor[p])\n"
        "for p in pair\n"
        "    for o in obj\n"
        "        next.v[p, o] = scratch.draw[p, o]\n");
}

TEST(Vectors, FaultsNameTheirPlace) {
    const rddl::FaultRecord flat =
        fault_of(grounded(vector_problem("MultivariateNormal[?o](MEAN(_), FLAT(_, _))")));
    EXPECT_EQ(flat.kind, rddl::FaultKind::Covariance);
    const rddl::FaultRecord weight =
        fault_of(grounded(vector_problem("Dirichlet[?o](WEIGHT(?p, _))")));
    EXPECT_EQ(weight.kind, rddl::FaultKind::PositiveWeight);
    EXPECT_EQ(weight.place, (rddl::Place{0, 0}));
}

// An expression that may fault stays, even if its value is not read.
TEST(Vectors, StayWhereNobodyReadsThem) {
    Problem problem = vector_problem("0");
    problem.pvariables += "\nw(obj) : { interm-fluent, real };";
    problem.cpfs += "\nw(?o) = MultivariateNormal[?o](MEAN(_), FLAT(_, _));";
    EXPECT_TRUE(fault_of(grounded(problem)));
    problem.cpfs = "v'(?p, ?o) = 0;\nw(?o) = det_{?x : obj, ?y : obj} FLAT(?x, ?y);";
    const ir::Program optimised = optimise(grounded(problem));
    EXPECT_TRUE(std::ranges::none_of(optimised.buffers, [](const ir::Buffer& buffer) {
        return buffer.storage == ir::Storage::Scratch;
    }));
}

}  // namespace
}  // namespace rddlc
