#include "planning.hpp"

#include <gtest/gtest.h>

namespace rddlc::planners {
namespace {

// The values of the ladder as its file has them: no-op stays, then come to climb and to leap. They
// are found within less than two of them differ.
TEST(Uct, FindsTheValuesOfASmallProblem) {
    for (const std::string initial : {"lookahead", "rollout"}) {
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

// With few outcomes that are distinguished, trials go on from those that were seen.
TEST(Uct, WidensOutcomes) {
    const Played narrow = run(network(), "plan:uct,steps=20000,outcomes=0.5");
    EXPECT_EQ(narrow.summary.illegal_actions, 0);
    EXPECT_EQ(narrow.summary.episodes, 1);
    EXPECT_GT(narrow.thought(0, 0).iterations, 0);
}

TEST(Uct, RefusesProblemsOfRealActions) {
    try {
        run(reservoir(), "plan:uct");
        FAIL() << "it took a real action";
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("plan:uct needs finitely many actions"),
                  std::string::npos);
        EXPECT_EQ(failure.hint, "take plan:cem");
    }
}

}  // namespace
}  // namespace rddlc::planners
