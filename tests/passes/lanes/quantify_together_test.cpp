#include "passes/lanes/quantify_together.hpp"

#include "passes/lanes/evaluate_together.hpp"
#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// An interm-fluent of nine pairs of reals, and one that is computed from it.
Problem with_interm(const std::string& any, const std::string& pvariables = "",
                    const std::string& cpfs = "") {
    return {.pvariables =
                "v(obj, obj) : { state-fluent, real, default = 0.0 };\n"
                "on : { state-fluent, bool, default = false };\n"
                "w(obj) : { state-fluent, real, default = 0.0 };\n"
                "near(obj) : { interm-fluent, bool };\n"
                "far(obj, obj) : { interm-fluent, bool };\n" +
                pvariables,
            .cpfs =
                "v'(?x, ?y) = v(?x, ?y);\nw'(?x) = w(?x);\n"
                "near(?x) = w(?x) > 1.0;\nfar(?x, ?y) = v(?x, ?y) > 2.0;\non' = " +
                any + ";" + cpfs};
}

ir::Program quantified(const Problem& problem, passes::Report& report) {
    return valid(passes::quantify_together(
        valid(passes::evaluate_together(grounded_with_many(problem), report)), report));
}

TEST(QuantifyTogether, FindsInLoopsWhetherBoolsHold) {
    for (const auto& [any, loop] :
         {std::pair{"exists_{?x : obj} [near(?x)]",
                    "    scratch.near-exists = false\n"
                    "    for x in obj, several at once\n"
                    "        scratch.near-exists = scratch.near-exists || state.w[x] > 1.0\n"},
          std::pair{"~on | forall_{?x : obj} [near(?x)]",
                    "    scratch.near-forall = true\n"
                    "    for x in obj, several at once\n"
                    "        scratch.near-forall = scratch.near-forall && state.w[x] > 1.0\n"}}) {
        passes::Report report;
        const std::string text = ir::print(quantified(with_interm(any), report));
        EXPECT_EQ(report["quantifiers over several objects at once"], 1) << any;
        EXPECT_NE(text.find(loop), std::string::npos) << text;
        EXPECT_EQ(text.find("scratch.near["), std::string::npos) << text;
    }
}

TEST(QuantifyTogether, LeavesTablesThatHaveOtherReaders) {
    for (const auto& [any, cpfs] :
         {std::pair{"[exists_{?x : obj} [near(?x)]] & [forall_{?x : obj} [near(?x)]]", ""},
          std::pair{"exists_{?x : obj} [near(?x)]", "\nk'(?x) = near(?x);"},
          std::pair{"exists_{?x : obj} [near(?x) & w(?x) > 3.0]", ""},
          std::pair{"(sum_{?x : obj} [near(?x)]) > 2", ""}}) {
        passes::Report report;
        quantified(with_interm(any, "k(obj) : { state-fluent, bool, default = false };",
                               *cpfs ? cpfs : "\nk'(?x) = k(?x);"),
                   report);
        EXPECT_EQ(report["quantifiers over several objects at once"], 0) << any;
    }
}

TEST(QuantifyTogether, FindsOneInTheLoopOfAnother) {
    passes::Report report;
    const std::string text = ir::print(
        quantified(with_interm("forall_{?x : obj} [low(?x)]", "low(obj) : { interm-fluent, bool };",
                               "\nlow(?x) = w(?x) < 2.0 | exists_{?y : obj} [near(?y)];"),
                   report));
    EXPECT_EQ(report["quantifiers over several objects at once"], 2) << text;
    EXPECT_NE(text.find("scratch.low-forall && "), std::string::npos) << text;
    EXPECT_NE(text.find("scratch.near-exists)"), std::string::npos) << text;
}

// A draw needs no table, but the random numbers of neighbours are made for many objects.
TEST(QuantifyTogether, LeavesDraws) {
    Problem problem = with_interm("exists_{?x : obj} [near(?x)]");
    const std::string fluent = "near(?x) = w(?x) > 1.0";
    problem.cpfs.replace(problem.cpfs.find(fluent), fluent.size(),
                         "near(?x) = Normal(w(?x), 1.0) > 1.0");
    passes::Report report;
    quantified(problem, report);
    EXPECT_EQ(report["quantifiers over several objects at once"], 0);
}

}  // namespace
}  // namespace rddlc
