// Learning curves from rows of progress.csv.
#include "learning/learning_curves.hpp"

#include "support/failure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rddlc::workbench {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

RunProgress run_of(std::vector<double> x, std::vector<double> y) {
    return {"run", {"steps", "return"}, {std::move(x), std::move(y)}};
}

TEST(LearningCurves, KeepThePointsOfOneRun) {
    const Curve curve =
        curve_of("one", {run_of({1, 2, 3, 4}, {missing, 5, missing, 7})}, "steps", "return");
    EXPECT_EQ(curve.x, (std::vector<double>{2, 4}));
    EXPECT_EQ(curve.mean, (std::vector<double>{5, 7}));
    EXPECT_EQ(curve.deviation, (std::vector<double>{0, 0}));
}

// Read where all have begun; between points on the line, beyond the last its value.
TEST(LearningCurves, AreMeansOfSeveralRuns) {
    const Curve curve =
        curve_of("both", {run_of({0, 10}, {0, 10}), run_of({2, 4}, {3, 3})}, "steps", "return");
    EXPECT_EQ(curve.runs, 2);
    EXPECT_EQ(curve.x.front(), 2);
    EXPECT_EQ(curve.x.back(), 10);
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
        EXPECT_NEAR(curve.mean[i], (curve.x[i] + 3) / 2, 1e-12);
        EXPECT_NEAR(curve.deviation[i], std::abs(curve.x[i] - 3) / std::sqrt(2), 1e-12);
    }
}

TEST(LearningCurves, RefuseWhatIsNotThere) {
    EXPECT_THROW(curve_of("one", {run_of({1}, {1})}, "steps", "loss"), Failure);
    EXPECT_THROW(curve_of("one", {run_of({1, 2}, {missing, missing})}, "steps", "return"), Failure);
    EXPECT_THROW(curve_of("one", {run_of({2, 1}, {1, 2})}, "steps", "return"), Failure);
    EXPECT_THROW(read_progress("/nowhere"), Failure);
}

TEST(LearningCurves, AreOfRunsThatDifferInTheSeed) {
    EXPECT_EQ(without_seed("runs/car_ppo_12", 12), "runs/car_ppo");
    EXPECT_EQ(without_seed("runs/car_ppo_12", 2), "runs/car_ppo_12");
    EXPECT_EQ(without_seed("runs/lambda_8", 0), "runs/lambda_8");
    EXPECT_EQ(without_seed("runs/a2", 2), "runs/a2");
    EXPECT_EQ(without_seed("_7", 7), "_7");
}

}  // namespace
}  // namespace rddlc::workbench
