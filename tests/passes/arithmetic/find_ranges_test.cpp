#include "passes/arithmetic/find_ranges.hpp"

#include "ir/rewrite.hpp"
#include "passes/aggregations/make_aggregations_sparse.hpp"
#include "texts.hpp"

#include <algorithm>

namespace rddlc {
namespace {

// `part` and `x` are computed; one of the nine entries of LINK is true.
Problem with_part(const std::string& part, const std::string& x) {
    return {.pvariables =
                "LINK(obj, obj) : { non-fluent, bool, default = false };\n"
                "N(obj) : { non-fluent, real, default = 2.0 };\n"
                "SOME(obj) : { non-fluent, real, default = 0.0 };\n"
                "v(obj) : { state-fluent, real, default = 1.0 };\n"
                "x(obj) : { state-fluent, real, default = 0.0 };\n"
                "part(obj) : { interm-fluent, real };\n"
                "a(obj) : { action-fluent, real, default = 0.0 };",
            .cpfs = "part(?o) = " + part + ";\nv'(?o) = v(?o) + a(?o);\nx'(?o) = " + x + ";",
            .non_fluents = "LINK(b1, b2); N(b2) = 4.0; SOME(b3) = 2.0;"};
}

bool is_known_finite(const ir::Program& program, const std::string& name, ir::Storage storage) {
    const auto found = std::ranges::find_if(program.buffers, [&](const ir::Buffer& buffer) {
        return buffer.name == name && buffer.storage == storage;
    });
    return found->range && is_finite(*found->range);
}

struct Found {
    bool part, next_x;
    bool operator==(const Found&) const = default;
};
Found found(const std::string& part, const std::string& x) {
    passes::Report report;
    const ir::Program program =
        valid(passes::find_ranges(of_moderate_values(with_part(part, x)), report));
    return {is_known_finite(program, "part", ir::Storage::Scratch),
            is_known_finite(program, "x", ir::Storage::Next)};
}

TEST(FindRanges, LooksAtTheValuesOfDivisors) {
    const Found all{true, true};
    EXPECT_EQ(found("v(?o) / (1.0 + sum_{?p : obj} [LINK(?o, ?p)])", "part(?o)"), all);
    EXPECT_EQ(found("v(?o) / (N(?o) - 3.0)", "x(?o) + part(?o)"), all);
}

TEST(FindRanges, LeavesWhatMayBeInfiniteOrNan) {
    const Found none{false, false};
    EXPECT_EQ(found("v(?o) / SOME(?o)", "x(?o) + part(?o)"), none);
    EXPECT_EQ(found("v(?o) / (v(?o) + 1.0)", "x(?o) + part(?o)"), none);
    EXPECT_EQ(found("v(?o) / (N(?o) - 4.0)", "x(?o) + part(?o)"), none);
    EXPECT_EQ(found("v(?o) / (N(?o) - 3.0) + exp[v(?o)]", "x(?o) + part(?o)"), none);
    EXPECT_EQ(found("v(?o) / (N(?o) - 3.0)", "x(?o) + 1.0 / x(?o)"), (Found{true, false}));
}

TEST(FindRanges, TakesNoNumberFromOutsideForFinite) {
    passes::Report report;
    const ir::Program program =
        passes::find_ranges(grounded(with_part("v(?o) / (N(?o) - 3.0)", "cos[part(?o)]")), report);
    EXPECT_FALSE(is_known_finite(program, "part", ir::Storage::Scratch));
    EXPECT_FALSE(is_known_finite(program, "x", ir::Storage::Next)) << "cos[inf] is nan";
}

// Ints have ranges as well: an interm-fluent that is drawn has the range of the draw.
TEST(FindRanges, KnowsTheValuesOfInts) {
    Problem problem{.pvariables =
                        "k : { interm-fluent, int };\n"
                        "x : { state-fluent, int, default = 0 };",
                    .cpfs = "k = 2 + Bernoulli(0.5);\nx' = if (k >= 2) then min[k, 9] else 7;"};
    passes::Report report;
    ir::Program program = valid(passes::find_ranges(grounded(problem), report));
    program = ir::rewrite(std::move(program), [](ir::Builder&, ir::NodeId, const ir::Node&) {
        return std::optional<ir::NodeId>();
    });
    EXPECT_EQ(value_of_x(program), "scratch.k");
}

// The pass is useful for this.
TEST(FindRanges, LetsSumsLeaveOutProductsWithZero) {
    const auto made_sparse = [](const std::string& part) {
        passes::Report report;
        const std::string sum = "sum_{?p : obj} [LINK(?p, ?o) * cos[part(?p)]]";
        ir::Program program = passes::find_ranges(of_moderate_values(with_part(part, sum)), report);
        report = {};
        program = passes::make_aggregations_sparse(std::move(program), report);
        return report["aggregations made sparse"];
    };
    EXPECT_EQ(made_sparse("v(?o) / (N(?o) - 3.0)"), 1);
    EXPECT_EQ(made_sparse("v(?o) / (N(?o) - 4.0)"), 0);
}

}  // namespace
}  // namespace rddlc
