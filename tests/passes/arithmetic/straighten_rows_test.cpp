#include "passes/arithmetic/straighten_rows.hpp"

#include "texts.hpp"

#include <cmath>
#include <vector>

namespace rddlc {
namespace {

std::vector<ir::Value> reals(const std::vector<double>& values) {
    return {values.begin(), values.end()};
}

ir::Program with_rows(const std::vector<double>& values, std::int64_t cases) {
    ir::Program program = grounded(with_tables("x"));
    program.buffers.push_back({.name = "x-by-count",
                               .storage = ir::Storage::Constant,
                               .scalar = ir::Scalar::Real,
                               .shape = {std::ssize(values) / cases, cases},
                               .values = reals(values),
                               .span = {}});
    return program;
}

// The rows that become of these, and whether the pass says that it has made lines of them.
struct Rows {
    std::vector<ir::Value> values;
    bool are_lines;
};
Rows straightened(ir::Program program) {
    passes::Report report;
    program = valid(passes::straighten_rows(std::move(program), report));
    return {program.buffers.back().values.dense(), report["tables of lines"] == 1};
}
Rows straightened(const std::vector<double>& values, std::int64_t cases) {
    return straightened(with_rows(values, cases));
}

TEST(StraightenRows, MakesLinesOfWhatIsRoundedOtherwise) {
    const std::vector<double> rounded{0.1 + 0.3,
                                      0.5,
                                      0.6000000000000001,
                                      0.7000000000000001,  //
                                      1,
                                      2,
                                      3,
                                      4};
    const auto [values, are_lines] = straightened(rounded, 4);
    EXPECT_TRUE(are_lines);
    for (std::size_t line : {0, 4}) {
        const double first = std::get<double>(values[line]);
        const double rise = std::get<double>(values[line + 1]) - first;
        for (std::size_t count = 0; count < 4; ++count) {
            EXPECT_EQ(values[line + count], ir::Value(first + rise * static_cast<double>(count)));
            EXPECT_NEAR(std::get<double>(values[line + count]), rounded[line + count], 1e-15);
        }
    }
}

TEST(StraightenRows, RepeatsTheLastElement) {
    const std::vector<double> rows{0.25, 0.5, 0.5, 0.5, 0.25, 0.5, 0.75, 0.75, 1, 1, 1, 1};
    EXPECT_FALSE(straightened(rows, 4).are_lines);  // they are lines already
    std::vector<double> nearly = rows;
    nearly[2] = std::nextafter(nearly[2], 1.0);
    const auto [values, are_lines] = straightened(nearly, 4);
    EXPECT_TRUE(are_lines);
    EXPECT_EQ(values, reals(rows));
}

TEST(StraightenRows, ComputesAsTheSimulatorDoes) {
    const std::vector<double> tenths{0.0, 0.1, 0.2, 0.3, 0.4};
    ir::Program program = with_rows(tenths, 5);
    program.real = RealType::Float;
    const auto [values, are_lines] = straightened(std::move(program));
    EXPECT_TRUE(are_lines);
    for (std::size_t count = 0; count < 5; ++count)
        EXPECT_EQ(values[count], ir::Value(double{0.1f * static_cast<float>(count)}));
}

TEST(StraightenRows, LeavesTheOthers) {
    for (const std::vector<double>& rows :
         {std::vector{0.0, 1.0, 2.0, 3.0001}, std::vector{3.0, 2.0, 1.0, 0.0},
          std::vector{0.0, 1.0, 4.0, 9.0}, std::vector{0.0, 1.0, 1.0 / 0.0, 1.0 / 0.0}}) {
        const auto [values, are_lines] = straightened(rows, 4);
        EXPECT_FALSE(are_lines);
        EXPECT_EQ(values, reals(rows));
    }
}

TEST(StraightenRows, LeavesTheTablesOfTheProblem) {
    ir::Program program = with_rows({0.1 + 0.2, 0.4, 0.5, 0.6}, 4);
    program.buffers.back().fluent = 0;
    EXPECT_FALSE(straightened(std::move(program)).are_lines);
}

}  // namespace
}  // namespace rddlc
