#include "passes/lanes/separate_counts.hpp"

#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// 81 groups of four objects; the reward is given.
ir::Program with_counts_apart(const std::string& reward, passes::Report& report) {
    const Problem problem{.pvariables =
                              "NEXT(obj) : { non-fluent, obj };\n"
                              "on(obj, obj, obj, obj) : { state-fluent, bool, default = false };\n"
                              "at : { state-fluent, obj };\n"
                              "v(obj) : { state-fluent, real, default = 0.0 };",
                          .cpfs =
                              "on'(?x, ?y, ?z, ?w) = on(?x, ?y, ?z, ?w);\nv'(?x) = v(?x);\n"
                              "at' = NEXT(at);",
                          .reward = reward,
                          .non_fluents = "NEXT(b1) = b2; NEXT(b2) = b3; NEXT(b3) = b1;",
                          .init_state = "at = b2;"};
    return valid(passes::separate_counts(grounded(problem), report));
}

TEST(SeparateCounts, CountsBitsOfATable) {
    passes::Report report;
    const ir::Program program = with_counts_apart(
        "sum_{?x : obj, ?y : obj, ?z : obj, ?w : obj}"
        " [-(on(?x, ?y, ?z, ?w) & on(NEXT(?x), ?y, ?z, ?w))]",
        report);
    EXPECT_EQ(report["sums that count words of bools"], 1);
    EXPECT_EQ(report["loops that read bools by their places"], 1);
    EXPECT_EQ(ir::print(program, program.reward.value),
              "real(-(count_ones(bits(scratch.reward-bools, 0)) + "
              "count_ones(bits(scratch.reward-bools, 64))))");
    ASSERT_EQ(program.reward.body.size(), 1u);
}

TEST(SeparateCounts, LeavesSumsOfNumbersAndThoseInBranches) {
    for (const char* reward :
         {"sum_{?x : obj} [v(?x)]", "sum_{?x : obj} [v(?x) > 0.0]",
          "sum_{?x : obj, ?y : obj} [on(?x, NEXT(?y), ?x, ?y)]",
          "sum_{?y : obj, ?z : obj, ?w : obj} [on(at, ?y, ?z, ?w)]",  // rows that the state chooses
          "if (exists_{?x : obj} [v(?x) > 0.0]) then sum_{?x : obj, ?y : obj, ?z : obj, ?w : obj}"
          " [on(NEXT(?x), ?y, ?z, ?w)] else 0"}) {
        passes::Report report;
        with_counts_apart(reward, report);
        EXPECT_TRUE(report.empty()) << reward;
    }
}

}  // namespace
}  // namespace rddlc
