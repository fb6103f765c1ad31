#include "passes/lanes/test_cheap_first.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

// It has no more than three objects, so a loop must contain another one to be worth a branch.
const std::string pairs = "(exists_{?a : obj, ?b : obj} [exp[v(?a)] * v(?b) > 1.0])";
const std::string text_of_pairs =
    "exists[a in obj](exists[b in obj](exp(state.v[a]) * state.v[b] > 1.0))";

Texts cheap_first(const std::string& condition) {
    return of_x("if (" + condition + ") then 1.0 else x", passes::test_cheap_first);
}

TEST(TestCheapFirst, EvaluatesLoopsWhereTheRestDoesNotDecide) {
    EXPECT_EQ(cheap_first(pairs + " ^ x > 0.5").after,
              "select(select(state.x > 0.5, " + text_of_pairs + ", false), 1.0, state.x)");
    EXPECT_EQ(cheap_first(pairs + " | x < 0.2 | x > 0.5").after,
              "select(select(state.x < 0.2 || state.x > 0.5, true, " + text_of_pairs +
                  "), 1.0, state.x)");
}

TEST(TestCheapFirst, LeavesCheapLoopsAndConditionsWithoutATest) {
    for (const std::string condition : {"x > 0.5 ^ (exists_{?a : obj} [p(?a)])",
                                        "x > 0.5 ^ exp[x] * sin[x] > 0.5", pairs.c_str()}) {
        const Texts x = cheap_first(condition);
        EXPECT_EQ(x.before, x.after);
    }
}

TEST(TestCheapFirst, LeavesLoopsThatALoopAroundDoesNotChange) {
    const Texts x = of_x("sum_{?c : obj} [p(?c) ^ " + pairs + "]", passes::test_cheap_first);
    EXPECT_EQ(x.before, x.after);
}

TEST(TestCheapFirst, KeepsWhatMayFault) {
    const Texts x = cheap_first("Bernoulli(x) ^ " + pairs);
    EXPECT_EQ(x.before, x.after);
}

// The next value of `up`, where an action that is allowed sets at most `most` of its bools.
std::string with_repairs(const std::string& cpf, std::int64_t most) {
    ir::Program program =
        grounded_with_many({.pvariables = "up(obj) : { state-fluent, bool, default = true };\n"
                                          "mend(obj) : { action-fluent, bool, default = false };",
                            .cpfs = "up'(?o) = " + cpf + ";"});
    for (ir::Buffer& buffer : program.buffers)
        if (buffer.storage == ir::Storage::Action) buffer.most_true = most;
    passes::Report report;
    const std::string text = step_text(valid(passes::test_cheap_first(std::move(program), report)));
    const std::size_t begin = text.find("next.up[o] = ") + 13;
    return text.substr(begin, text.find('\n', begin) - begin);
}

TEST(TestCheapFirst, DrawsWhereAnActionOfFewTrueBoolsChooses) {
    const std::string cpf = "up(?o) | (Bernoulli(0.9) ^ mend(?o))";
    EXPECT_EQ(with_repairs(cpf, 1),
              "state.up[o] || select(action.mend[o], sample bernoulli@0[o](0.9), false)");
    EXPECT_EQ(with_repairs(cpf, 20), "state.up[o] || sample bernoulli@0[o](0.9) && action.mend[o]");
    EXPECT_EQ(with_repairs("up(?o) ^ mend(?o)", 1), "state.up[o] && action.mend[o]");
}

}  // namespace
}  // namespace rddlc
