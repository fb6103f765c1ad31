#include "planners/gradient/gradient.hpp"

#include "derivatives.hpp"
#include "planners/gradient/action_parameters.hpp"
#include "planning.hpp"
#include "solvers/batches/batch.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <thread>

namespace rddlc::planners {
namespace {

namespace fs = std::filesystem;

Played run_gradient(const rddl_simulator& simulator, const fs::path& folder,
                    const std::string& options, std::int64_t episodes = 1, int threads = 1,
                    std::int64_t memory_limit = default_memory_limit) {
    return run(simulator, "plan:gradient," + options, episodes, threads, 0, derivatives_in(folder),
               memory_limit);
}

TEST(Gradient, FindsTheOptimumOfAMixedProblem) {
    const Played plan = run_gradient(target(), PROBLEMS "/target", "iterations=200");
    EXPECT_NEAR(plan.mean(), -0.116, 2e-3);
    double move = 0;
    std::memcpy(&move, chosen_action(plan.thought(0, 0)), sizeof move);
    EXPECT_NEAR(move, 0.36, 0.03);
    EXPECT_EQ(plan.thought(0, 0).depth, 2);
    EXPECT_EQ(plan.thought(0, 0).iterations, 200);
}

TEST(Gradient, IsBetterThanNoop) {
    const double noop =
        solvers::summary_of(
            solvers::run_episodes(reservoir(), solvers::noop_policy(reservoir()), {}, {}))
            .undiscounted_return.mean;
    const Played plan = run_gradient(reservoir(), EXAMPLES "/reservoir", "iterations=5,horizon=10");
    EXPECT_GT(plan.mean(), noop);
    EXPECT_EQ(plan.summary.illegal_actions, 0);
}

TEST(Gradient, SameIterationsGiveTheSameActionsOnAnyNumberOfThreads) {
    const auto options = "iterations=3,horizon=8";
    const Played one = run_gradient(network(), EXAMPLES "/network", options, 3, 1);
    const Played two = run_gradient(network(), EXAMPLES "/network", options, 3, 2);
    EXPECT_EQ(one.returns(), two.returns());
    ASSERT_FALSE(one.explanation.empty());
    for (const auto& [place, explanation] : one.explanation)
        EXPECT_EQ(explanation.candidates.at(0).action,
                  two.explanation.at(place).candidates.at(0).action);
}

TEST(Gradient, ActsWithinAnyBudgetAndLegally) {
    const std::pair<const rddl_simulator*, const char*> problems[] = {
        {&network(), "/network"}, {&reservoir(), "/reservoir"}, {&car(), "/mountain_car"}};
    for (const auto& [simulator, folder] : problems)
        for (const std::string budget : {"steps=1", "steps=100", "seconds=0", "steps=3000"}) {
            const Played plan = run_gradient(*simulator, std::string(EXAMPLES) + folder, budget);
            EXPECT_EQ(plan.summary.illegal_actions, 0) << folder << budget;
            EXPECT_EQ(plan.summary.episodes, 1) << folder << budget;
            ASSERT_FALSE(plan.explanation.empty()) << folder << budget;
            if (!budget.starts_with("steps=")) continue;
            for (const auto& [place, explanation] : plan.explanation)
                EXPECT_LE(explanation.steps, std::stoll(budget.substr(6))) << folder << budget;
        }
}

// A straight-line plan: one search, whose plan is played to the end.
TEST(Gradient, MakesStepsByOnePlan) {
    const Played plan =
        run_gradient(target(), PROBLEMS "/target", "iterations=200,replan=2,horizon=2");
    EXPECT_EQ(plan.thought(0, 0).iterations, 200);
    EXPECT_EQ(plan.thought(0, 1).iterations, 0);
    EXPECT_EQ(plan.thought(0, 1).note, "goes on by the plan of an earlier step");
    EXPECT_NEAR(plan.mean(), -0.116, 2e-3);
}

TEST(Gradient, SaysWhatItNeeds) {
    try {
        run(target(), "plan:gradient");
        FAIL() << "it found derivatives";
    } catch (const Failure& failure) {
        EXPECT_EQ(std::string(failure.what()),
                  "plan:gradient needs the RDDL text of the problem, from which derivatives are "
                  "made");
    }
}

// The names and the actions of two decisions, of which searches end at once from `stopped` on.
std::vector<std::pair<std::string, std::vector<std::byte>>> decide_twice(std::int64_t iterations,
                                                                         std::int64_t stopped,
                                                                         std::int64_t replan) {
    const rddl_simulator& simulator = target();
    constexpr std::int64_t horizon = 10;
    GradientOptions options;
    options.budget.iterations = iterations;
    options.horizon = horizon;
    options.replan = replan;
    Gradient planner(
        {simulator, 1, horizon, default_memory_limit, {}, derivatives_in(PROBLEMS "/target")},
        options);
    rddl_batch_options batch_options{};
    batch_options.horizon = horizon;
    const solvers::BatchHandle batch = solvers::create_batch(simulator, batch_options);
    std::vector<std::pair<std::string, std::vector<std::byte>>> all;
    for (std::int64_t step = 0; step < 2; ++step) {
        const solvers::Stops stops = [&] {
            return step >= stopped;
        };
        std::vector<std::byte> action(static_cast<std::size_t>(simulator.problem->action_size));
        Explanation explanation;
        planner.decide({{batch.get(), 0}, 0, 0, step, horizon - step, horizon, &stops},
                       action.data(), &explanation);
        all.emplace_back(explanation.candidates.at(0).name, action);
        const rddl_transition out{};
        solvers::require_done(simulator, simulator.step(batch.get(), action.data(), &out));
    }
    return all;
}

TEST(Gradient, WithoutAnAscentTheFormerPlanGoesOn) {
    for (const std::int64_t iterations : {1, 2, 3, 5, 10, 50}) {
        const auto searched = decide_twice(iterations, 1, 1);
        EXPECT_EQ(searched, decide_twice(iterations, 2, 2)) << iterations;
    }
    for (const auto& [name, action] : decide_twice(50, 0, 1)) EXPECT_EQ(name, "noop");
}

// A stop while plans ascend: a plan of several steps is still compared with no-op.
TEST(Gradient, ComparesAPlanOfManyStepsAfterAStop) {
    for (const std::int64_t replan : {1, 10}) {
        GradientOptions options;
        options.budget.iterations = 1'000'000;
        options.horizon = 10;
        options.replan = replan;
        Gradient planner(
            {target(), 1, 10, default_memory_limit, {}, derivatives_in(PROBLEMS "/target")},
            options);
        rddl_batch_options batch_options{};
        batch_options.horizon = 10;
        const solvers::BatchHandle batch = solvers::create_batch(target(), batch_options);
        int asked = 0;
        const solvers::Stops stops = [&] {
            return ++asked > 100;
        };
        std::vector<std::byte> action(static_cast<std::size_t>(target().problem->action_size));
        Explanation explanation;
        planner.decide({{batch.get(), 0}, 0, 0, 0, 10, 10, &stops}, action.data(), &explanation);
        EXPECT_GT(explanation.iterations, 0);
        EXPECT_EQ(explanation.depth, replan == 1 ? 4 : 10);
    }
}

// A comparison would take 100 steps of 20 ms each.
TEST(Gradient, EndsADecisionOfALongPlanInTime) {
    static const rddl_simulator& quick = target();
    rddl_simulator simulator = target();
    simulator.step = [](rddl_batch* batch, const void* actions, const rddl_transition* out) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return quick.step(batch, actions, out);
    };
    GradientOptions options;
    options.budget.seconds = 0.02;
    options.replan = options.horizon.emplace(100);
    Gradient planner(
        {simulator, 1, 100, default_memory_limit, {}, derivatives_in(PROBLEMS "/target")}, options);
    rddl_batch_options batch_options{};
    batch_options.horizon = 100;
    const solvers::BatchHandle batch = solvers::create_batch(simulator, batch_options);
    std::vector<std::byte> action(static_cast<std::size_t>(simulator.problem->action_size));
    const auto begin = std::chrono::steady_clock::now();
    planner.decide({{batch.get(), 0}, 0, 0, 0, 100, 100}, action.data(), nullptr);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(took.count(), 1.5);  // a busy machine sleeps longer
}

// Where memory is short there are fewer plans, and as many in any batch.
TEST(Gradient, ShortMemoryGivesTheSameActionsInAnyBatch) {
    for (const std::int64_t limit : {100'000, 1'000'000, 10'000'000}) {
        const auto thought = [&](std::int64_t batch) {
            return run(network(), "plan:gradient,iterations=2,horizon=4,plans=20", 4, 1, 0,
                       derivatives_in(EXAMPLES "/network"), limit, batch)
                .thought(0, 0);
        };
        const Explanation one = thought(1), other = thought(4);
        ASSERT_EQ(one.candidates.size(), other.candidates.size()) << limit;
        EXPECT_EQ(one.steps, other.steps) << limit;
        for (std::size_t c = 0; c < one.candidates.size(); ++c)
            EXPECT_EQ(one.candidates[c].value, other.candidates[c].value) << limit;
    }
}

TEST(Gradient, KeepsToTheMemoryLimit) {
    const auto trials_with = [](std::int64_t limit) {
        const Played plan = run_gradient(network(), EXAMPLES "/network",
                                         "iterations=1,horizon=2,plans=50", 1, 1, limit);
        return plan.thought(0, 0).candidates.at(0).trials;
    };
    EXPECT_EQ(trials_with(default_memory_limit), 8);
    EXPECT_LT(trials_with(200'000), 8);
    try {
        trials_with(1000);
        FAIL() << "it found memory";
    } catch (const Failure& failure) {
        const std::string text = failure.what();
        EXPECT_TRUE(text.starts_with("plan:gradient takes ")) << text;
        EXPECT_TRUE(text.ends_with(" with one plan, which is more than 1000 bytes")) << text;
    }
}

// Bools share what max-nondef-actions allows.
TEST(ActionParameters, AreProjected) {
    const ActionParameters parameters(network(), solvers::action_space(network()));
    std::vector<double> all(parameters.count(), 1.0);
    parameters.project(all);
    std::vector<double> chances(all.size());
    parameters.values(all, chances);
    const double changes = std::accumulate(chances.begin(), chances.end(), 0.0);
    EXPECT_LE(changes, static_cast<double>(network().problem->max_nondef_actions) + 1e-3);
    std::vector<float> values(all.size());
    parameters.write(all, 0.0, values.data());
    EXPECT_EQ(std::ranges::count(values, 1.0f), network().problem->max_nondef_actions);
}

// Where two of three tanks may not change, the largest change is made.
TEST(ActionParameters, NumbersCountAmongTheChanges) {
    rddl_problem problem = *reservoir().problem;
    problem.max_nondef_actions = 1;
    rddl_simulator limited = reservoir();
    limited.problem = &problem;
    const solvers::ActionSpace space = solvers::action_space(reservoir());
    const ActionParameters parameters(limited, space);
    ASSERT_GE(parameters.count(), 3u);
    std::vector<double> all = parameters.defaults();
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += i == 1 ? 0.6 : 0.3;
    std::vector<float> values(all.size());
    parameters.write(all, 0.5, values.data());
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_EQ(values[i] != space.defaults[i], i == 1) << i;
    problem.max_nondef_actions = -1;
    ActionParameters(limited, space).write(all, 0.5, values.data());
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NE(values[i], space.defaults[i]) << i;
}

// The best item of each customer who likes any.
TEST(Gradient, ChoosesTheBestOfBoolsThatExcludeEachOther) {
    const workbench::LoadedProblem shop = interpreted("shop");
    const Played plan = run_gradient(*shop.simulator, PROBLEMS "/shop", "iterations=12,horizon=2");
    EXPECT_EQ(plan.summary.illegal_actions, 0);
    EXPECT_DOUBLE_EQ(plan.mean(), 2 * (1.5 + 2.0));
    EXPECT_DOUBLE_EQ(
        run_gradient(*shop.simulator, PROBLEMS "/shop", "iterations=2,horizon=2").mean(), 7);
}

// The chances of a group, of which one is that to become false, and their derivatives.
TEST(ActionParameters, OfExclusiveBoolsShareASoftmax) {
    for (const bool may_be_none : {true, false}) {
        solvers::ActionSpace space = solvers::action_space(network());
        space.defaults[1] = 1;
        space.categories = {{.first_value = may_be_none ? 0 : 1, .group = {0, 1, 2}}};
        const ActionParameters parameters(network(), space);
        const std::size_t count = parameters.count();
        std::vector<double> all(count, 0.1), adjoint(count, 3.0), gradient(count), values(count);
        all[1] = 0.2;
        all[2] = -0.3;
        adjoint[2] = 5;
        const auto value = [&] {
            parameters.values(all, values);
            return std::inner_product(values.begin(), values.end(), adjoint.begin(), 0.0);
        };
        value();
        const double changes = values[0] + (1 - values[1]) + values[2];
        EXPECT_NEAR(changes, may_be_none ? 0.6916 : 1, 1e-4);
        parameters.pull_back(all, adjoint, gradient);
        for (std::size_t i = 0; i < count; ++i) {
            constexpr double width = 1e-6;
            const double before = all[i];
            all[i] = before + width;
            const double above = value();
            all[i] = before - width;
            const double below = value();
            all[i] = before;
            EXPECT_NEAR(gradient[i], (above - below) / (2 * width), 1e-6) << i;
        }
        std::vector<double> squares = adjoint;
        parameters.share_scales(squares);
        EXPECT_EQ(squares[0], 5);
        EXPECT_EQ(squares[3], 3);
        const auto written = [&](double first, double second, double third) {
            std::vector<double> from = {first, second, third};
            from.resize(count, -1.0);
            std::vector<float> row(count);
            parameters.write(from, 0.5, row.data());
            return std::vector(row.begin(), row.begin() + 3);
        };
        EXPECT_EQ(written(0.1, -0.2, 0.1), (std::vector<float>{0, 0, 0}));
        EXPECT_EQ(written(0.1, 0.2, 0.3), (std::vector<float>{0, 1, 1}));
        EXPECT_EQ(written(-0.2, 0.2, -0.1), (std::vector<float>{0, 1, may_be_none ? 0.0f : 1.0f}));
    }
}

// Few steps are spent on short plans, so that these go up some gradients.
TEST(Gradient, ChoosesItsHorizonByTheSteps) {
    const auto depth_by = [](const std::string& options) {
        return run_gradient(car(), EXAMPLES "/mountain_car", options).thought(0, 0).depth;
    };
    EXPECT_LT(depth_by("steps=2000"), 20);
    // It is too short to reach the goal, so that no-op is the best, and is doubled.
    const Played plan = run_gradient(car(), EXAMPLES "/mountain_car", "steps=2000");
    EXPECT_GE(plan.thought(0, 1).depth, 2 * plan.thought(0, 0).depth);
    // A horizon that leaves no room for a gradient is followed by the first one.
    int without = 0;
    for (std::int64_t step = 0; step < 20; ++step) {
        if (plan.thought(0, step).iterations > 0) continue;
        ++without;
        EXPECT_EQ(plan.thought(0, step + 1).depth, plan.thought(0, 0).depth) << step;
    }
    EXPECT_GT(without, 0);
    EXPECT_EQ(depth_by("steps=2000,horizon=25"), 25);
}

}  // namespace
}  // namespace rddlc::planners
