#include "passes/aggregations/set_bits.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

// Two dice whose faces are 20 objects.
Problem dice(const std::string& seen) {
    return {.pvariables =
                "face(pair) : { interm-fluent, obj };\n"
                "count(pair) : { state-fluent, int, default = 0 };\n"
                "LUCKY(obj) : { non-fluent, bool, default = false };\n"
                "seen(obj) : { state-fluent, bool, default = false };\n"
                "roll(pair) : { action-fluent, bool, default = false };\n"
                "stop : { action-fluent, bool, default = false };",
            .cpfs =
                "face(?d) = Discrete_{?x : obj}(0.05);\n"
                "count'(?d) = count(?d);\n"
                "seen'(?o) = " +
                seen + ";",
            .non_fluents = "LUCKY(b1); LUCKY(b3);"};
}

// The row as an int.
std::string with_bits(const std::string& seen) {
    passes::Report report;
    const std::string step =
        step_text(valid(passes::set_bits(grounded_with_many(dice(seen)), report)));
    const std::string start = "spread next.seen = ";
    const std::size_t begin = step.find(start);
    return begin == step.npos ? "" : step.substr(begin + start.size());
}

const std::string rolled = "(exists_{?d : pair} [roll(?d) ^ (face(?d) == ?o)])";
const std::string rolled_bits =
    "bit_or(select(action.roll[0], seen-bit[scratch.face[0]], 0), "
    "select(action.roll[1], seen-bit[scratch.face[1]], 0))";

TEST(SetBits, LooksUpTheBitOfEachInt) {
    EXPECT_EQ(with_bits(rolled), rolled_bits + "\n");
    passes::Report report;
    const ir::Program program = passes::set_bits(grounded_with_many(dice(rolled)), report);
    EXPECT_EQ(report["rows of bools whose bits are set"], 1);
    EXPECT_TRUE(table_text(program, "seen-bit").starts_with("seen-bit[20]: int = {1 2 4 8 "));
}

// Environments of a pack would take the bits of different rows.
TEST(SetBits, LeavesRowsThatTheStateChooses) {
    Problem problem = dice(rolled + " | old(which, ?o)");
    problem.pvariables +=
        "which : { state-fluent, pair };\n"
        "old(pair, obj) : { state-fluent, bool, default = false };";
    problem.cpfs += "which' = which; old'(?d, ?o) = old(?d, ?o);";
    problem.init_state = "which = a1;";
    passes::Report report;
    valid(passes::set_bits(grounded_with_many(problem), report));
    EXPECT_EQ(report["rows of bools whose bits are set"], 0);
}

TEST(SetBits, GivesTheRewardARow) {
    Problem problem = dice("seen(?o)");
    problem.reward = "sum_{?o : obj} [if (" + rolled + ") then 2.5 else 1.0]";
    passes::Report report;
    const ir::Program program = valid(passes::set_bits(grounded_with_many(problem), report));
    EXPECT_EQ(report["rows of bools whose bits are set"], 1);
    const std::string text = ir::print(program);
    EXPECT_NE(text.find("spread scratch.reward-row = bit_or(select(action.roll[0], "
                        "reward-bit[scratch.face[0]], 0), "),
              text.npos);
    EXPECT_NE(text.find("select(scratch.reward-row[o], "), text.npos) << text;
}

TEST(SetBits, CombinesWords) {
    EXPECT_EQ(with_bits("if (stop) then false else " + rolled + " | seen(?o)"),
              "select(action.stop, 0, bit_or(" + rolled_bits + ", bits(state.seen, 0)))\n");
    EXPECT_EQ(with_bits("if (" + rolled + ") then true else seen(?o)"),
              "bit_or(" + rolled_bits + ", bits(state.seen, 0))\n");
    EXPECT_EQ(with_bits("if (" + rolled + ") then LUCKY(?o) else seen(?o) ^ ~stop"),
              "bit_or(bit_and(" + rolled_bits + ", 5), bit_and(bit_xor(" + rolled_bits +
                  ", 1048575), bit_and(bits(state.seen, 0), select(action.stop, 0, 1048575))))\n");
    EXPECT_EQ(with_bits("~" + rolled + " ^ seen(?o)"),
              "bit_and(bit_xor(" + rolled_bits + ", 1048575), bits(state.seen, 0))\n");
}

// Conditions in each other take no more time than their text has parts.
TEST(SetBits, InvertsDeeplyNestedWords) {
    std::string seen = rolled;
    for (int depth = 0; depth < 40; ++depth) seen = "~(seen(?o) ^ " + seen + ")";
    EXPECT_TRUE(with_bits(seen).starts_with("bit_xor(bit_and(bits(state.seen, 0), bit_xor("));
}

TEST(SetBits, LeavesObservations) {
    Problem problem = dice("seen(?o)");
    problem.pvariables += "\nshown(obj) : { observ-fluent, bool };";
    problem.cpfs += "\nshown(?o) = (exists_{?d : pair} [face(?d) == ?o]);";
    passes::Report report;
    valid(passes::set_bits(grounded_with_many(problem), report));
    EXPECT_TRUE(report.empty());
}

TEST(SetBits, LeavesOthers) {
    for (const char* const body :
         {"roll(?d) ^ (count(?d) == 3)",             // the same for all elements
          "roll(?d) ^ (face(?d) == ?o) ^ seen(?o)",  // another condition on the element
          "roll(?d) ^ (face(?d) ~= ?o)",             // no equality
          "(face(?d) == ?o) ^ Bernoulli(0.5)",       // a draw
          "(face(?d) == ?o) | LUCKY(?o)"}) {         // not only where it is equal
        const ir::Program program =
            grounded_with_many(dice("exists_{?d : pair} [" + std::string(body) + "]"));
        passes::Report report;
        EXPECT_EQ(ir::print(passes::set_bits(program, report)), ir::print(program)) << body;
    }
    // Three elements.
    passes::Report report;
    const ir::Program few = grounded(dice(rolled));
    EXPECT_EQ(ir::print(passes::set_bits(few, report)), ir::print(few));
}

}  // namespace
}  // namespace rddlc
