#include "planning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace rddlc::planners {
namespace {

// The values of the ladder as its file has them: no-op stays, then come to climb and to leap. They
// are found within less than two of them differ.
TEST(Uct, FindsTheValuesOfASmallProblem) {
    for (const std::string initial : {"determinised", "lookahead", "rollout"}) {
        SCOPED_TRACE(initial);
        const Played plan =
            run(ladder(), "plan:uct,iterations=40000,exploration=1,initial=" + initial);
        const Explanation& explanation = plan.thought(0, 0);
        ASSERT_EQ(explanation.candidates.size(), 3u);
        EXPECT_NEAR(explanation.candidates[0].value, 4.5, 0.12);
        EXPECT_NEAR(explanation.candidates[1].value, 4.75, 0.12);
        EXPECT_NEAR(explanation.candidates[2].value, 4.625, 0.12);
        EXPECT_EQ(explanation.chosen, 1u);
        EXPECT_EQ(explanation.depth, 4);
        EXPECT_GE(explanation.iterations, 40000);
    }
}

// The values of backups by means are those of what was tried, not of the best: lower.
TEST(Uct, BacksUpMeansIfTold) {
    const Played plan = run(ladder(), "plan:uct,iterations=40000,backup=mean");
    const Played other = run(ladder(), "plan:uct,iterations=40000");
    const Explanation& best = other.thought(0, 0);
    double mean = 0, most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        mean = std::max(mean, plan.thought(0, 0).candidates[c].value);
        most = std::max(most, best.candidates[c].value);
    }
    EXPECT_LT(mean, most);
    EXPECT_GT(mean, 4);
}

// Optimal play from rung 1 has a mean return of 4.75; a mean of 400 episodes has an error of 0.18.
TEST(Uct, PlaysOptimally) {
    const Played plan = run(ladder(), "plan:uct,iterations=3000", 400);
    EXPECT_NEAR(plan.mean(), 4.75, 0.55);
    EXPECT_EQ(plan.summary.illegal_actions, 0);
}

// Once the game is over, nothing changes any more, and there is no search.
TEST(Uct, SeesWhereNothingChanges) {
    const Played plan = run(ladder(), "plan:uct,iterations=500", 40);
    int over = 0;
    for (const auto& [place, explanation] : plan.explanation) {
        if (explanation.note.empty()) continue;
        ++over;
        EXPECT_EQ(explanation.iterations, 0);
        for (const Explanation::Candidate& candidate : explanation.candidates)
            EXPECT_EQ(candidate.value, 0);
    }
    EXPECT_GT(over, 0);
}

TEST(Uct, SeesWhereThereIsNoChoice) {
    const workbench::LoadedProblem problem = interpreted("signal");
    const Played plan = run(*problem.simulator, "plan:uct,steps=500");
    EXPECT_EQ(plan.thought(0, 0).note, "only one action is legal, or all have the same outcome");
    EXPECT_EQ(plan.thought(0, 1).note, "");
}

// A decision whose steps do not last for those draws leaves the question to a later one.
TEST(Uct, SeesLaterWhereNothingChangesIfABudgetWasTooShort) {
    const workbench::LoadedProblem problem = interpreted("corridor");
    const Played plan =
        run(*problem.simulator, "plan:uct,lanes=1,steps=2100,initial=determinised", 3);
    int over = 0;
    for (const auto& [place, explanation] : plan.explanation) {
        const bool is_over = std::ranges::all_of(
            explanation.candidates, [](const auto& candidate) { return candidate.value == 0; });
        if (!is_over) continue;
        ++over;
        EXPECT_FALSE(explanation.note.empty()) << place.first << " " << place.second;
    }
    EXPECT_GT(over, 0);
}

// An error leaves no half of a node.
TEST(Uct, ForgetsAnEpisodeAfterAnError) {
    static int calls_left = 0;
    static const rddl_simulator& true_one = ladder();
    rddl_simulator simulator = ladder();
    simulator.step = [](rddl_batch* batch, const void* actions, const rddl_transition* out) {
        return --calls_left == 0 ? RDDL_OUT_OF_MEMORY : true_one.step(batch, actions, out);
    };
    const solvers::BatchHandle batch = solvers::create_batch(simulator, {});
    // The values that a decision finds after another one in which that call has failed; 0: none.
    const auto values_after = [&](int failing_call) {
        PolicySettings settings = settings_of(simulator);
        std::vector<double> values;
        settings.explain = [&](const Explanation& explanation) {
            for (const Explanation::Candidate& candidate : explanation.candidates)
                values.push_back(candidate.value);
        };
        const solvers::Actor actor =
            planner_policy(simulator, "plan:uct,iterations=20,lanes=4,initial=lookahead", settings)
                .start(1);
        std::vector<std::byte> action(static_cast<std::size_t>(simulator.problem->action_size));
        const std::int64_t episode = 0, step = 1;
        const std::uint8_t running = 1;
        solvers::Decision decision{batch.get(), {&running, 1}, {&episode, 1},
                                   {&step, 1},  action.data(), {}};
        calls_left = failing_call;
        if (failing_call > 0) {
            EXPECT_ANY_THROW(actor(decision));
        }
        calls_left = 0;
        actor(decision);
        return values;
    };
    const std::vector<double> expected = values_after(0);
    EXPECT_EQ(expected.size(), 3u);
    const int calls = -calls_left;
    for (int call = 1; call <= calls; ++call) EXPECT_EQ(values_after(call), expected) << call;
}

// A goal that no random play meets is found in the determinised problem: 12 steps, of which each is
// made 1 / 0.9 times. The mean of 20 episodes has an error of 0.3.
TEST(Uct, FindsADistantGoal) {
    const workbench::LoadedProblem problem = interpreted("corridor");
    const std::string planner = "plan:uct,iterations=50,lanes=8";
    EXPECT_NEAR(run(*problem.simulator, planner, 20).mean(), -13.3, 1.2);
    EXPECT_LT(run(*problem.simulator, planner + ",initial=rollout,policy=noop").mean(), -29);
}

// Where the tree finds nothing better than no-op in three decisions, plans do in the fourth one.
TEST(Uct, FindsADistantGoalByPlans) {
    const workbench::LoadedProblem problem = interpreted("corridor");
    const std::string planner = "plan:uct,steps=5000,lanes=8,initial=rollout";
    const Played played = run(*problem.simulator, planner);
    EXPECT_GT(played.mean(), -29);
    const auto is_plan = [&](std::int64_t step) {
        const Explanation& thought = played.thought(0, step);
        EXPECT_LE(thought.steps, 5000);
        const bool is_one = thought.candidates.at(thought.chosen).name == "plan";
        EXPECT_TRUE(!is_one || thought.note.empty());
        return is_one;
    };
    for (const std::int64_t step : {0, 1, 2}) EXPECT_FALSE(is_plan(step)) << step;
    EXPECT_TRUE(is_plan(3));
    EXPECT_EQ(run(*problem.simulator, planner, 2, 2).returns().front(), played.returns().front());
    EXPECT_EQ(run(*problem.simulator, planner + ",plans=no").mean(), -30);  // as no-op
    // A population of plans takes more than few trials.
    const Played few = run(*problem.simulator, "plan:uct,iterations=1,lanes=8,initial=rollout");
    for (const auto& [place, thought] : few.explanation) EXPECT_LT(thought.steps, 5000);
}

// With a lookahead of one step a new state is worth that step and what a policy does after it. In
// the network random play, which is better than no-op, is worth 70.
TEST(Uct, ValuesTheRestByAPolicy) {
    const Explanation first =
        run(network(), "plan:uct,lookahead=1,iterations=1,lanes=1").thought(0, 0);
    double sum = 0;
    for (const Explanation::Candidate& candidate : first.candidates) sum += candidate.value;
    EXPECT_NEAR(sum / static_cast<double>(first.candidates.size()), 70, 12);
}

// A policy's own action is tried more often than without a policy, however bad it is. The values
// stay the same.
TEST(Uct, MakesTrialsWhereTheDeterminisedProblemWouldTakeTheBudget) {
    EXPECT_GT(run(network(), "plan:uct,steps=1000").thought(0, 0).iterations, 0);
    const Explanation asked =
        run(network(), "plan:uct,steps=50,initial=determinised").thought(0, 0);
    EXPECT_EQ(asked.iterations, 0);
    EXPECT_EQ(asked.note, "the budget did not last for a trial");
}

TEST(Uct, TriesTheActionOfThePolicyFirst) {
    const auto thought = [](const std::string& options) {
        return run(ladder(), "plan:uct,initial=lookahead,lanes=1," + options).thought(0, 0);
    };
    const Explanation with = thought("iterations=60,policy=noop"),
                      without = thought("iterations=60");
    EXPECT_GT(with.candidates[0].trials, without.candidates[0].trials + 5);
    EXPECT_EQ(thought("iterations=20000,policy=noop").chosen, 1u);
    EXPECT_NEAR(thought("iterations=20000,policy=noop").candidates[1].value, 4.75, 0.15);
    EXPECT_EQ(
        run(network(), "plan:uct,policy=random,initial=determinised,steps=5000").summary.episodes,
        1);
}

// Nodes of the determinised problem have edges when the policy is asked about them, and it is asked
// again where draws tell twins apart: in the network all candidates but three.
TEST(Uct, AsksThePolicyAboutNodesOfTheDeterminisedProblem) {
    const auto played = [](const std::string& options, int threads = 1) {
        return run(network(), "plan:uct,initial=determinised,iterations=200," + options, 1,
                   threads);
    };
    const auto trials = [&](const std::string& options) {
        std::vector<std::int64_t> all;
        for (const auto& candidate : played(options).thought(0, 0).candidates)
            all.push_back(candidate.trials);
        return all;
    };
    const std::string fond = "policy=fond of the last action";
    const auto with = trials("lanes=1,policy=noop"), without = trials("lanes=1"),
               of_fond = trials("lanes=1," + fond);
    ASSERT_EQ(of_fond.size(), 9u);
    EXPECT_GT(with[0], without[0] + 10);
    EXPECT_GT(std::ranges::max(std::span(of_fond).subspan(3)),
              2 * std::ranges::max(std::span(with).subspan(3)));
    for (const std::int64_t each : trials("lanes=32," + fond)) EXPECT_GT(each, 1);
    EXPECT_EQ(played("lanes=32," + fond).returns(), played("lanes=32," + fond, 2).returns());
}

// The first decision has so many trials as candidates show. The second one has those of the first
// one that began with what came of it, as well.
TEST(Uct, KeepsTheTreeFromOneDecisionToTheNext) {
    const auto trials = [](const Explanation& explanation) {
        std::int64_t sum = 0;
        for (const Explanation::Candidate& candidate : explanation.candidates)
            sum += candidate.trials - 1;  // one value is by the determinised problem
        return sum;
    };
    const Played plan = run(ladder(), "plan:uct,iterations=2000,lanes=8", 20);
    int kept = 0;
    for (std::int64_t episode = 0; episode < 20; ++episode) {
        EXPECT_EQ(trials(plan.thought(episode, 0)), plan.thought(episode, 0).iterations);
        const Explanation& next = plan.thought(episode, 1);
        EXPECT_GE(trials(next), next.iterations);
        kept += trials(next) > next.iterations;
    }
    EXPECT_EQ(kept, 20);
}

// All three actions have the same typical outcome. Draws tell a wish from no-op, and a prayer is
// the same as no-op. Wishes are worth 0.3 + 0.51 + 0.657.
TEST(Uct, TellsTwinsApartByDraws) {
    const workbench::LoadedProblem problem = interpreted("lottery");
    const Played plan = run(*problem.simulator, "plan:uct,iterations=4000", 20);
    const Explanation& first = plan.thought(0, 0);
    ASSERT_EQ(first.candidates.size(), 2u);
    EXPECT_EQ(first.chosen, 1u);
    EXPECT_NEAR(first.candidates[1].value, 1.467, 0.1);
    EXPECT_EQ(plan.returns(), run(*problem.simulator, "plan:uct,iterations=4000", 20, 3).returns());
    // No draws, no difference.
    EXPECT_EQ(run(*problem.simulator, "plan:uct,steps=40,initial=determinised,lanes=1")
                  .thought(0, 0)
                  .candidates.size(),
              1u);
}

// With few outcomes that are distinguished, trials go on from those that were seen.
TEST(Uct, WidensOutcomes) {
    const Played narrow = run(network(), "plan:uct,steps=20000,outcomes=0.5");
    EXPECT_EQ(narrow.summary.illegal_actions, 0);
    EXPECT_EQ(narrow.summary.episodes, 1);
    EXPECT_GT(narrow.thought(0, 0).iterations, 0);
}

TEST(Uct, TriesActionsByThePriorsOfAPolicy) {
    const Played by_action = run(network(), "plan:uct,iterations=200,policy=noop");
    const Played by_priors =
        run(network(), "plan:uct,iterations=200,policy=fond of the last action");
    const auto trials_of_last = [](const Played& played) {
        return played.thought(0, 0).candidates.back().trials;
    };
    EXPECT_GT(trials_of_last(by_priors), 2 * trials_of_last(by_action));
    for (const auto& candidate : by_priors.thought(0, 0).candidates)
        EXPECT_TRUE(std::isfinite(candidate.value));
    EXPECT_EQ(
        by_priors.returns(),
        run(network(), "plan:uct,iterations=200,policy=fond of the last action", 1, 2).returns());
}

TEST(Uct, ValuesNewStatesByTheValuesOfAPolicy) {
    const Played plan =
        run(ladder(), "plan:uct,iterations=4000,policy=knows the ladder,initial=value", 20);
    for (const auto& candidate : plan.thought(0, 0).candidates)
        if (candidate.trials > 1000) {
            EXPECT_NEAR(candidate.value, 4.75, 0.4);
        }
    EXPECT_NEAR(plan.mean(), 4.75, 2);
    // It is the default where the policy has values.
    EXPECT_EQ(plan.returns(),
              run(ladder(), "plan:uct,iterations=4000,policy=knows the ladder", 20).returns());
    // Rewards on the way are discounted as the values are: to stay pays 1 in each step.
    const Played greedy = run(ladder(), "plan:uct,iterations=100,policy=looks a step ahead");
    EXPECT_EQ(greedy.thought(0, 0).candidates.at(0).value, 1);
    // Without a trial the policy's likeliest action is taken.
    const Played none = run(ladder(), "plan:uct,steps=2,policy=knows the ladder,initial=value");
    EXPECT_EQ(none.mean(), 4);
}

}  // namespace
}  // namespace rddlc::planners
