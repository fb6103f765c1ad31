#include "planners/cem/plan_distribution.hpp"
#include "planners/simulation/budget.hpp"
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
        const Played plan = run(target(), "plan:cem,iterations=30,weights=" + weights);
        EXPECT_LE(plan.mean(), -0.116 + 1e-9);
        EXPECT_NEAR(plan.mean(), -0.116, weights == "elites" ? 1e-4 : 5e-3);
    }
    const Played plan = run(target(), "plan:cem,iterations=30");
    double move = 0;
    std::memcpy(&move, chosen_action(plan.thought(0, 0)), sizeof move);  // the first fluent
    EXPECT_NEAR(move, 0.36, 0.01);
    EXPECT_EQ(plan.thought(0, 0).depth, 2);
    EXPECT_EQ(plan.thought(0, 0).iterations, 30);
}

// The flag of the car is not within 40 steps, and until then nothing is better than no-op.
TEST(Cem, LooksAsFarAsNeeded) {
    const Played plan = run(car(), "plan:cem,iterations=8");
    EXPECT_GT(plan.thought(0, 0).depth, 40);
    EXPECT_GT(plan.mean(), 80);
    EXPECT_EQ(run(car(), "plan:cem,iterations=8,horizon=20").thought(0, 0).depth, 20);
}

// Each wheel of the lock is a state that was not met before; nothing else says that it is good.
TEST(Cem, FindsWhatNoNoiseFinds) {
    const Played plan = run(lock(), "plan:cem,iterations=8");
    EXPECT_GT(plan.mean(), 0.85);
    EXPECT_LE(plan.mean(), 1 - 11 * 0.01 + 1e-9);
    EXPECT_LE(run(lock(), "plan:cem,iterations=8,horizon=11").mean(), 0);
}

// Where something is drawn, the choice is compared by many draws; no-op is always among them.
TEST(Cem, KnowsWhatNoopIsWorth) {
    const Played plan = run(network(), "plan:cem,iterations=2,population=64");
    const Explanation& explanation = plan.thought(0, 0);
    EXPECT_TRUE(std::ranges::any_of(explanation.candidates,
                                    [](const auto& c) { return c.name == "noop"; }));
    for (const Explanation::Candidate& candidate : explanation.candidates)
        EXPECT_LE(candidate.value, explanation.candidates[explanation.chosen].value);
    EXPECT_GT(explanation.candidates[explanation.chosen].trials, 4);
    EXPECT_GT(explanation.candidates[explanation.chosen].error, 0);
}

TEST(Cem, TakesThePolicyThatItIsGiven) {
    const Played plan = run(reservoir(), "plan:cem,iterations=1,population=16,policy=random");
    EXPECT_TRUE(std::ranges::any_of(plan.thought(0, 0).candidates,
                                    [](const auto& c) { return c.name == "policy"; }));
    EXPECT_EQ(plan.summary.illegal_actions, 0);
}

// Plans that come again leave room for new ones and for no-op, however small the population is.
TEST(Cem, DrawsNewPlansInSmallPopulations) {
    for (const std::string population : {"4", "8"}) {
        SCOPED_TRACE(population);
        const Played plan =
            run(reservoir(), "plan:cem,iterations=4,horizon=4,population=" + population);
        int drawn = 0, noop = 0;
        for (const auto& [place, explanation] : plan.explanation) {
            if (place.second == 0) continue;
            for (const auto& candidate : explanation.candidates) {
                drawn += candidate.name == "sample";
                noop += candidate.name == "noop";
            }
        }
        EXPECT_GT(drawn, 0);
        EXPECT_GT(noop, 0);
    }
}

// Plans of two steps take their part of the budget, and the best of them is a candidate.
TEST(Cem, LooksNear) {
    const auto played = [](const std::string& options, int threads) {
        return run(network(), "plan:cem,steps=2000" + options, 2, threads);
    };
    const auto has_near = [](const Played& plan) {
        return std::ranges::any_of(plan.thought(0, 0).candidates,
                                   [](const auto& c) { return c.name == "near"; });
    };
    const Played plan = played(",near=0.5", 1);
    EXPECT_TRUE(has_near(plan));
    EXPECT_FALSE(has_near(played("", 1)));  // 9 actions
    EXPECT_EQ(plan.returns(), played(",near=0.5", 2).returns());
    for (const auto& [place, explanation] : plan.explanation) EXPECT_LE(explanation.steps, 2000);
}

// The policy's plan is recorded by steps of the same budget.
TEST(Cem, RecordsThePolicyWithinItsSteps) {
    for (const std::int64_t steps : {1, 2, 5, 16}) {
        const Played plan =
            run(reservoir(), "plan:cem,policy=random,population=5,steps=" + std::to_string(steps));
        for (const auto& [place, explanation] : plan.explanation)
            EXPECT_LE(explanation.steps, steps);
    }
}

// Four populations, and a comparison that takes as many steps as one, fit into what is left.
TEST(Cem, SizesPopulationsByWhatNearPlansLeave) {
    const auto populations = [](const std::string& options) {
        return run(network(), "plan:cem,scenarios=1," + options).thought(0, 0).iterations;
    };
    const std::int64_t near = populations("near=0,horizon=2,steps=1600");
    EXPECT_EQ(populations("near=0.5,horizon=4,steps=3200"), near + 4);
}

TEST(Budget, HasShares) {
    const Budget none = share_of(Budget{}, 0.5);
    EXPECT_EQ(none.seconds, default_seconds / 2);
    EXPECT_FALSE(none.steps || none.iterations);
    const Budget quarter = share_of(Budget{.seconds = {}, .steps = 1000, .iterations = 3}, 0.25);
    EXPECT_FALSE(quarter.seconds);
    EXPECT_EQ(quarter.steps, 250);
    EXPECT_EQ(quarter.iterations, 1);
    // A share is that of the steps which are left.
    EXPECT_EQ(
        BudgetMeter(Budget{.seconds = {}, .steps = 1000, .iterations = {}}, nullptr, 0.25, 200)
            .steps_left(),
        200);
}

// That holds for each budget, for memory, and for few steps where the user asks for it.
TEST(Cem, LooksNearWithinItsPart) {
    const auto thought = [](const std::string& options,
                            std::int64_t memory_limit = default_memory_limit) {
        return run(network(), "plan:cem," + options, 1, 1, 0, {}, memory_limit).thought(0, 0);
    };
    const auto has_near = [](const Explanation& explanation) {
        return std::ranges::any_of(explanation.candidates,
                                   [](const auto& c) { return c.name == "near"; });
    };
    for (const std::string steps : {"16", "40", "500"}) {
        SCOPED_TRACE(steps);
        const Explanation explanation = thought("horizon=4,near=0.5,steps=" + steps);
        EXPECT_LE(explanation.steps, std::stoll(steps));
        EXPECT_TRUE(has_near(explanation));
    }
    EXPECT_LE(thought("near=0.5,steps=1").steps, 1);
    const Explanation three = thought("near=0.5,iterations=3");
    EXPECT_TRUE(has_near(three));
    EXPECT_EQ(three.iterations, 3);
    EXPECT_FALSE(has_near(thought("near=0.5,iterations=1")));
    // Each population of 256 plays one step, that of near plans with one draw of luck.
    EXPECT_EQ(thought("near=0.5,horizon=1,iterations=2").steps, 2 * (1024 + 256));
    constexpr std::int64_t little = 1 << 17;
    EXPECT_LT(thought("near=0.5,iterations=2", little).steps,
              thought("near=0,iterations=1", little).steps);
}

// A population of one plan, which is `drawn`.
Population draw_one(const solvers::ActionSpace& space, Distribution& distribution,
                    double correlation, Plan& drawn) {
    Population population(1, space.real_count(), space.index_count());
    population.set_steps(distribution.steps());
    PlanNoise noise(1, space, {&correlation, 1});
    RandomStream stream(1, 2, 3);
    distribution.draw(stream, noise, population);
    population.get(0, drawn);
    return population;
}

TEST(Plans, ReadWhatTheyWrite) {
    for (const rddl_simulator* simulator :
         {&target(), &ladder(), &network(), &reservoir(), &car()}) {
        SCOPED_TRACE(simulator->problem->domain);
        const solvers::ActionSpace space = solvers::action_space(*simulator);
        Distribution distribution(space, {});
        distribution.restart(20);
        Plan drawn, read;
        drawn.numbers.resize(static_cast<std::size_t>(20 * space.real_count()));
        drawn.indices.resize(static_cast<std::size_t>(20 * space.index_count()));
        read = drawn;
        draw_one(space, distribution, 0.5, drawn);
        std::vector<float> row(static_cast<std::size_t>(space.column_count)), again = row;
        int different = 0;
        for (int t = 0; t < 20; ++t) {
            const auto write = [&](const Plan& plan, std::vector<float>& values) {
                solvers::write_action(space, plan.numbers.data() + t * space.real_count(),
                                      plan.indices.data() + t * space.index_count(), values.data());
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

// A fit to plans that all do the same gives that as its middle.
TEST(Plans, AreFitted) {
    for (const rddl_simulator* simulator : {&target(), &ladder(), &network()}) {
        SCOPED_TRACE(simulator->problem->domain);
        const solvers::ActionSpace space = solvers::action_space(*simulator);
        Distribution distribution(space, {});
        distribution.restart(5);
        Plan drawn;
        drawn.numbers.resize(static_cast<std::size_t>(5 * space.real_count()));
        drawn.indices.resize(static_cast<std::size_t>(5 * space.index_count()));
        Plan middle = drawn;
        const Population population = draw_one(space, distribution, 0, drawn);
        const std::size_t all[] = {0, 0};
        const double weights[] = {0.25, 0.75};
        for (int i = 0; i < 20; ++i) distribution.fit(population, all, weights, 0.2, false);
        distribution.middle(middle);
        for (std::size_t k = 0; k < drawn.numbers.size(); ++k)
            EXPECT_NEAR(middle.numbers[k], drawn.numbers[k], 1e-5);
        if (space.max_sub_actions == 0) {
            EXPECT_EQ(middle.indices, drawn.indices);
        }
        // Fewer steps are the first ones.
        distribution.shorten(3);
        EXPECT_EQ(distribution.steps(), 3);
        Plan first = drawn;
        distribution.middle(first);
        for (std::size_t k = 0; k < static_cast<std::size_t>(3 * space.real_count()); ++k)
            EXPECT_EQ(first.numbers[k], middle.numbers[k]);
        for (std::size_t k = 0; k < static_cast<std::size_t>(3 * space.index_count()); ++k)
            EXPECT_EQ(first.indices[k], middle.indices[k]);
    }
}

// Every other plan departs from what is likeliest now and then, and from no-op where no value is
// likelier.
TEST(Plans, AreSometimesUsual) {
    constexpr std::size_t plans = 1000, steps = 50;
    const solvers::ActionSpace space = solvers::action_space(lock());
    Distribution distribution(space, {});
    distribution.restart(steps);
    Population population(plans, space.real_count(), space.index_count());
    population.set_steps(steps);
    const double correlation = 0;
    PlanNoise noise(plans, space, {&correlation, 1});
    RandomStream stream(1, 2, 3);
    distribution.draw(stream, noise, population);
    double departures[2] = {0, 0};
    std::size_t rare = 0;
    for (std::size_t p = 0; p < plans; ++p) {
        std::size_t count = 0;
        for (std::size_t t = 0; t < steps; ++t) count += population.indices(t, 0)[p] != 0;
        departures[p % 2] += static_cast<double>(count);
        rare += p % 2 == 1 && count > 0 && count <= 2;
    }
    EXPECT_NEAR(departures[0] / (plans * steps / 2), 0.75, 0.01);
    // The mean of 2^-7u is 127 / 128 / (7 log 2).
    EXPECT_NEAR(departures[1] / (plans * steps / 2), 0.75 * 0.2045, 0.03);
    EXPECT_GT(rare, 50u);
}

TEST(RandomStream, HasMeanZeroAndDeviationOne) {
    RandomStream stream(1, 2, 3);
    double sum = 0, squares = 0, units = 0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i) {
        const double x = static_cast<double>(stream.bell());
        sum += x;
        squares += x * x;
        units += stream.unit();
    }
    EXPECT_NEAR(sum / n, 0, 0.015);  // 5 standard errors
    EXPECT_NEAR(squares / n, 1, 0.02);
    EXPECT_NEAR(units / n, 0.5, 0.005);
    EXPECT_NE(RandomStream(1, 2, 3).bits(), RandomStream(1, 2, 4).bits());
    EXPECT_NE(RandomStream(1, 2, 3).bits(), RandomStream(1, 3, 3).bits());
    EXPECT_NE(RandomStream(1, 2, 3).bits(), RandomStream(2, 2, 3).bits());
}

// One step ahead, to stay pays 1, and what else is worth while comes later.
TEST(Cem, CountsWhatFollowsByTheValuesOfAPolicy) {
    const std::string short_plans =
        "plan:cem,horizon=1,population=16,scenarios=256,iterations=4,policy=knows the ladder";
    const Played by_policy = run(ladder(), short_plans);
    const Played by_values = run(ladder(), short_plans + ",tail=value");
    const auto value_of = [](const Played& played) {
        return played.thought(0, 0).candidates.at(0).value;
    };
    EXPECT_NEAR(value_of(by_policy), 4, 0.5);  // to stay, four times
    EXPECT_NEAR(value_of(by_values), 4.75, 0.6);
    EXPECT_EQ(by_values.returns(), run(ladder(), short_plans + ",tail=value", 1, 2).returns());

    const auto complaint = [](const std::string& planner) -> std::string {
        try {
            planner_policy(ladder(), planner, settings_of(ladder()));
        } catch (const Failure& failure) {
            return failure.what();
        }
        return "";
    };
    EXPECT_EQ(complaint("plan:cem,policy=noop,tail=value"),
              "plan:cem,tail=value needs a policy that estimates values, and 'noop' does not");
    EXPECT_EQ(complaint("plan:uct,policy=noop,initial=value"),
              "plan:uct,initial=value needs a policy that estimates values, and 'noop' does not");
}

}  // namespace
}  // namespace rddlc::planners
