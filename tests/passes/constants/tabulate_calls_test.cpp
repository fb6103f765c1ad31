#include "passes/constants/tabulate_calls.hpp"

#include "passes/sharing/remove_unused_buffers.hpp"
#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

Problem with_matrices(const std::string& cpf_of_x, const std::string& cpf_of_m,
                      const std::string& diagonal = "2.0") {
    return {.pvariables =
                "COV(obj, obj) : { non-fluent, real, default = 0.5 };\n"
                "x : { state-fluent, real, default = 0.0 };\n"
                "m(obj, obj) : { state-fluent, real, default = 0.0 };",
            .cpfs = "x' = " + cpf_of_x + ";\nm'(?r, ?c) = " + cpf_of_m + ";",
            .non_fluents = "COV(b1, b1) = " + diagonal + "; COV(b2, b2) = " + diagonal +
                           "; COV(b3, b3) = " + diagonal + ";"};
}

std::string tabulated(const Problem& problem) {
    passes::Report report;
    return step_text(valid(
        passes::remove_unused_buffers(passes::tabulate_calls(grounded(problem), report), report)));
}

TEST(TabulateCalls, CallsFunctionsOfConstantTables) {
    EXPECT_EQ(tabulated(with_matrices("x + det_{?r : obj, ?c : obj} [COV(?r, ?c)]", "m(?r, ?c)")),
              "for r in obj\n"
              "    for c in obj\n"
              "        next.m[r, c] = state.m[r, c]\n"
              "next.x = state.x + 6.75\n");
    // Nan stands for a matrix without an inverse.
    EXPECT_EQ(tabulated(with_matrices("x", "inverse[row=?r, col=?c][COV(?r, ?c)]", "0.5")),
              "for r in obj\n"
              "    for c in obj\n"
              "        next.m[r, c] = defined@0[0](inverse[r, c])\n"
              "next.x = state.x\n");
}

TEST(TabulateCalls, LeavesThoseOfTheState) {
    const std::string text = tabulated(
        with_matrices("x + det_{?r : obj, ?c : obj} [COV(?r, ?c) + m(?r, ?c)]", "m(?r, ?c)"));
    EXPECT_NE(text.find("fill scratch."), std::string::npos) << text;
}

}  // namespace
}  // namespace rddlc
