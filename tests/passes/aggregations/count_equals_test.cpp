#include "passes/aggregations/count_equals.hpp"

#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// The CPF of a bool after the pass; twenty objects show colors. A field has six bits, of which the
// highest is 0x20820 of all three.
std::string counted_equals(const std::string& cpf_of_found) {
    const Problem problem{
        .pvariables =
            "shown(obj) : { state-fluent, color, default = @red };\n"
            "height(obj) : { state-fluent, int, default = 0 };\n"
            "found : { state-fluent, bool, default = false };",
        .cpfs = "shown'(?o) = shown(?o); height'(?o) = height(?o); found' = " + cpf_of_found + ";"};
    passes::Report report;
    const std::string text =
        ir::print(valid(passes::count_equals(grounded_with_many(problem.text()), report)));
    const std::string start = "next.found = ";
    const std::size_t begin = text.find(start) + start.size();
    return text.substr(begin, text.find('\n', begin) - begin);
}

const std::string fields_of_shown = "sum[counted in 0 .. 20](found-field[state.shown[counted]])";
std::string at_least_so_many(int count) {
    return "bit_and(" + fields_of_shown + " + " + std::to_string((32 - count) * 0x1041) + ", " +
           std::to_string(0x20820) + ")";
}

TEST(CountEquals, CountsObjectsOfOneValue) {
    EXPECT_EQ(counted_equals("exists_{?o : obj, ?q : obj} [?o ~= ?q ^ shown(?o) == shown(?q)]"),
              at_least_so_many(2) + " != 0");
    EXPECT_EQ(
        counted_equals("exists_{?o : obj, ?q : obj, ?r : obj} [?o ~= ?q ^ ?r ~= ?o ^ ?q ~= ?r ^ "
                       "shown(?o) == shown(?q) ^ shown(?r) == shown(?q)]"),
        at_least_so_many(3) + " != 0");
}

TEST(CountEquals, NegatesAForall) {
    EXPECT_EQ(counted_equals("forall_{?o : obj, ?q : obj} [?o == ?q | shown(?o) ~= shown(?q)]"),
              at_least_so_many(2) + " == 0");
}

TEST(CountEquals, CountsTwoGroups) {
    const std::string different =
        "?o ~= ?q ^ ?o ~= ?r ^ ?o ~= ?s ^ ?q ~= ?r ^ ?q ~= ?s ^ ?r ~= ?s ^ ";
    const std::string two =
        "bit_and(" + at_least_so_many(2) + ", " + at_least_so_many(2) + " - 1) != 0";
    EXPECT_EQ(counted_equals("exists_{?o : obj, ?q : obj, ?r : obj, ?s : obj} [" + different +
                             "shown(?o) == shown(?q) ^ shown(?r) == shown(?s)]"),
              two + " || " + at_least_so_many(4) + " != 0");
    EXPECT_EQ(counted_equals("exists_{?o : obj, ?q : obj, ?r : obj, ?s : obj, ?t : obj} [" +
                             different + "?t ~= ?o ^ ?t ~= ?q ^ ?t ~= ?r ^ ?s ~= ?t ^ " +
                             "shown(?o) == shown(?q) ^ shown(?r) == shown(?s) ^ "
                             "shown(?t) == shown(?q)]"),
              two + " && " + at_least_so_many(3) + " != 0 || " + at_least_so_many(5) + " != 0");
}

TEST(CountEquals, LooksAtTheValueOfAGivenObject) {
    EXPECT_EQ(counted_equals("exists_{?o : obj} [height(?o) > 3 ^ "
                             "exists_{?q : obj} [?o ~= ?q ^ shown(?o) == shown(?q)]]"),
              "exists[o in obj](state.height[o] > 3 && bit_and(" + at_least_so_many(2) +
                  ", found-bit[state.shown[o]]) != 0)");
}

// Values without a range, of more than one expression; objects that may be the same; one without a
// partner; other conditions.
TEST(CountEquals, LeavesOthersAsTheyAre) {
    for (const std::string body :
         {"?o ~= ?q ^ height(?o) == height(?q)", "?o ~= ?q ^ shown(?o) == @red", "?o ~= ?q",
          "shown(?o) == shown(?q)", "?o ~= ?q ^ shown(?o) == shown(?q) ^ height(?o) > 3",
          "?o ~= ?q ^ shown(?o) == shown(?q) ^ exists_{?r : obj} [?r ~= ?o ^ shown(?r) == @red]"}) {
        const std::string text = counted_equals("exists_{?o : obj, ?q : obj} [" + body + "]");
        EXPECT_EQ(text.find("counted"), std::string::npos) << text;
    }
    const std::string alone = counted_equals(
        "exists_{?o : obj, ?q : obj, ?r : obj} [?o ~= ?q ^ ?o ~= ?r ^ ?q ~= ?r ^ "
        "shown(?o) == shown(?q)]");
    EXPECT_EQ(alone.find("counted"), std::string::npos) << alone;
}

}  // namespace
}  // namespace rddlc
