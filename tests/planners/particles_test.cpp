// Particles: beliefs, and planners that act by them.
#include "planners/simulation/particles.hpp"

#include "planners/simulation/state_cells.hpp"
#include "planning.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace rddlc::planners {
namespace {

// The part of the particles that has the tiger on the left: the second state-fluent.
double share_left(const Particles& particles) {
    const auto size = static_cast<std::size_t>(tiger().problem->state_size);
    std::vector<std::byte> states(static_cast<std::size_t>(particles.count()) * size);
    tiger().get_state(particles.batch(), 0, particles.count(), states.data());
    const auto offset = static_cast<std::size_t>(rddl_fluent_at(tiger().problem, 2)->offset);
    double left = 0;
    for (std::int64_t k = 0; k < particles.count(); ++k)
        left += states[static_cast<std::size_t>(k) * size + offset] != std::byte{0};
    return left / static_cast<double>(particles.count());
}

TEST(Particles, FollowTheRuleOfBayes) {
    ASSERT_STREQ(rddl_fluent_at(tiger().problem, 2)->name, "tiger-left");
    Particles particles(tiger(), 10'000, 0);
    RandomStream stream(1, 2, 3);
    particles.begin(stream);
    EXPECT_EQ(particles.distinct(), 1);
    const auto* const wait = static_cast<const std::byte*>(tiger().problem->default_action);
    double odds = 1;
    for (const bool left : {true, true, false, true, true}) {
        const std::byte heard{left};
        particles.update(wait, &heard, stream);
        odds *= left ? 0.85 / 0.15 : 0.15 / 0.85;
        EXPECT_NEAR(share_left(particles), odds / (1 + odds), 0.02);  // 4 standard errors
        EXPECT_EQ(particles.distinct(), 2);
        EXPECT_FALSE(particles.is_lost());
    }
}

// Nothing that cannot be is forgotten: what was observed is met by no particle, and the others
// stay.
TEST(Particles, ThatAreLostGoOn) {
    Particles particles(maze(), 64, 0);
    RandomStream stream(1, 2, 3);
    particles.begin(stream);
    const auto* const wait = static_cast<const std::byte*>(maze().problem->default_action);
    std::vector<std::byte> observed(static_cast<std::size_t>(maze().problem->observation_size));
    observed.back() = std::byte{1};  // at the junction, after one step
    particles.update(wait, observed.data(), stream);
    EXPECT_TRUE(particles.is_lost());
    EXPECT_EQ(particles.count(), 64);
    EXPECT_EQ(particles.distinct(), 2);
}

// To open at once is worth -45, to wait for ever -20. After a tiger that is heard twice more on one
// side than on the other, to open is worth 0.97 * 10 - 0.03 * 100 = 6.7.
TEST(Particles, LetPlannersActByObservations) {
    struct Wanted {
        std::string planner;
        double least;
    };
    for (const auto& [planner, least] :
         {Wanted{"plan:cem,steps=4000,horizon=5", -7},
          Wanted{"plan:rollout,policy=noop,steps=4000", -16},  // of no-op: it does not wait again
          Wanted{"plan:uct,steps=4000", -2}}) {
        SCOPED_TRACE(planner);
        const Played plan = run(tiger(), planner, 100);
        EXPECT_GT(plan.mean(), least);
        const Explanation& thought = plan.thought(0, 0);
        EXPECT_EQ(thought.particles, 1);
        EXPECT_EQ(plan.thought(0, 1).particles, 2);
    }
    // The sign is remembered until the junction.
    for (const std::string planner : {"plan:cem,steps=2000", "plan:uct,steps=5000"})
        EXPECT_NEAR(run(maze(), planner, 10).mean(), 4, 1e-9);
    EXPECT_FALSE(run(network(), "plan:cem,steps=100").thought(0, 0).particles);
}

TEST(Particles, AreTheSameOnAnyNumberOfThreads) {
    for (const std::string planner :
         {"plan:cem,steps=1000,particles=50", "plan:rollout,policy=random,steps=1000",
          "plan:uct,steps=1000"}) {
        const Played one = run(tiger(), planner, 6, 1, 0, {}, default_memory_limit, 6);
        EXPECT_EQ(one.returns(), run(tiger(), planner, 6, 2).returns());
    }
}

TEST(Particles, HaveToSeeAnEpisodeFromItsBeginning) {
    const solvers::BatchHandle batch = solvers::create_batch(tiger(), {});
    const solvers::Actor actor =
        planner_policy(tiger(), "plan:cem,steps=100", settings_of(tiger())).start(1);
    std::vector<std::byte> action(static_cast<std::size_t>(tiger().problem->action_size));
    const std::uint8_t running = 1;
    const std::int64_t episode = 0, step = 3;
    solvers::Decision decision{batch.get(), {&running, 1}, {&episode, 1},
                               {&step, 1},  action.data(), {}};
    EXPECT_THROW(actor(decision), Failure);
}

// Two halves of a range are two cells, and one bin by itself divides at random.
TEST(StateCells, DivideStates) {
    const auto size = static_cast<std::size_t>(lock().problem->state_size);
    std::vector<std::byte> states(8 * size);
    for (std::int64_t k = 0; k < 8; ++k)
        std::memcpy(states.data() + static_cast<std::size_t>(k) * size, &k, sizeof k);
    StateCells cells(lock());
    RandomStream stream(1, 2, 3);
    const std::array<std::uint8_t, 8> all{1, 1, 1, 1, 1, 1, 1, 1};
    std::vector<std::uint64_t> found;
    const auto count = [&](double bins) {
        cells.find(states.data(), all, bins, stream, found);
        return std::set<std::uint64_t>(found.begin(), found.end()).size();
    };
    EXPECT_EQ(count(100), 8u);
    EXPECT_LE(count(2), 3u);
    std::size_t divided = 0;
    for (int i = 0; i < 200; ++i) divided += count(0.25) == 2;
    EXPECT_NEAR(static_cast<double>(divided) / 200, 0.25, 0.15);
}

}  // namespace
}  // namespace rddlc::planners
