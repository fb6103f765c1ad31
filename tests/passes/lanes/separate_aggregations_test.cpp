#include "passes/lanes/separate_aggregations.hpp"

#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// Nine pairs of objects, some of which are linked; the CPF of `depth` is given, and the reward.
Problem with_summed_pairs(const std::string& cpf_of_level, const std::string& reward = "0") {
    return {
        .pvariables =
            "LINK(obj, obj) : { non-fluent, bool, default = false };\n"
            "COST(obj, obj) : { non-fluent, real, default = 0.5 };\n"
            "depth(obj, obj) : { state-fluent, real, default = 0.0 };\n"
            "OTHER : { non-fluent, obj };\n"
            "up : { state-fluent, bool, default = true };",
        .cpfs = "depth'(?x, ?y) = " + cpf_of_level + ";\nup' = up;",
        .reward = reward,
        .non_fluents = "LINK(b1, b2); LINK(b2, b3); LINK(b3, b1); COST(b2, b2) = 2.0; OTHER = b2;"};
}

ir::Program separated(const Problem& problem, passes::Report& report) {
    return valid(passes::separate_aggregations(grounded(problem), report));
}
std::string step_of(const std::string& cpf_of_level) {
    passes::Report report;
    return step_text(separated(with_summed_pairs(cpf_of_level), report));
}

const std::string flow = "(sum_{?z : obj} [depth(?z, ?y) * LINK(?x, ?z)])";

TEST(SeparateAggregations, ComputesThemBeforeTheLoop) {
    EXPECT_EQ(step_of("Normal(0, 1) + " + flow),
              "for x in obj\n"
              "    for y in obj\n"
              "        scratch.depth-part[x, y] = sum[z in obj]("
              "state.depth[z, y] * real(LINK[x, z]))\n"
              "for x in obj, several at once\n"
              "    for y in obj\n"
              "        next.depth[x, y] = sample normal@0[x * 3 + y](0.0, 1.0) + "
              "scratch.depth-part[x, y]\n"
              "next.up = state.up\n");
}

TEST(SeparateAggregations, LeavesThoseInBranchesAndWhatIsCheap) {
    for (const std::string& cpf :
         {"Normal(0, 1) + (if (depth(?x, ?y) > 2) then " + flow + " else 0.0)",
          "depth(?x, ?y) + " + flow, "depth(?y, ?x) + Normal(0, 1) + " + flow,
          std::string("Normal(0, 1) + (sum_{?z : obj} [Normal(0, 1)])")}) {
        passes::Report report;
        separated(with_summed_pairs(cpf), report);
        EXPECT_TRUE(report.empty()) << cpf;
    }
}

TEST(SeparateAggregations, TakesCheapOnesOutOfBranchesThatDraw) {
    const std::string text =
        step_of("if (Bernoulli(0.5)) then Normal(" + flow + ", 1) else depth(?x, ?y)");
    EXPECT_NE(text.find("select(sample bernoulli@0[x * 3 + y](0.5), "
                        "sample normal@1[x * 3 + y](scratch.depth-part[x, y], 1.0), "
                        "state.depth[x, y])"),
              std::string::npos)
        << text;
}

TEST(SeparateAggregations, TakesCheapOnesOutOfBranchesThatChanceDecides) {
    const std::string text = step_of("if (Bernoulli(0.5)) then " + flow + " else depth(?x, ?y)");
    EXPECT_NE(text.find("select(sample bernoulli@0[x * 3 + y](0.5), scratch.depth-part[x, y], "
                        "state.depth[x, y])"),
              std::string::npos)
        << text;
}

TEST(SeparateAggregations, LeavesThoseOfRareBranches) {
    const std::string cpf = "if (go(?x, ?y)) then Normal(" + flow + ", 1) else depth(?x, ?y)";
    Problem problem = with_summed_pairs(cpf);
    problem.pvariables += "go(obj, obj) : { action-fluent, bool, default = false };";
    for (const bool is_rare : {false, true}) {
        ir::Program program = grounded(problem);
        for (ir::Buffer& buffer : program.buffers)
            if (is_rare && buffer.storage == ir::Storage::Action) buffer.most_true = 1;
        passes::Report report;
        valid(passes::separate_aggregations(std::move(program), report));
        EXPECT_EQ(report["loops whose aggregations are computed before"], is_rare ? 0 : 1);
    }
}

// A value that the loop computes once is no reason for a table, nor is a loop that is over several
// objects as it is.
TEST(SeparateAggregations, LeavesLoopsThatWouldNotGain) {
    const std::string once = "(exp[sum_{?z : obj, ?w : obj} [depth(?z, ?w)]])";
    for (const std::string& cpf :
         {once + " + " + flow,
          std::string("Normal(0, 1) + (sum_{?z : obj} [depth(?x, ?y) * COST(?z, ?z)])")}) {
        passes::Report report;
        separated(with_summed_pairs(cpf), report);
        EXPECT_EQ(report["loops whose aggregations are computed before"], 0) << cpf;
    }
}

TEST(SeparateAggregations, ComputesTermsBeforeTheyAreAdded) {
    passes::Report report;
    const ir::Program program =
        separated(with_summed_pairs("0.0",
                                    "1.0 + sum_{?x : obj, ?y : obj} [if (depth(?x, ?y) > 2.0) then "
                                    "exp[depth'(?x, ?y)] else COST(?x, ?y)]"),
                  report);
    EXPECT_EQ(report["sums whose terms are computed before"], 1);
    EXPECT_EQ(ir::print(program, program.reward.value),
              "1.0 + sum[x in obj](sum[y in obj](scratch.reward-terms[x, y]))");
    ASSERT_EQ(program.reward.body.size(), 1u);
}

TEST(SeparateAggregations, ComputesTheBoolsOfQuantifiersBeforeTheyAreTested) {
    const auto tested = [](const std::string& quantifier, const std::string& term) {
        passes::Report report;
        const ir::Program program = separated(
            with_summed_pairs("0.0", quantifier + "_{?x : obj, ?y : obj} [" + term + "]"), report);
        return ir::print(program, program.reward.value);
    };
    const std::string term = "exp[depth(?x, ?y)] > COST(?x, ?y)";
    EXPECT_EQ(tested("exists", term),
              "real(exists[x in obj](exists[y in obj](scratch.reward-terms[x, y])))");
    EXPECT_EQ(tested("forall", term),
              "real(forall[x in obj](forall[y in obj](scratch.reward-terms[x, y])))");
    EXPECT_EQ(tested("exists", "depth(?x, ?y) > COST(?x, ?y)"),
              "real(exists[x in obj](exists[y in obj](state.depth[x, y] > COST[x, y])))");
}

TEST(SeparateAggregations, LeavesCheapTermsAndThoseThatAreNotAlwaysAdded) {
    for (const char* reward :
         {"sum_{?x : obj, ?y : obj} [depth(?x, ?y)]",
          "if (up) then sum_{?x : obj, ?y : obj} [exp[depth(?x, ?y)]] else 0.0",
          "sum_{?x : obj, ?y : obj} [exp[depth(?y, ?x)]]", "sum_{?x : obj} [exp[depth(?x, ?x)]]",
          "sum_{?x : obj, ?y : obj} [lngamma[depth(?x, ?y)]]"}) {
        passes::Report report;
        separated(with_summed_pairs("0.0", reward), report);
        EXPECT_TRUE(report.empty()) << reward;
    }
}

// A draw of an object binds what its weights depend on.
TEST(SeparateAggregations, LeavesWeightsInTheirDraw) {
    const std::string drawn = "((Discrete_{?w : obj} [sum_{?z : obj} [exp[depth(?z, ?w)]]]) == ?y)";
    const std::string reward =
        "(Discrete_{?w : obj} [sum_{?x : obj, ?y : obj} [exp[depth(?y, ?w) * depth(?x, ?y)]]]) == "
        "OTHER";
    passes::Report report;
    const Problem problem =
        with_summed_pairs("Normal(0, 1) + exp[depth(?x, ?y)] + " + drawn, reward);
    EXPECT_EQ(step_text(separated(problem, report)), step_text(grounded(problem)));
    EXPECT_EQ(report["sums whose terms are computed before"], 0);
}

}  // namespace
}  // namespace rddlc
