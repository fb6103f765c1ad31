// Properties of all planners: names, options, budgets, stream of their own.
#include "planners/planner/episode_memories.hpp"
#include "planning.hpp"
#include "solvers/batches/batch.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace rddlc::planners {
namespace {

std::string refusal(const std::string& planner) {
    try {
        require_planner(planner);
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.status, usage_error);
        return failure.what();
    }
    return "";
}

TEST(PlannerNames, AreReadWithTheirOptions) {
    EXPECT_EQ(refusal("plan:cem"), "");
    EXPECT_EQ(refusal("plan:cem,steps=10,horizon=3,weights=mppi"), "");
    EXPECT_EQ(refusal("plan:cme"), "there is no planner 'cme'; did you mean 'cem'?");
    EXPECT_EQ(refusal("plan:cem,step=3"),
              "plan:cem: there is no option 'step'; did you mean 'steps'?");
    EXPECT_EQ(refusal("plan:cem,steps"),
              "plan:cem: 'steps' is no option: options have the form key=value");
    EXPECT_EQ(refusal("plan:cem,steps=1,horizon=2,steps=1"),
              "plan:cem: option 'steps' is given twice");
    EXPECT_EQ(refusal("plan:cem,horizon=0"),
              "plan:cem: horizon: '0' is not an int from 1 to 100000");
    EXPECT_EQ(refusal("plan:cem,weights=all"),
              "plan:cem: weights: 'all' is not one of elites, mppi");
    EXPECT_EQ(refusal("plan:cem,policy=plan:cem"),
              "plan:cem: policy: a planner cannot follow another one");
    EXPECT_EQ(refusal("plan:rollout"),
              "plan:rollout improves a policy: say which one, as in plan:rollout,policy=random");
    EXPECT_NE(refusal("plan:"), "");
    for (const std::string planner : {"plan:cem,tail=value", "plan:uct,initial=value"}) {
        const std::size_t comma = planner.find(',');
        EXPECT_EQ(refusal(planner), planner.substr(0, comma) + ": " + planner.substr(comma + 1) +
                                        " needs a policy that estimates values, as in "
                                        "policy=runs/a after 'rddl train ppo --out runs/a'");
        EXPECT_EQ(refusal(planner + ",policy=runs/a"), "");
    }
}

// The sections of docs/planning.md.
struct Page {
    std::string text;

    Page() {
        std::ifstream file(PLANNING_PAGE);
        text.assign(std::istreambuf_iterator<char>(file), {});
    }
    bool contains(const std::string& planner, const std::string& option) const {
        const std::size_t begin = text.find("\n## plan:" + planner);
        if (begin == std::string::npos) return false;
        const std::size_t end = text.find("\n## ", begin + 1);
        return text.substr(begin, end - begin).find("`" + option + "=") != std::string::npos;
    }
};

// Each option has a text for people, also on the page of the documentation.
TEST(PlannerNames, TablesAreComplete) {
    const Page page;
    for (const PlannerText& planner : planner_texts()) {
        EXPECT_FALSE(planner.summary.empty());
        for (const solvers::OptionText& option : planner.options) {
            EXPECT_FALSE(option.help.empty()) << option.name;
            EXPECT_EQ(option.name, option.keyword);
            EXPECT_TRUE(page.contains(planner.name, option.name))
                << planner.name << ": " << option.name;
        }
    }
}

TEST(PlannerStreams, IsNotThatOfTheEnvironment) {
    // Who knew the draws would be right 40 times of 40. 1200 guesses at random deviate by 0.014.
    for (const char* const planner :
         {"plan:cem,steps=2000,horizon=2", "plan:rollout,policy=noop,steps=2000",
          "plan:uct,steps=2000"}) {
        SCOPED_TRACE(planner);
        for (const std::uint64_t seed : {0, 7}) {
            const Played plan = run(coin(), planner, 30, 1, seed);
            EXPECT_NEAR(plan.mean() / 40, 0.5, 0.06);
        }
    }
}

bool is_uct(const std::string& planner) {
    return planner.starts_with("plan:uct");
}
bool is_finite(const rddl_simulator& simulator) {
    return &simulator == &ladder() || &simulator == &network();
}

void expect_same(const Played& one, const Played& two) {
    EXPECT_EQ(one.returns(), two.returns());
    ASSERT_EQ(one.explanation.size(), two.explanation.size());
    for (const auto& [place, explanation] : one.explanation) {
        const Explanation& others = two.explanation.at(place);
        ASSERT_EQ(explanation.candidates.size(), others.candidates.size());
        EXPECT_EQ(explanation.steps, others.steps);
        for (std::size_t c = 0; c < explanation.candidates.size(); ++c) {
            EXPECT_EQ(explanation.candidates[c].action, others.candidates[c].action);
            EXPECT_EQ(explanation.candidates[c].value, others.candidates[c].value);
        }
    }
}

TEST(PlannerBudgets, SameStepsGiveTheSameActionsOnAnyNumberOfThreads) {
    for (const rddl_simulator* simulator : {&ladder(), &network(), &reservoir(), &target()})
        for (const char* const planner :
             {"plan:cem,steps=3000", "plan:cem,iterations=2,population=16",
              "plan:rollout,policy=random,steps=3000",
              "plan:rollout,policy=random,iterations=2,lanes=16", "plan:uct,steps=3000",
              "plan:uct,iterations=100,lanes=8"}) {
            if (is_uct(planner) && !is_finite(*simulator)) continue;
            SCOPED_TRACE(simulator->problem->domain + std::string(" ") + planner);
            const Played one = run(*simulator, planner, 4, 1, 0, {}, default_memory_limit, 4);
            const Played two = run(*simulator, planner, 4, 2);
            expect_same(one, two);
        }
}

// Trees and the states that are known are forgotten at the same decisions in any batch.
TEST(PlannerBudgets, ShortMemoryGivesTheSameActionsInAnyBatch) {
    for (const std::int64_t limit : {1 << 18, 1 << 20, 1 << 22}) {
        SCOPED_TRACE(limit);
        const auto in_batches_of = [&](std::int64_t batch) {
            return run(network(), "plan:uct,steps=3000", 4, 1, 0, {}, limit, batch);
        };
        expect_same(in_batches_of(1), in_batches_of(4));
    }
}

// Trials end where they have taken their share of memory, however long they may go on.
TEST(PlannerBudgets, EndWhereMemoryIsShort) {
    const Explanation thought =
        run(network(), "plan:uct,iterations=50000,lanes=8", 1, 1, 0, {}, 1 << 22).thought(0, 0);
    EXPECT_GT(thought.iterations, 0);
    EXPECT_LT(thought.iterations, 5000);
}

// Whatever the budget: an action is there, it is legal, and steps are kept to.
TEST(PlannerBudgets, AreNeverTooShort) {
    for (const rddl_simulator* simulator : {&ladder(), &network(), &reservoir(), &car()})
        for (const std::string name : {"plan:cem", "plan:rollout,policy=random", "plan:uct"})
            for (const std::string budget :
                 {"steps=1", "steps=7", "steps=100", "seconds=0", "iterations=1,steps=50"}) {
                SCOPED_TRACE(simulator->problem->domain + (" " + name) + " " + budget);
                if (is_uct(name) && !is_finite(*simulator)) continue;
                const Played plan = run(*simulator, name + "," + budget);
                EXPECT_EQ(plan.summary.illegal_actions, 0);
                EXPECT_EQ(plan.summary.episodes, 1);
                if (!budget.starts_with("steps=")) continue;
                const std::int64_t most = std::max<std::int64_t>(std::stoll(budget.substr(6)), 2);
                for (const auto& [place, explanation] : plan.explanation)
                    EXPECT_LE(explanation.steps, most);
            }
}

// A program may begin to ask in the middle of an episode: what it asked in another one counts for
// nothing.
TEST(PlannerMemories, AreOfOneEpisode) {
    for (const std::string planner : {"plan:uct,steps=2000", "plan:cem,steps=2000,horizon=4"}) {
        SCOPED_TRACE(planner);
        const auto steps_of = [&](const std::vector<std::int64_t>& episodes) {
            PolicySettings settings = settings_of(network());
            Explanation last;
            settings.explain = [&](const Explanation& explanation) {
                last = explanation;
            };
            const solvers::BatchHandle batch = solvers::create_batch(network(), {});
            const solvers::Actor actor = planner_policy(network(), planner, settings).start(1);
            std::vector<std::byte> action(static_cast<std::size_t>(network().problem->action_size));
            for (const std::int64_t episode : episodes) {
                const std::int64_t step = 5;
                const std::uint8_t running = 1;
                solvers::Decision decision{batch.get(), {&running, 1}, {&episode, 1},
                                           {&step, 1},  action.data(), {}};
                actor(decision);
            }
            std::vector<double> values;
            for (const Explanation::Candidate& candidate : last.candidates)
                values.push_back(candidate.value);
            return values;
        };
        EXPECT_EQ(steps_of({1}), steps_of({0, 1}));
        EXPECT_EQ(steps_of({1}), steps_of({1}));
    }
}

TEST(PlannerBudgets, SecondsEndADecision) {
    const auto begin = std::chrono::steady_clock::now();
    run(reservoir(), "plan:cem,seconds=0.01");
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    const auto steps = static_cast<double>(reservoir().problem->horizon);
    EXPECT_GE(took.count(), 0.005 * steps);
    EXPECT_LT(took.count(), 1 * steps);  // not what hangs, but a busy machine
}

TEST(PlannerSight, OfHiddenStatesHasToBeAllowed) {
    try {
        planner_policy(maze(), "plan:gradient", settings_of(maze()));
        FAIL() << "it took a problem that is observed in part";
    } catch (const Failure& failure) {
        EXPECT_EQ(std::string(failure.what()),
                  "plan:gradient needs the state, which t_maze_1 (t_maze) hides from policies");
        EXPECT_EQ(failure.hint,
                  "let it look at the state with --cheat or plan:gradient,cheat=yes; in Python, "
                  "with cheat=True");
    }
    PolicySettings settings = settings_of(maze());
    settings.cheat = true;
    EXPECT_EQ(planner_policy(maze(), "plan:cem", settings).name, "plan:cem");
    const Played plan = run(maze(), "plan:cem,cheat=yes,steps=10");
    EXPECT_EQ(plan.summary.episodes, 1);
    EXPECT_FALSE(plan.thought(0, 0).particles);
}

// A state that was set back has another future than the one that is remembered.
TEST(EpisodeMemories, KnowNothingOfLaterSteps) {
    EpisodeMemories<int> memories(1);
    DecisionPoint point{
        .origin = {nullptr, 0}, .place = 0, .episode = 3, .step = 4, .left = 9, .horizon = 0};
    EXPECT_FALSE(memories.of(point));
    memories.of(point) = 1;
    point.step = 6;
    EXPECT_TRUE(memories.of(point));
    for (const std::int64_t step : {6, 5, 0, 0}) {
        point.step = step;
        EXPECT_FALSE(memories.of(point));
        memories.of(point) = 1;
    }
    point.step = 1;
    point.episode = 4;
    EXPECT_FALSE(memories.of(point));
}

}  // namespace
}  // namespace rddlc::planners
