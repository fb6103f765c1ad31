#include "passes/aggregations/compare_cases.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

constexpr const char* stage = "if (n(?o) > 3) then 2 else if (p(?o)) then 1 else 0";

// A stage of each object, and a rank that is the stage or 0.
ir::Program with_stages(const std::string& cpf_of_stage, const std::string& cpf_of_q) {
    return grounded({.pvariables = "n(obj) : { state-fluent, int, default = 1 };\n"
                                   "p(obj) : { state-fluent, bool, default = false };\n"
                                   "q(obj) : { state-fluent, bool, default = false };\n"
                                   "stage(obj) : { interm-fluent, int };\n"
                                   "rank(obj) : { interm-fluent, int };",
                     .cpfs = "stage(?o) = " + cpf_of_stage +
                             "; rank(?o) = if (q(?o)) then stage(?o) else 0;"
                             "n'(?o) = n(?o); p'(?o) = p(?o); q'(?o) = " +
                             cpf_of_q + ";"});
}
std::string compared(const std::string& cpf_of_q) {
    passes::Report report;
    const ir::Program program = valid(passes::compare_cases(with_stages(stage, cpf_of_q), report));
    EXPECT_EQ(ir::print(passes::compare_cases(program, report)), ir::print(program));
    const std::string step = step_text(program);
    const std::string store = "next.q[o] = ";
    const std::size_t begin = step.find(store) + store.size();
    const std::string value = step.substr(begin, step.find('\n', begin) - begin);
    return step.find("scratch.") == step.npos ? value : step;
}

TEST(CompareCases, PutsConditionsInPlaceOfComparisons) {
    EXPECT_EQ(compared("rank(?o) == 2"), "state.q[o] && state.n[o] > 3");
    EXPECT_EQ(compared("rank(?o) >= 1"), "state.q[o] && (state.n[o] > 3 || state.p[o])");
    EXPECT_EQ(compared("1 == rank(?o)"), "state.q[o] && (state.n[o] <= 3 && state.p[o])");
    EXPECT_EQ(compared("rank(?o) == 0"), "!state.q[o] || state.n[o] <= 3 && !state.p[o]");
}

TEST(CompareCases, LeavesOutWhatAnotherComparisonImplies) {
    passes::Report report;
    const ir::Program program = passes::compare_cases(
        with_stages("if (n(?o) > 3) then 2 else if (n(?o) >= 2) then 1 else 0",
                    "stage(?o) == 0 ^ rank(?o) ~= 0"),
        report);
    EXPECT_NE(
        step_text(program).find("next.q[o] = state.n[o] < 2 && (state.q[o] && state.n[o] >= 2)"),
        std::string::npos)
        << step_text(program);
}

TEST(CompareCases, LeavesOtherInts) {
    const char* const cpfs[][2] = {
        {stage, "stage(?o) + rank(?o) == 2"},                              // not compared
        {stage, "rank(?o) == n(?o)"},                                      // with no constant
        {"n(?o) + 1", "rank(?o) == 2"},                                    // no choice
        {"if (Bernoulli(0.5)) then 1 else 0", "rank(?o) == 1"},            // draws
        {"if (exists_{?u : obj} [p(?u)]) then 1 else 0", "rank(?o) == 1"}  // looks at many
    };
    for (const auto& [cpf_of_stage, cpf_of_q] : cpfs) {
        passes::Report report;
        const ir::Program program =
            passes::compare_cases(with_stages(cpf_of_stage, cpf_of_q), report);
        EXPECT_NE(step_text(program).find("scratch.stage[o] = "), std::string::npos)
            << step_text(program);
    }
}

}  // namespace
}  // namespace rddlc
