#include "passes/aggregations/tabulate_sums.hpp"

#include "passes/aggregations/set_bits.hpp"
#include "texts.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace rddlc {
namespace {

const std::string robbed = "(exists_{?t : pair} [robs(?t) == ?o])";

// Two thieves, each of whom chooses one of the objects b1, b2, ...
ir::Program with_rows(const std::string& reward, int objects, passes::Report& report,
                      RealType real = RealType::Double) {
    const Problem problem{
        .pvariables =
            "robs(pair) : { state-fluent, obj };\n"
            "GAIN(obj) : { non-fluent, real, default = 0.5 };\n"
            "shut(obj) : { state-fluent, bool, default = false };\n"
            "rank(obj) : { state-fluent, int, default = 0 };\n"
            "guard(obj, pair) : { action-fluent, bool, default = false };",
        .cpfs = "robs'(?t) = robs(?t);\nshut'(?o) = shut(?o);\nrank'(?o) = rank(?o);",
        .reward = "sum_{?o : obj} [" + reward + "]",
        .non_fluents = "GAIN(b2) = 4.0; GAIN(b3) = 0.25;",
        .init_state = "robs(a1) = b1; robs(a2) = b2;"};
    std::string text = problem.text();
    std::string names = "b1";
    for (int i = 2; i <= objects; ++i) names += ", b" + std::to_string(i);
    const std::string few = "obj : {b1, b2, b3}";
    text.replace(text.find(few), few.size(), "obj : {" + names + "}");
    passes::Report of_rows;
    Grounded result = ground_text(text);
    if (!result.program) throw std::runtime_error(result.messages);
    result.program->real = real;
    return valid(passes::tabulate_sums(passes::set_bits(*result.program, of_rows), report));
}

// The reward, with "word" for the objects that are robbed.
std::string reward_of(const std::string& reward, int objects = 4) {
    passes::Report report;
    const std::string all = ir::print(with_rows(reward, objects, report));
    std::string text = all.substr(all.find("\nreward\n") + 8);
    text = text.substr(0, text.find("\n\n"));
    const std::string word = "bit_or(reward-bit[state.robs[0]], reward-bit[state.robs[1]])";
    for (std::size_t at = 0; (at = text.find(word)) != text.npos;)
        text.replace(at, word.size(), "word");
    return text;
}

const std::string row = "    spread scratch.reward-row = word\n";

TEST(TabulateSums, LooksUpTheSumOfAllTerms) {
    const std::string loss = "if (" + robbed + ") then -5.0 else GAIN(?o)";
    EXPECT_EQ(reward_of(loss), row + "    = reward-sums[word]\n");
    passes::Report report;
    const ir::Program program = with_rows(loss, 4, report);
    EXPECT_TRUE(table_text(program, "reward-sums")
                    .starts_with("reward-sums[16]: real = {5.25 -0.25 -3.75 -9.25 0.0 -5.5 "));
    EXPECT_EQ(report["sums of constants that bools choose looked up"], 1);
}

TEST(TabulateSums, CombinesTheBoolsOfAnObject) {
    EXPECT_EQ(reward_of("(" + robbed + " ^ ~shut(?o)) * GAIN(?o)"),
              row + "    = reward-sums[bit_and(word, bit_xor(bits(state.shut, 0), 15))]\n");
    EXPECT_EQ(reward_of("if (" + robbed +
                        " ^ ~(exists_{?t : pair} [guard(?o, ?t)])) then 1.0 else GAIN(?o)"),
              row +
                  "    for o in obj\n"
                  "        scratch.reward-bools[o] = exists[t in pair](action.guard[o, t])\n"
                  "    = reward-sums[bit_and(word, bit_xor(bits(scratch.reward-bools, 0), 15))]\n");
}

TEST(TabulateSums, AddsTheTermsBehindTheTable) {
    EXPECT_EQ(reward_of("if (" + robbed + ") then -5.0 else GAIN(?o)", 10),
              row +
                  "    = reward-sums[bit_and(word, 255)] + "
                  "reward-terms[bit_and(shift_right(word, 8), 1)] + "
                  "reward-terms[shift_right(word, 9)]\n");
}

TEST(TabulateSums, AddsFloatsAsSuch) {
    passes::Report report;
    const ir::Program program =
        with_rows("if (" + robbed + ") then 0.1 else 0.7", 4, report, RealType::Float);
    const auto sums = std::ranges::find(program.buffers, "reward-sums", &ir::Buffer::name);
    ASSERT_NE(sums, program.buffers.end());
    const float all = 0.1F + 0.1F + 0.1F + 0.1F, none = 0.7F + 0.7F + 0.7F + 0.7F;
    EXPECT_EQ(sums->values[0], ir::Value(double{none}));
    EXPECT_EQ(sums->values[15], ir::Value(double{all}));
    const ir::Program left =
        with_rows("0.7 * GAIN(?o) + 0.1 * " + robbed, 4, report, RealType::Float);
    EXPECT_EQ(table_text(left, "reward-sums"), "");
}

TEST(TabulateSums, LooksUpTheSumsOfAShortRowOfTheState) {
    const auto line_of = [](const std::string& reward, int objects) {
        passes::Report report;
        const std::string all = ir::print(with_rows(reward, objects, report));
        const std::size_t begin = all.find("\nreward = ") + 1;
        return all.substr(begin, all.find('\n', begin) - begin);
    };
    EXPECT_EQ(line_of("shut(?o) * GAIN(?o)", 8), "reward = reward-sums[bits(state.shut, 0)]");
    EXPECT_EQ(line_of("-(GAIN(?o) * ~shut(?o))", 5),
              "reward = reward-sums[bit_xor(bits(state.shut, 0), 31)]");
}

// Terms that more than bools decide, bools that are no ints, and many terms.
TEST(TabulateSums, LeavesOtherSums) {
    EXPECT_EQ(reward_of(robbed + " * GAIN(?o) * rank(?o)"),
              row +
                  "    = sum[o in obj](real(scratch.reward-row[o]) * GAIN[o] * "
                  "real(state.rank[o]))\n");
    for (const auto& [reward, objects] : {std::pair{std::string("shut(?o) * GAIN(?o)"), 9},
                                          std::pair{std::string("shut(?o) * GAIN(?o)"), 3},
                                          std::pair{robbed + " * GAIN(?o)", 20}}) {
        passes::Report report;
        const ir::Program program = with_rows(reward, objects, report);
        EXPECT_EQ(table_text(program, "reward-sums"), "");
    }
}

}  // namespace
}  // namespace rddlc
