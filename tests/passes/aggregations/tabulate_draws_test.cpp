#include "passes/aggregations/tabulate_draws.hpp"

#include "passes/aggregations/tabulate_counts.hpp"
#include "texts.hpp"

#include <algorithm>

namespace rddlc {
namespace {

// x' for each object, since elements of tables are those of an object.
ir::Program with_draw_tables(const std::string& cpf_of_v) {
    Problem problem = with_tables("x");
    const std::string kept = "v'(?o) = v(?o)";
    problem.cpfs.replace(problem.cpfs.find(kept), kept.size(), "v'(?o) = " + cpf_of_v);
    passes::Report report;
    return valid(passes::tabulate_draws(grounded(problem), report));
}
std::string value_of_v(const ir::Program& program) {
    const std::string text = ir::print(program);
    const std::string target = "next.v[o] = ";
    const std::size_t begin = text.find(target) + target.size();
    return text.substr(begin, text.find('\n', begin) - begin);
}

TEST(TabulateDraws, LooksUpWhatDependsOnADrawAndAnElement) {
    const ir::Program program =
        with_draw_tables("min[floor[2.5 * W(?o) + Bernoulli(0.5)], 9] + v(?o)");
    EXPECT_EQ(value_of_v(program), "v-by-draw[o, int(sample bernoulli@0[o](0.5))] + state.v[o]");
    const auto table = *std::ranges::find(program.buffers, "v-by-draw", &ir::Buffer::name);
    EXPECT_EQ(table.shape, (std::vector<std::int64_t>{3, 2}));
    const std::vector<double> values{2, 3, 9, 9, 2, 3};  // W is 1.0, 4.0 and 1.0
    EXPECT_EQ(table.values, std::vector<ir::Value>(values.begin(), values.end()));
}

TEST(TabulateDraws, LeavesWhatIsCheapOrDependsOnMore) {
    for (const char* const cpf : {"W(?o) + Bernoulli(0.5)", "abs[(W(?o) + Bernoulli(0.5)) * v(?o)]",
                                  "abs[exp[W(?o) * Bernoulli(0.5) + Bernoulli(0.25)]]",
                                  "abs[exp[W(?o) * SAME(?o) * Normal(0.0, 1.0)]]"}) {
        const std::string text = value_of_v(with_draw_tables(cpf));
        EXPECT_EQ(text.find("by-draw"), std::string::npos) << text;
    }
}

TEST(TabulateDraws, KeepsFaults) {
    const std::string text =
        value_of_v(with_draw_tables("1 + 3 * abs[pow[2, E(?o) + Bernoulli(0.5)]]"));
    EXPECT_EQ(text.find("by-draw"), std::string::npos) << text;
}

// A counter may have another value than those of the table, and then nothing is looked up.
TEST(TabulateDraws, ComputesWhatTheTableOfACounterDoesNotHave) {
    Problem problem = with_tables("floor[8.0 * sin[c / 2.0] + Bernoulli(0.5)] * 0.25");
    problem.pvariables += "c : { state-fluent, int, default = 0 };";
    problem.cpfs += "c' = c + 1;";
    passes::Report report;
    ir::Program program = passes::tabulate_counts(grounded(problem), report);
    program = valid(passes::tabulate_draws(std::move(program), report));
    EXPECT_EQ(report["expressions of a draw made tables"], 1);
    EXPECT_EQ(value_of_x(program),
              "select mostly first(state.c >= 0 && state.c <= 10, "
              "x-by-draw[maximum(minimum(state.c, 10), 0), int(sample bernoulli@0[0](0.5))], "
              "real(floor(8.0 * sin(real(state.c) / 2.0) + real(sample bernoulli@0[0](0.5)))) * "
              "0.25)");
}

}  // namespace
}  // namespace rddlc
