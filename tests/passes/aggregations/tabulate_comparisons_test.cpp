#include "passes/aggregations/tabulate_comparisons.hpp"

#include "passes/aggregations/make_aggregations_sparse.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

Problem with_ints(const std::string& cpf_of_p) {
    return {.pvariables =
                "LINK(obj, obj) : { non-fluent, bool, default = false };\n"
                "p(obj) : { state-fluent, bool, default = false };\n"
                "k(obj, obj) : { state-fluent, int, default = 0 };",
            .cpfs = "p'(?o) = " + cpf_of_p + ";\nk'(?o, ?u) = k(?o, ?u) + 1;",
            .non_fluents = "LINK(b1, b2); LINK(b2, b3); LINK(b3, b1); LINK(b3, b2);"};
}

std::string compared_once(const std::string& cpf_of_p) {
    passes::Report report;
    ir::Program program = grounded(with_ints(cpf_of_p));
    program = passes::make_aggregations_sparse(std::move(program), report);
    program = valid(passes::tabulate_comparisons(std::move(program), report));
    return step_text(program);
}

TEST(TabulateComparisons, MakesEachComparisonOnce) {
    EXPECT_EQ(compared_once("exists_{?u : obj, ?v : obj} [LINK(?o, ?u) ^ k(?u, ?v) == 1]"),
              "for o in obj\n"
              "    for u in obj\n"
              "        next.k[o, u] = state.k[o, u] + 1\n"
              "for obj in obj\n"
              "    for obj in obj\n"
              "        scratch.k-bools[obj, obj] = state.k[obj, obj] == 1\n"
              "for o in obj\n"
              "    next.p[o] = bit_and(bits(scratch.k-bools, 0), LINK-bits[o]) != 0\n");
}

TEST(TabulateComparisons, LeavesWhatHasNoRowsOrIsCountedOtherwise) {
    EXPECT_EQ(compared_once("exists_{?u : obj, ?v : obj} [k(?u, ?v) == 1]").find("bools"),
              std::string::npos);
    EXPECT_EQ(compared_once("exists_{?u : obj} [LINK(?o, ?u) ^ k(?u, ?u) == 1]").find("bools"),
              std::string::npos);
    EXPECT_EQ(compared_once("exists_{?u : obj, ?v : obj} [LINK(?o, ?u) ^ k(?u, ?v) == k(?v, ?v)]")
                  .find("bools"),
              std::string::npos);
}

}  // namespace
}  // namespace rddlc
