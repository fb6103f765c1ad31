#include "passes/aggregations/count_factors.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

TEST(CountFactors, LooksUpPowersByACount) {
    const auto after = [](const std::string& cpf) {
        return of_x(cpf, passes::count_factors).after;
    };
    EXPECT_EQ(after("prod_{?a : obj} [if (p(?a)) then 0.4 else 1.0]"),
              "p-powers[sum[a in obj](int(state.p[a]))]");
    EXPECT_EQ(after("prod_{?a : obj} [if (p(?a)) then 1.0 else 0.4]"),
              "p-powers[sum[a in obj](int(!state.p[a]))]");
}

TEST(CountFactors, MultipliesOneAfterTheOther) {
    passes::Report report;
    const ir::Program program = valid(passes::count_factors(
        grounded(with_tables("prod_{?a : obj} [if (p(?a)) then 0.1 else 1.0]")), report));
    for (const ir::Buffer& buffer : program.buffers) {
        if (buffer.name != "p-powers") continue;
        EXPECT_TRUE(are_identical(buffer.values.dense(),
                                  std::vector<Value>{1.0, 0.1, 0.1 * 0.1, 0.1 * 0.1 * 0.1}));
    }
}

TEST(CountFactors, LeavesOtherProducts) {
    for (const char* cpf :
         {"prod_{?a : obj} [if (p(?a)) then 0.4 else 2.0]", "prod_{?a : obj} [v(?a)]",
          "sum_{?a : obj} [if (p(?a)) then 0.4 else 1.0]"}) {
        const Texts x = of_x(cpf, passes::count_factors);
        EXPECT_EQ(x.before, x.after);
    }
}

}  // namespace
}  // namespace rddlc
