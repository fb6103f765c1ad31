#include "passes/aggregations/count_bits.hpp"

#include "passes/aggregations/make_aggregations_sparse.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

ir::Program in_bits(ir::Program program) {
    passes::Report report;
    program = passes::make_aggregations_sparse(std::move(program), report);
    return valid(passes::count_bits(std::move(program), report));
}

// 3 by 3 links and states; `many` has more elements than an int has bits.
Problem with_bools(const std::string& cpf_of_x) {
    return {.pvariables =
                "LINK(obj, obj) : { non-fluent, bool, default = false };\n"
                "HEAVY(obj) : { non-fluent, bool, default = false };\n"
                "OPEN(obj, obj, obj) : { non-fluent, bool, default = false };\n"
                "x : { state-fluent, int, default = 0 };\n"
                "t : { state-fluent, obj };\n"
                "p(obj) : { state-fluent, bool, default = false };\n"
                "q(obj) : { state-fluent, bool, default = false };\n"
                "many(obj, obj, obj, obj) : { state-fluent, bool, default = false };\n"
                "s(obj, obj) : { state-fluent, bool, default = false };\n"
                "made(obj, obj) : { interm-fluent, bool };",
            .cpfs = "x' = " + cpf_of_x +
                    ";\nt' = t;\np'(?o) = p(?o);\nq'(?o) = q(?o);\n"
                    "many'(?o, ?u, ?v, ?w) = many(?o, ?u, ?v, ?w);\ns'(?o, ?u) = s(?o, ?u);\n"
                    "made(?o, ?u) = s(?o, ?u) ^ p(?u);",
            .non_fluents =
                "LINK(b1, b2); LINK(b2, b3); LINK(b3, b1); LINK(b3, b2); HEAVY(b2); "
                "OPEN(b1, b2, b1); OPEN(b3, b1, b1); OPEN(b2, b1, b3);",
            .init_state = "t = b1;"};
}

std::string counted_in_bits(const std::string& cpf_of_x) {
    return value_of_x(in_bits(grounded(with_bools(cpf_of_x))));
}

std::string table_in_bits(const std::string& cpf_of_x, const std::string& name) {
    return table_text(in_bits(grounded(with_bools(cpf_of_x))), name);
}

TEST(CountBits, CountsAllElements) {
    EXPECT_EQ(counted_in_bits("sum_{?o : obj, ?u : obj} [s(?o, ?u)]"),
              "count_ones(bits(state.s, 0))");
    EXPECT_EQ(counted_in_bits("sum_{?o : obj, ?u : obj} [~s(?o, ?u)]"),
              "count_ones(bit_and(bit_xor(bits(state.s, 0), -1), 511))");
}

TEST(CountBits, CountsThoseOfARow) {
    const std::string cpf = "max_{?v : obj} [sum_{?o : obj} [LINK(?v, ?o) ^ p(?o) ^ q(?o)]]";
    EXPECT_EQ(counted_in_bits(cpf),
              "max[v in obj](count_ones(bit_and(bit_and(bits(state.p, 0), bits(state.q, 0)), "
              "LINK-bits[v])))");
    EXPECT_EQ(table_in_bits(cpf, "LINK-bits"), "LINK-bits[obj]: int = {2 4 3}");
}

TEST(CountBits, TestsElements) {
    EXPECT_EQ(counted_in_bits("exists_{?o : obj} [p(?o) ^ ~q(?o) | HEAVY(?o)]"),
              "int(bit_or(bit_and(bits(state.p, 0), bit_xor(bits(state.q, 0), -1)), 2) != 0)");
    EXPECT_EQ(counted_in_bits("forall_{?o : obj} [p(?o) => q(?o)]"),
              "int(bit_and(bits(state.p, 0), bit_xor(bits(state.q, 0), -1)) == 0)");
    EXPECT_EQ(counted_in_bits("exists_{?o : obj} [~(p(?o) | q(?o))]"),
              "int(bit_and(bit_and(bit_xor(bits(state.p, 0), -1), bit_xor(bits(state.q, 0), -1)), "
              "7) != 0)");
    EXPECT_EQ(counted_in_bits("exists_{?o : obj} [p(?o) <=> q(?o)]"),
              "int(bit_and(bit_xor(bits(state.p, 0), bit_xor(bits(state.q, 0), -1)), 7) != 0)");
    EXPECT_EQ(counted_in_bits("forall_{?o : obj} [p(?o) <=> q(?o)]"),
              "int(bit_xor(bits(state.p, 0), bits(state.q, 0)) == 0)");
}

// A known condition is 0 where no element counts.
TEST(CountBits, ChoosesElementsOnce) {
    const std::string cpf = "max_{?v : obj} [exists_{?o : obj} [s(?v, ?o) ^ (?o ~= ?v)]]";
    EXPECT_EQ(counted_in_bits(cpf),
              "max[v in obj](int(bit_and(bits(state.s, 0), s-bits[v]) != 0))");
    EXPECT_EQ(table_in_bits(cpf, "s-bits"), "s-bits[obj]: int = {6 40 192}");
    EXPECT_EQ(counted_in_bits("max_{?v : obj} [forall_{?o : obj} [s(?v, ?o) | (?o == ?v)]]"),
              "max[v in obj](int(bit_and(bit_xor(bits(state.s, 0), -1), s-bits[v]) == 0))");
}

// An int that is an index of constant tables chooses the row.
TEST(CountBits, ChoosesRowsByAnInt) {
    const std::string cpf = "forall_{?o : obj, ?u : obj} [OPEN(?o, ?u, t) => ~s(?o, ?u)]";
    EXPECT_EQ(counted_in_bits(cpf), "int(bit_and(s-bits[state.t], bits(state.s, 0)) == 0)");
    EXPECT_EQ(table_in_bits(cpf, "s-bits"), "s-bits[3]: int = {66 0 8}");
    EXPECT_EQ(counted_in_bits("max_{?v : obj} [exists_{?o : obj, ?u : obj} "
                              "[s(?o, ?u) ^ OPEN(?v, ?o, t)]]"),
              "max[v in obj](int(bit_and(bits(state.s, 0), s-bits[v, state.t]) != 0))");
    EXPECT_EQ(counted_in_bits("exists_{?o : obj, ?u : obj} [s(?o, t) ^ OPEN(?o, ?u, t)]"),
              "int(bit_and(bits(state.s, 0), s-bits[state.t]) != 0)");
}

TEST(CountBits, TellsTwoIntsThatChooseRowsApart) {
    EXPECT_EQ(counted_in_bits("exists_{?o : obj, ?u : obj} [s(?o, ?u) ^ OPEN(?o, ?u, t) ^ "
                              "OPEN(?u, ?o, t')]"),
              "int(bit_and(bit_and(bits(state.s, 0), s-bits[state.t, next.t]), "
              "s-bits-2[state.t, next.t]) != 0)");
}

TEST(CountBits, TestsPartsByThemselves) {
    EXPECT_EQ(counted_in_bits("forall_{?o : obj, ?u : obj} [s(?o, ?u) ^ x > 2]"),
              "int(bit_and(bit_xor(bits(state.s, 0), -1), 511) == 0 && state.x > 2)");
    EXPECT_EQ(counted_in_bits("exists_{?o : obj, ?u : obj} [s(t, t) | s(?o, ?u) ^ ~s(?o, ?u)]"),
              "int(state.s[state.t, state.t] || "
              "bit_and(bits(state.s, 0), bit_xor(bits(state.s, 0), -1)) != 0)");
}

TEST(CountBits, TestsWhatIsTheSameForAllObjectsByItself) {
    EXPECT_EQ(counted_in_bits("exists_{?o : obj, ?u : obj} [s(?o, ?u) ^ x > 2]"),
              "int(state.x > 2 && bits(state.s, 0) != 0)");
    EXPECT_EQ(counted_in_bits("forall_{?o : obj, ?u : obj} [s(?o, ?u) => x > 2]"),
              "int(state.x > 2 || bits(state.s, 0) == 0)");
    // Rows of two tables have a test of their own.
    EXPECT_EQ(
        counted_in_bits("exists_{?o : obj, ?u : obj} [s(?o, ?u) ^ s(?u, ?o) ^ x > 2]").find("bits"),
        std::string::npos);
}

TEST(CountBits, TakesSeveralWords) {
    EXPECT_EQ(
        counted_in_bits("sum_{?o : obj, ?u : obj, ?v : obj, ?w : obj} [many(?o, ?u, ?v, ?w)]"),
        "count_ones(bits(state.many, 0)) + count_ones(bits(state.many, 64))");
    EXPECT_EQ(
        counted_in_bits("exists_{?o : obj, ?u : obj, ?v : obj, ?w : obj} [~many(?o, ?u, ?v, ?w)]"),
        "int(bit_or(bit_xor(bits(state.many, 0), -1), "
        "bit_and(bit_xor(bits(state.many, 64), -1), 131071)) != 0)");
}

TEST(CountBits, LeavesTablesSoSmallThatTheirBitsCostMoreThanTheySave) {
    EXPECT_EQ(counted_in_bits("sum_{?o : obj} [p(?o)]"), "sum[o in obj](int(state.p[o]))");
}

// Each bool is tested once, and bits would be made when all bools are there.
TEST(CountBits, LeavesShortRowsThatAStepMakes) {
    EXPECT_EQ(counted_in_bits("max_{?v : obj} [exists_{?o : obj} [s(?v, ?o)]]"),
              "max[v in obj](int(bit_and(bits(state.s, 0), s-bits[v]) != 0))");
    EXPECT_EQ(counted_in_bits("max_{?v : obj} [exists_{?o : obj} [made(?v, ?o)]]"),
              "max[v in obj](int(exists[o in obj](scratch.made[v, o])))");
    EXPECT_EQ(counted_in_bits("exists_{?o : obj, ?u : obj} [made(?u, ?o)]"),
              "int(bits(scratch.made, 0) != 0)");
}

// These terms are not the same element of all tables, not known before or not of bools, or counted
// twice.
TEST(CountBits, LeavesOtherAggregations) {
    for (const char* cpf :
         {"sum_{?o : obj, ?u : obj} [p(?o) ^ s(?o, ?u)]",
          "sum_{?o : obj, ?u : obj} [s(?u, ?o) ^ s(?o, ?u)]", "sum_{?o : obj} [s(t, ?o)]",
          "sum_{?o : obj} [x * p(?o)]", "sum_{?o : obj, ?u : obj} [LINK(?o, ?u) ^ p(?u)]",
          "max_{?o : obj} [p(?o)]"}) {
        const std::string text = counted_in_bits(cpf);
        EXPECT_EQ(text.find("bits("), text.npos) << text;
    }
}

// A bit stands for all entries that read its place. Otherwise each row is tested by itself.
TEST(CountBits, NeedsOneKnownValueForEachPlace) {
    EXPECT_EQ(counted_in_bits("exists_{?o : obj, ?u : obj} [LINK(?o, ?u) ^ (HEAVY(?u) ~= p(?u))]"),
              "int(bit_xor(2, bits(state.p, 0)) != 0)");
    EXPECT_EQ(counted_in_bits("exists_{?o : obj, ?u : obj} [LINK(?o, ?u) ~= p(?u)]"),
              "int(exists[o in obj](bit_xor(p-bits[o], bits(state.p, 0)) != 0))");
    EXPECT_EQ(
        counted_in_bits("forall_{?o : obj, ?u : obj} [LINK(?o, ?u) | (p(?u) ^ ~LINK(?u, ?o))]"),
        "int(forall[o in obj](bit_and(p-bits[o], "
        "bit_or(bit_xor(bits(state.p, 0), -1), p-bits-2[o])) == 0))");
    EXPECT_EQ(counted_in_bits("exists_{?o : obj, ?u : obj} [(LINK(?o, ?u) | HEAVY(?o)) ^ p(?u) ^ "
                              "(LINK(?u, ?o) | HEAVY(?u))]"),
              "int(exists[o in obj](bit_and(bit_and(p-bits[o], bits(state.p, 0)), p-bits-2[o]) "
              "!= 0))");
}

}  // namespace
}  // namespace rddlc
