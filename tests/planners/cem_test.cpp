#include "planners/cem/courses.hpp"
#include "planning.hpp"
#include "solvers/spaces/actions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace rddlc::planners {
namespace {

TEST(Cem, FindsTheOptimumOfAMixedProblem) {
    for (const std::string weights : {"elites", "mppi"}) {
        SCOPED_TRACE(weights);
        const Played course = run(target(), "plan:cem,iterations=30,weights=" + weights);
        EXPECT_LE(course.mean(), -0.116 + 1e-9);
        EXPECT_NEAR(course.mean(), -0.116, weights == "elites" ? 1e-4 : 5e-3);
    }
    const Played course = run(target(), "plan:cem,iterations=30");
    double move = 0;
    std::memcpy(&move, chosen_action(course.thought(0, 0)), sizeof move);  // the first fluent
    EXPECT_NEAR(move, 0.36, 0.01);
    EXPECT_EQ(course.thought(0, 0).depth, 2);
    EXPECT_EQ(course.thought(0, 0).iterations, 30);
}

// The flag of the car is not within 40 steps, and until then nothing is better than no-op.
TEST(Cem, LooksAsFarAsNeeded) {
    const Played course = run(car(), "plan:cem,iterations=8");
    EXPECT_GT(course.thought(0, 0).depth, 40);
    EXPECT_GT(course.mean(), 80);
    EXPECT_EQ(run(car(), "plan:cem,iterations=8,horizon=20").thought(0, 0).depth, 20);
}

// With luck to draw, what is chosen is compared by many draws; no-op is always among them.
TEST(Cem, KnowsWhatNoopIsWorth) {
    const Played course = run(network(), "plan:cem,iterations=2,population=64");
    const Thoughts& thoughts = course.thought(0, 0);
    EXPECT_TRUE(
        std::ranges::any_of(thoughts.candidates, [](const auto& c) { return c.name == "noop"; }));
    for (const Thoughts::Candidate& candidate : thoughts.candidates)
        EXPECT_LE(candidate.value, thoughts.candidates[thoughts.chosen].value);
    EXPECT_GT(thoughts.candidates[thoughts.chosen].trials, 4);
    EXPECT_GT(thoughts.candidates[thoughts.chosen].error, 0);
}

TEST(Cem, TakesThePolicyThatItIsGiven) {
    const Played course = run(reservoir(), "plan:cem,iterations=1,population=16,policy=random");
    EXPECT_TRUE(std::ranges::any_of(course.thought(0, 0).candidates,
                                    [](const auto& c) { return c.name == "policy"; }));
    EXPECT_EQ(course.summary.illegal_actions, 0);
}

TEST(Courses, ReadWhatTheyWrite) {
    for (const rddl_simulator* simulator :
         {&target(), &ladder(), &network(), &reservoir(), &car()}) {
        SCOPED_TRACE(simulator->problem->domain);
        const solvers::ActionSpace space = solvers::action_space(*simulator);
        Distribution distribution(space, {});
        distribution.restart(20);
        distribution.prepare();
        Course drawn, read;
        drawn.numbers.resize(static_cast<std::size_t>(20 * space.real_count()));
        drawn.indices.resize(static_cast<std::size_t>(20 * space.index_count()));
        read = drawn;
        Luck luck(1, 2, 3);
        distribution.draw(luck, 0.5, drawn);
        std::vector<float> row(static_cast<std::size_t>(space.column_count)), again = row;
        int different = 0;
        for (int t = 0; t < 20; ++t) {
            const auto write = [&](const Course& course, std::vector<float>& values) {
                solvers::write_action(space, course.numbers.data() + t * space.real_count(),
                                      course.indices.data() + t * space.index_count(),
                                      values.data());
            };
            write(drawn, row);
            read_action(space, row.data(), read.numbers.data() + t * space.real_count(),
                        read.indices.data() + t * space.index_count());
            write(read, again);
            for (std::size_t c = 0; c < row.size(); ++c)
                EXPECT_NEAR(row[c], again[c], 1e-4 * (1 + std::abs(row[c])));
            different += row != space.defaults;
        }
        EXPECT_GT(different, 5);
    }
}

// A fit to courses that all do the same gives that as its middle.
TEST(Courses, AreFitted) {
    for (const rddl_simulator* simulator : {&target(), &ladder(), &network()}) {
        SCOPED_TRACE(simulator->problem->domain);
        const solvers::ActionSpace space = solvers::action_space(*simulator);
        Distribution distribution(space, {});
        distribution.restart(5);
        distribution.prepare();
        Course drawn;
        drawn.numbers.resize(static_cast<std::size_t>(5 * space.real_count()));
        drawn.indices.resize(static_cast<std::size_t>(5 * space.index_count()));
        Course middle = drawn;
        Luck luck(1, 2, 3);
        distribution.draw(luck, 0, drawn);
        const Course* const all[] = {&drawn, &drawn};
        const double weights[] = {0.25, 0.75};
        for (int i = 0; i < 20; ++i) distribution.fit(all, weights, 0.2, false);
        distribution.middle(middle);
        for (std::size_t k = 0; k < drawn.numbers.size(); ++k)
            EXPECT_NEAR(middle.numbers[k], drawn.numbers[k], 1e-5);
        if (space.picks == 0) {
            EXPECT_EQ(middle.indices, drawn.indices);
        }
    }
}

TEST(Luck, HasMeanZeroAndDeviationOne) {
    Luck luck(1, 2, 3);
    double sum = 0, squares = 0, units = 0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i) {
        const double x = static_cast<double>(luck.bell());
        sum += x;
        squares += x * x;
        units += luck.unit();
    }
    EXPECT_NEAR(sum / n, 0, 0.015);  // 5 standard errors
    EXPECT_NEAR(squares / n, 1, 0.02);
    EXPECT_NEAR(units / n, 0.5, 0.005);
    EXPECT_NE(Luck(1, 2, 3).bits(), Luck(1, 2, 4).bits());
    EXPECT_NE(Luck(1, 2, 3).bits(), Luck(1, 3, 3).bits());
    EXPECT_NE(Luck(1, 2, 3).bits(), Luck(2, 2, 3).bits());
}

}  // namespace
}  // namespace rddlc::planners
