#include "passes/aggregations/search_intervals.hpp"

#include "ir/evaluator.hpp"
#include "texts.hpp"

#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc {
namespace {

// Intervals [-1, 0), [0, 1), [2, 3); x and the level n are what is compared.
Problem with_intervals(const std::string& cpf_of_x) {
    return {.pvariables =
                "LEFT(obj) : { non-fluent, real, default = -1.0 };\n"
                "RIGHT(obj) : { non-fluent, real, default = 0.0 };\n"
                "SLOPE(obj) : { non-fluent, real, default = 0.5 };\n"
                "LEVEL(obj) : { non-fluent, int, default = 1 };\n"
                "x : { state-fluent, real, default = 0.0 };\n"
                "n : { state-fluent, int, default = 0 };\n"
                "v(obj) : { state-fluent, real, default = 0.0 };",
            .cpfs = "x' = " + cpf_of_x + "; n' = n; v'(?o) = v(?o);",
            .non_fluents =
                "LEFT(b2) = 0.0; RIGHT(b2) = 1.0; LEFT(b3) = 2.0; RIGHT(b3) = 3.0;"
                "SLOPE(b2) = -1.5; SLOPE(b3) = 4.0; LEVEL(b2) = 5; LEVEL(b3) = 7;"};
}

struct Searched {
    ir::Program before, after;
    passes::Report report;
};
Searched searched(const std::string& cpf_of_x, RealType real = RealType::Double) {
    Searched result{
        .before = of_moderate_values(with_intervals(cpf_of_x)), .after = {}, .report = {}};
    result.before.real = real;
    result.after = valid(passes::search_intervals(result.before, result.report));
    return result;
}

constexpr const char* slope = "sum_{?s : obj} [SLOPE(?s) * (x >= LEFT(?s) ^ x < RIGHT(?s))]";

TEST(SearchIntervals, LooksUpWhatIsConstantInEach) {
    const Searched x = searched(slope);
    EXPECT_EQ(value_of_x(x.before),
              "sum[s in obj](SLOPE[s] * real(state.x >= LEFT[s] && state.x < RIGHT[s]))");
    EXPECT_EQ(value_of_x(x.after), "x-values[search(x-breaks, state.x)]");
    EXPECT_EQ(table_text(x.after, "x-breaks"), "x-breaks[5]: real = {-1.0 0.0 1.0 2.0 3.0}");
    EXPECT_EQ(table_text(x.after, "x-values"), "x-values[6]: real = {0.0 0.5 -1.5 0.0 4.0 0.0}");
    EXPECT_EQ(x.report.at("aggregations made a search"), 1);
}

// The CPF of x for a value of x; n is 0 and v 1, 2, 3.
double next_x(const ir::Program& program, double value) {
    std::vector<double> state = {value, 0.0, 1.0, 2.0, 3.0};
    std::vector<double> next(5);
    Context context;
    const ir::Evaluator evaluator(program);
    ir::Records records;
    records.set(ir::Storage::State, reinterpret_cast<const std::byte*>(state.data()));
    records.set(ir::Storage::Next, reinterpret_cast<const std::byte*>(next.data()));
    ir::Evaluator::Frame frame(evaluator, records, context);
    evaluator.run(program.step.front().body, frame);
    EXPECT_FALSE(context.fault);
    return next[0];
}

TEST(SearchIntervals, IsExactAtTheEndsAndForAllThatIsNoNumber) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const char* text : {slope, "sum_{?s : obj} [SLOPE(?s) * (x > LEFT(?s) ^ x <= RIGHT(?s))]",
                             "sum_{?s : obj} [SLOPE(?s) * (LEFT(?s) == x | RIGHT(?s) < x)]",
                             "sum_{?s : obj} [v(?s) * (x > LEFT(?s) ^ RIGHT(?s) >= x)]",
                             "max_{?s : obj} [SLOPE(?s) * (x ~= RIGHT(?s))]"}) {
        const Searched x = searched(text);
        EXPECT_NE(value_of_x(x.after).find("search("), std::string::npos) << text;
        for (double end : {-1.0, 0.0, -0.0, 1.0, 2.0, 3.0, infinity, -infinity, std::nan("")}) {
            for (double value :
                 {std::nextafter(end, -infinity), end, std::nextafter(end, infinity)})
                EXPECT_EQ(next_x(x.before, value), next_x(x.after, value)) << text << " " << value;
        }
    }
}

// A float that compares equal to 0.1f is found where x >= 0.1 begins, and x <= 0.1 ends behind it.
TEST(SearchIntervals, FindsTheIntervalsOfFloats) {
    const Searched x =
        searched("sum_{?s : obj} [SLOPE(?s) * (x >= LEFT(?s) + 1.1 ^ x <= RIGHT(?s) + 1.0)]",
                 RealType::Float);
    EXPECT_EQ(value_of_x(x.after), "x-values[search(x-breaks, state.x)]");
    EXPECT_EQ(table_text(x.after, "x-breaks"),
              "x-breaks[6]: real = {0.10000000149011612 1.0000001192092896 1.100000023841858 "
              "2.000000238418579 3.0999999046325684 4.000000476837158}");
}

TEST(SearchIntervals, LeavesIntervalsThatAreOneFloat) {
    const std::string text =
        "sum_{?s : obj} [SLOPE(?s) * (x > 1.0 ^ x < 1.0 + 0.000000000001 * abs[SLOPE(?s)])]";
    EXPECT_NE(value_of_x(searched(text).after).find("search("), std::string::npos);
    const Searched x = searched(text, RealType::Float);
    EXPECT_EQ(value_of_x(x.after), value_of_x(x.before));
}

TEST(SearchIntervals, TakesTheObjectOfTheInterval) {
    const Searched x = searched("sum_{?s : obj} [(x >= LEFT(?s) ^ x < RIGHT(?s)) * (v(?s) + x)]");
    EXPECT_EQ(value_of_x(x.after),
              "0.0 + select(x-is-there[search(x-breaks, state.x)], "
              "state.v[x-object[search(x-breaks, state.x)]] + state.x, 0.0)");
    EXPECT_EQ(table_text(x.after, "x-object"), "x-object[6]: int = {0 0 1 0 2 0}");
}

TEST(SearchIntervals, WorksForInts) {
    const Searched x = searched("sum_{?s : obj} [SLOPE(?s) * (n > LEVEL(?s) ^ n ~= 6)]");
    EXPECT_EQ(value_of_x(x.after), "n-values[search(n-breaks, state.n)]");
    EXPECT_EQ(table_text(x.after, "n-breaks"), "n-breaks[4]: int = {2 6 7 8}");
}

TEST(SearchIntervals, LeavesOverlappingIntervalsOfWhatIsNotConstant) {
    const Searched x = searched("sum_{?s : obj} [(x >= LEFT(?s)) * v(?s)]");
    EXPECT_EQ(value_of_x(x.after), value_of_x(x.before));
}

TEST(SearchIntervals, LeavesWhatDependsOnNan) {
    const Searched x = searched(
        "sum_{?s : obj} [SLOPE(?s) * ~(x >= LEFT(?s) ^ x < RIGHT(?s))"
        " + SLOPE(?s) * (x < LEFT(?s))]");
    EXPECT_EQ(value_of_x(x.after), value_of_x(x.before));
}

TEST(SearchIntervals, LeavesSingleComparisons) {
    const Searched x = searched("if (x >= 1.0 ^ x < 2.0) then 3.0 else 4.0");
    EXPECT_EQ(value_of_x(x.after), value_of_x(x.before));
}

}  // namespace
}  // namespace rddlc
