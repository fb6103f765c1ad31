// An episode that is stepped by hand has the engine's steps, and goes back exactly.
#include "studio/stepped_episode.hpp"

#include "learning/learned_policy.hpp"
#include "solvers/evaluation/episodes.hpp"
#include "studio/policy_actor.hpp"
#include "support/failure.hpp"
#include "texts.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace rddlc::studio {
namespace {

using nlohmann::json;

workbench::LoadedProblem stepped(const Texts& texts = {tanks_domain, tanks_instance}) {
    return load_texts(tanks(), texts, {}, Purpose::Stepping);
}

json action_of(int step) {
    return {{"release___a", 0.5 * (step % 3)}, {"alarm", step % 2 == 0}};
}

void expect_same(const Moment& a, const Moment& b) {
    EXPECT_EQ(a.state, b.state);
    EXPECT_EQ(a.causes, b.causes);
    EXPECT_EQ(a.total, b.total);
    EXPECT_EQ(a.reward, b.reward);
}

TEST(SteppedEpisodeTest, StepsAreThoseOfTheEngine) {
    const auto problem = stepped();
    const rddl_simulator& simulator = *problem.simulator;
    SteppedEpisode episode(problem.simulator, 7, 3);
    rddl_batch_options options{};
    options.seed = 7;
    options.first_environment = 3;
    const solvers::BatchHandle batch = solvers::create_batch(simulator, options);
    for (int step = 0; step < 20; ++step) {
        const Record action = episode.read_action(action_of(step));
        double reward = 0;
        std::uint8_t causes = 0;
        rddl_transition out{};
        out.rewards = &reward;
        out.causes = &causes;
        ASSERT_EQ(simulator.step(batch.get(), action.data(), &out), RDDL_OK);
        episode.step(action, "you");
        Record state(static_cast<std::size_t>(simulator.problem->state_size));
        ASSERT_EQ(simulator.get_state(batch.get(), 0, 1, state.data()), RDDL_OK);
        EXPECT_EQ(episode.now().state, state);
        EXPECT_EQ(episode.now().causes, causes);
        EXPECT_EQ(episode.moments()[episode.now_at() - 1].reward, reward);
    }
    EXPECT_TRUE(episode.is_over());
    EXPECT_THROW(episode.step(episode.read_action(json::object()), "you"), Failure);
}

TEST(SteppedEpisodeTest, GoesBackExactly) {
    const auto problem = stepped();
    SteppedEpisode episode(problem.simulator, 1, 0), straight(problem.simulator, 1, 0);
    for (int step = 0; step < 12; ++step) episode.step(episode.read_action(action_of(step)), "you");
    episode.go_to(4);
    for (int step = 4; step < 12; ++step)
        episode.step(episode.read_action(action_of(step + 1)), "you");
    for (int step = 0; step < 12; ++step)
        straight.step(straight.read_action(action_of(step < 4 ? step : step + 1)), "you");
    ASSERT_EQ(episode.moments().size(), straight.moments().size());
    for (std::size_t k = 0; k < episode.moments().size(); ++k)
        expect_same(episode.moments()[k], straight.moments()[k]);
}

TEST(SteppedEpisodeTest, EndCanBeLeft) {
    const auto problem = stepped();
    SteppedEpisode episode(problem.simulator, 1, 0);
    while (!episode.is_over()) episode.step(episode.read_action(json::object()), "you");
    const Moment end = episode.now();
    episode.go_to(19);
    EXPECT_FALSE(episode.is_over());
    episode.step(episode.read_action(json::object()), "you");
    expect_same(episode.now(), end);
}

TEST(SteppedEpisodeTest, RefusesWrongActions) {
    const auto problem = stepped();
    SteppedEpisode episode(problem.simulator, 0, 0);
    EXPECT_THROW(episode.read_action({{"releese___a", 1.0}}), Failure);
    EXPECT_THROW(episode.read_action({{"release___a", "much"}}), Failure);
    EXPECT_THROW(episode.read_action({{"release___a", 1.0}, {"release___b", 1.0}, {"alarm", true}}),
                 Failure);
    EXPECT_THROW(episode.go_to(1), Failure);
    const Record illegal = episode.read_action({{"release___a", 500.0}});
    EXPECT_NE(episode.violation_of(illegal).find("release"), std::string::npos);
    EXPECT_EQ(episode.violation_of(episode.read_action({{"release___a", 5.0}})), "");
    // Who insists takes it, and is told.
    episode.step(illegal, "you");
    EXPECT_NE(episode.moments()[0].warning, "");
}

TEST(SteppedEpisodeTest, MomentsAreJson) {
    const auto problem = stepped();
    SteppedEpisode episode(problem.simulator, 0, 0);
    episode.step(episode.read_action({{"alarm", true}}), "a \"name\"");
    const json first = json::parse(episode.moment_json(0)),
               second = json::parse(episode.moment_json(1));
    EXPECT_EQ(first["state"]["water___a"], 12.0);
    EXPECT_EQ(first["action"], json({{"alarm", true}}));
    EXPECT_EQ(first["by"], "a \"name\"");
    EXPECT_EQ(second["total"], first["reward"]);
    EXPECT_FALSE(second.contains("action"));
}

// ------------------------------------------------------------------------------------ policies

std::vector<Record> actions_of(SteppedEpisode& episode, PolicyActor& actor, int steps) {
    std::vector<Record> actions;
    for (int step = 0; step < steps; ++step) {
        actions.push_back(actor.act(episode, {}));
        episode.step(actions.back(), actor.name());
    }
    return actions;
}

TEST(PolicyActorTest, ActsAsInEpisodes) {
    const auto problem = stepped();
    for (const std::string name : {"random", "noop", "rddl"}) {
        const solvers::Policy policy = workbench::policy_named(*problem.simulator, name, false, 5);
        SteppedEpisode episode(problem.simulator, 5, 0);
        PolicyActor actor(episode, policy, false);
        actions_of(episode, actor, 20);
        solvers::EpisodeOptions options;
        options.seed = 5;
        const auto rollouts = solvers::run_episodes(*problem.simulator, policy, options, {});
        EXPECT_EQ(episode.now().total, rollouts.episodes[0].undiscounted_return) << name;
    }
}

// The policy counts its decisions: three of them come before the alarm.
TEST(PolicyActorTest, RemembersTheWholeEpisode) {
    const auto problem = stepped();
    const solvers::Policy policy = workbench::policy_named(*problem.simulator, "rddl", false, 0);
    SteppedEpisode episode(problem.simulator, 0, 0);
    PolicyActor actor(episode, policy, false);
    const Record quiet = episode.read_action(json::object());
    const Record alarm = episode.read_action({{"alarm", true}});
    const auto next = [&] {
        return actor.act(episode, {});
    };
    episode.step(quiet, "you");
    episode.step(quiet, "you");
    EXPECT_EQ(next(), quiet);  // its third decision: the first two were taken from it
    episode.step(quiet, "you");
    EXPECT_EQ(next(), alarm);
    EXPECT_EQ(next(), alarm);  // asking changes nothing
    episode.go_to(1);
    EXPECT_EQ(next(), quiet);
    episode.go_to(3);
    EXPECT_EQ(next(), alarm);
}

TEST(PolicyActorTest, TakesOverFromTheUser) {
    const auto problem = stepped();
    const solvers::Policy policy = workbench::policy_named(*problem.simulator, "random", false, 9);
    SteppedEpisode episode(problem.simulator, 9, 0);
    PolicyActor actor(episode, policy, false);
    const std::vector<Record> first = actions_of(episode, actor, 20);
    episode.go_to(10);
    EXPECT_EQ(actions_of(episode, actor, 10), std::vector<Record>(first.begin() + 10, first.end()));
}

TEST(PolicyActorTest, PlannersBeginAnywhere) {
    const auto problem = stepped();
    SteppedEpisode episode(problem.simulator, 2, 0);
    const std::string name = "plan:cem,iterations=2,horizon=3";
    PolicyActor actor(episode, workbench::policy_named(*problem.simulator, name, false, 2), true);
    episode.step(episode.read_action(json::object()), "you");
    actions_of(episode, actor, 2);
    episode.go_to(1);
    actions_of(episode, actor, 2);
    EXPECT_EQ(episode.now_at(), 3u);
}

}  // namespace
}  // namespace rddlc::studio
