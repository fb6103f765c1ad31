// Episodes of a problem without draws, whose steps are in registers, start again there: a batch of
// packs does what single environments do.
#include <rddl/batch/batch.hpp>
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace rddl {
namespace {

// A walk between two limits, the upper one an invariant, which ends early if the first place is
// already beyond.
template <int first_place>
struct Walk {
    template <class L>
    struct State {
        typename L::Real place;
        typename L::Int steps;
        typename L::Bool has_moved;
    };
    template <class L>
    struct Action {
        typename L::Real move;
    };
    template <class L>
    struct Scratch {};
    template <class L>
    struct Observation {};
    static constexpr bool partially_observed = false;

    template <class L>
    static void reset(State<L>& state, Context<L>&) {
        state.place = typename L::Element{first_place};
        state.steps = std::int64_t{0};
        state.has_moved = false;
    }
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>&, State<L>& next,
                     Observation<L>&, Context<L>&) {
        next.place = state.place + action.move;
        next.steps = wrap_add(state.steps, typename L::Int{1});
        next.has_moved = action.move != typename L::Real{0} || state.has_moved;
    }
    template <class L>
    static typename L::Real reward(const State<L>&, const Action<L>&, const Scratch<L>&,
                                   const State<L>& next, Context<L>&) {
        return next.place + next.place;
    }
    template <class L>
    static typename L::Bool terminal(const State<L>& state, Context<L>&) {
        return state.place < typename L::Real{-3};
    }
    template <class L>
    static typename L::Bool violates_invariant(const State<L>& state, Context<L>&) {
        return state.place > typename L::Real{3};
    }
    template <class L>
    static typename L::Int violated_precondition(const State<L>&, const Action<L>&, Context<L>&) {
        return std::int64_t{-1};
    }
};

struct Place {
    double place;
    std::int64_t steps;
    std::uint64_t has_moved;  // its first byte
};

inline constexpr rddl_fluent fluents[] = {
    {"place", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1, 0, nullptr, nullptr, {"walk.rddl", 1, 1}},
    {"steps", RDDL_STATE, RDDL_INT, -1, 0, nullptr, 1, 8, nullptr, nullptr, {"walk.rddl", 2, 1}},
    {"has-moved",
     RDDL_STATE,
     RDDL_BOOL,
     -1,
     0,
     nullptr,
     1,
     16,
     nullptr,
     nullptr,
     {"walk.rddl", 3, 1}},
    {"move", RDDL_ACTION, RDDL_REAL, -1, 0, nullptr, 1, 0, nullptr, nullptr, {"walk.rddl", 4, 1}}};
inline constexpr rddl_problem problem = [] {
    rddl_problem walk{};
    walk.struct_size = sizeof(rddl_problem);
    walk.fluent_size = sizeof(rddl_fluent);
    walk.fluents = fluents;
    walk.fluent_count = 4;
    walk.state_size = walk.observation_size = sizeof(Place);
    walk.action_size = sizeof(double);
    walk.max_nondef_actions = -1;
    return walk;
}();

struct Results {
    explicit Results(std::size_t count)
        : rewards(count), terminated(count), truncated(count), causes(count) {}

    rddl_transition transition(bool with_causes) {
        rddl_transition out{};
        out.rewards = rewards.data();
        out.terminated = terminated.data();
        out.truncated = truncated.data();
        if (with_causes) out.causes = causes.data();
        return out;
    }
    bool operator==(const Results&) const = default;

    std::vector<double> rewards;
    std::vector<std::uint8_t> terminated, truncated, causes;
};

template <int first_place>
void compare(std::int64_t count, bool with_causes) {
    using One = Compiled<Walk<first_place>, problem, ScalarOf<float>>;
    using Many = Packed<Walk<first_place>, problem, 16, float>;
    // With AVX-512.
    static_assert(detail::starts_with_constants<Many> == (Many::Lane::Real::part_count == 1));
    BatchOptions options;
    options.environment_count = count;
    options.autoreset = RDDL_AUTORESET_SAME_STEP;
    options.horizon = 9;
    const One one;
    const Many many;
    Batch<One> alone(one, problem, options);
    Batch<Many> together(many, problem, options);
    const auto size = static_cast<std::size_t>(count);
    Results of_alone(size), of_together(size);
    std::mt19937_64 random(5);
    for (int time = 0; time < 200; ++time) {
        std::vector<double> moves(size);
        for (double& move : moves) move = static_cast<double>(random() % 5) - 2.0;
        const auto* const actions = reinterpret_cast<const std::byte*>(moves.data());
        alone.step(actions, of_alone.transition(with_causes));
        together.step(actions, of_together.transition(with_causes));
        ASSERT_EQ(of_together, of_alone) << "time " << time;
        for (std::int64_t i = 0; i < count; ++i) {
            Place one_place{}, its_place{};
            alone.get_state(i, reinterpret_cast<std::byte*>(&one_place));
            together.get_state(i, reinterpret_cast<std::byte*>(&its_place));
            ASSERT_EQ(its_place.place, one_place.place);
            ASSERT_EQ(its_place.steps, one_place.steps);
            ASSERT_EQ(its_place.has_moved, one_place.has_moved);
            ASSERT_EQ(together.steps(i), alone.steps(i));
            ASSERT_EQ(together.episode_number(i), alone.episode_number(i));
            ASSERT_EQ(together.causes(i), alone.causes(i));
        }
    }
}

TEST(Restart, OfPacksIsThatOfOneEnvironment) {
    for (const std::int64_t count : {16, 48, 40, 3})
        for (const bool with_causes : {false, true}) compare<0>(count, with_causes);
}

TEST(Restart, InAStateThatIsTerminal) {
    for (const std::int64_t count : {32, 5}) compare<-4>(count, true);
}

// A state that is set without a number of steps keeps that of the episode, which is over at once.
TEST(Restart, AfterTheHorizon) {
    using Many = Packed<Walk<0>, problem, 16>;
    BatchOptions options;
    options.environment_count = 32;
    options.horizon = 4;
    const Many many;
    Batch<Many> batch(many, problem, options);
    const std::vector<double> moves(32);
    Results results(32);
    const auto step = [&] {
        batch.step(reinterpret_cast<const std::byte*>(moves.data()), results.transition(true));
    };
    for (int time = 0; time < 4; ++time) step();
    const std::vector<Place> places(32);
    const auto* const records = reinterpret_cast<const std::byte*>(places.data());
    batch.set_state(3, records, nullptr);
    EXPECT_EQ(batch.causes(3), RDDL_RUNNING);
    step();
    EXPECT_EQ(batch.causes(3), RDDL_TRUNCATED_HORIZON);
    batch.set_states(0, 32, records, nullptr);
    step();
    for (std::int64_t i = 0; i < 32; ++i) {
        EXPECT_EQ(batch.causes(i), RDDL_TRUNCATED_HORIZON);
        EXPECT_EQ(batch.steps(i), i == 3 ? 6 : 5);
    }
}

}  // namespace
}  // namespace rddl
