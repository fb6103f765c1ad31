// Planning from a state: step counters, copies of environments, new random numbers, ends of
// episodes that are reset at once, and masks for several changes.
#include "tiny_batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tiny {
namespace {

const rddl_simulator& functions = *simulator();

// Single environments, and packs with lanes to spare.
constexpr std::array<std::int64_t, 2> sizes = {1, 21};

std::int64_t steps_of(TinyBatch& batch, std::int64_t environment) {
    std::int64_t steps = -1;
    EXPECT_EQ(functions.get_progress(batch.get(), environment, 1, &steps, nullptr), RDDL_OK);
    return steps;
}

StateRecord good_state() {
    StateRecord state{};
    state.running = {true, true, true};
    return state;
}

TEST(SetState, SetsTheStepCounter) {
    for (const std::int64_t size : sizes) {
        TinyBatch batch(batch_options(size));
        const std::int64_t last = size - 1, late = problem.horizon - 1, over = problem.horizon;
        const StateRecord state = good_state();
        ASSERT_EQ(functions.set_state(batch.get(), last, 1, &state, &late), RDDL_OK);
        EXPECT_EQ(steps_of(batch, last), late);
        batch.step();
        EXPECT_TRUE(batch.causes[static_cast<std::size_t>(last)] & RDDL_TRUNCATED_HORIZON);
        std::uint8_t causes = 9;
        ASSERT_EQ(functions.set_state(batch.get(), last, 1, &state, &over), RDDL_OK);
        EXPECT_EQ(functions.get_causes(batch.get(), last, 1, &causes), RDDL_OK);
        EXPECT_EQ(causes, RDDL_TRUNCATED_HORIZON);
        const std::int64_t negative = -1;
        EXPECT_EQ(functions.set_state(batch.get(), last, 1, &state, &negative), RDDL_BAD_ARGUMENT);
        EXPECT_STREQ(functions.last_error(&functions), "a count of steps is negative: -1");
    }
}

TEST(CopyEnvironments, GoOnLikeTheirSources) {
    for (const std::int64_t size : sizes)
        for (const std::int64_t target_size : sizes) {
            TinyBatch source(batch_options(size, 5));
            for (int time = 0; time < 7; ++time) source.step();
            TinyBatch target(batch_options(target_size, 100, 9));
            target.step();
            const std::int64_t from = size - 1, to = target_size - 1;
            ASSERT_EQ(functions.copy_environments(target.get(), to, 1, source.get(), &from),
                      RDDL_OK);
            EXPECT_EQ(steps_of(target, to), 7);
            for (int time = 0; time < 60; ++time) {  // into the next episodes
                source.step();
                target.step();
                const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
                ASSERT_EQ(target.rewards[b], source.rewards[a]) << time;
                ASSERT_EQ(target.causes[b], source.causes[a]);
                ASSERT_EQ(target.observations[b].wear, source.observations[a].wear);
                if (source.causes[a] == RDDL_RUNNING) continue;
                functions.reset(source.get(), nullptr, nullptr);
                functions.reset(target.get(), nullptr, nullptr);
            }
        }
}

TEST(CopyEnvironments, WithinABatchLeavesTheOthersAlone) {
    TinyBatch batch(batch_options(20)), untouched(batch_options(20));
    batch.step();
    untouched.step();
    const std::array<std::int64_t, 3> sources = {0, 0, 19};
    ASSERT_EQ(functions.copy_environments(batch.get(), 15, 3, batch.get(), sources.data()),
              RDDL_OK);
    batch.step();
    untouched.step();
    for (std::size_t i = 0; i < 20; ++i) {
        const std::size_t like = i == 15 || i == 16 ? 0 : i == 17 ? 19 : i;
        EXPECT_EQ(batch.observations[i].wear, untouched.observations[like].wear) << i;
    }
}

// Many copies of one environment, of which whole blocks are copied at once, are as single copies.
TEST(CopyEnvironments, OfOneAreAsSingleCopies) {
    for (const rddl_autoreset reset : {RDDL_AUTORESET_DISABLED, RDDL_AUTORESET_SAME_STEP}) {
        TinyBatch source(batch_options(30, 5)), many(batch_options(150, 100, 9, 1, reset)),
            single(batch_options(150, 100, 9, 1, reset));
        for (int time = 0; time < 7; ++time) source.step();
        for (int time = 0; time < 3; ++time) {
            many.step();
            single.step();
        }
        const std::vector<std::int64_t> sources(140, 17);
        ASSERT_EQ(functions.copy_environments(many.get(), 5, 140, source.get(), sources.data()),
                  RDDL_OK);
        for (std::int64_t i = 5; i < 145; ++i)
            ASSERT_EQ(functions.copy_environments(single.get(), i, 1, source.get(), sources.data()),
                      RDDL_OK);
        // Neighbours with the same seed, and with others.
        for (std::int64_t i = 0; i < 150; ++i) {
            const auto seed = static_cast<std::uint64_t>(i / 3);
            ASSERT_EQ(functions.set_seeds(many.get(), i, 1, &seed), RDDL_OK);
        }
        for (std::int64_t i = 149; i >= 0; --i) {
            const auto seed = static_cast<std::uint64_t>(i / 3);
            ASSERT_EQ(functions.set_seeds(single.get(), i, 1, &seed), RDDL_OK);
        }
        for (int time = 0; time < 60; ++time) {
            many.step();
            single.step();
            for (std::size_t i = 0; i < 150; ++i) {
                ASSERT_EQ(many.rewards[i], single.rewards[i]) << time << " " << i;
                ASSERT_EQ(many.causes[i], single.causes[i]);
                ASSERT_EQ(many.observations[i].wear, single.observations[i].wear);
            }
        }
    }
}

// Functions that take many environments at once, whole blocks of them together, do the same with
// each of them as by itself.
TEST(ManyEnvironments, AreAsSingleOnes) {
    constexpr std::int64_t size = 200, begin = 5, count = 190;
    TinyBatch many(batch_options(size)), single(batch_options(size));
    for (int time = 0; time < 25; ++time)
        for (TinyBatch* batch : {&many, &single}) {
            for (std::int64_t i = 0; i < size; ++i)
                batch->actions[static_cast<std::size_t>(i)] = action_of(i, time);
            batch->step();
        }
    std::vector<StateRecord> states = blank_states(count);
    ASSERT_EQ(functions.get_state(many.get(), begin, count, states.data()), RDDL_OK);
    for (std::int64_t k = 0; k < count; ++k) {
        StateRecord state = blank_states(1).front();
        ASSERT_EQ(functions.get_state(single.get(), begin + k, 1, &state), RDDL_OK);
        ASSERT_EQ(std::memcmp(&state, &states[static_cast<std::size_t>(k)], sizeof state), 0) << k;
    }
    std::ranges::reverse(states);
    std::vector<std::int64_t> steps;
    std::vector<std::uint64_t> seeds;
    for (std::int64_t k = 0; k < count; ++k) {
        steps.push_back(k % 7 == 3 ? problem.horizon : k % 5);
        seeds.push_back(static_cast<std::uint64_t>(k / 2));
    }
    for (const bool with_steps : {true, false}) {
        const std::int64_t* const given = with_steps ? steps.data() : nullptr;
        ASSERT_EQ(functions.set_state(many.get(), begin, count, states.data(), given), RDDL_OK);
        ASSERT_EQ(functions.set_seeds(many.get(), begin, count, seeds.data()), RDDL_OK);
        for (std::int64_t k = 0; k < count; ++k) {
            const auto place = static_cast<std::size_t>(k);
            ASSERT_EQ(functions.set_state(single.get(), begin + k, 1, &states[place],
                                          with_steps ? &steps[place] : nullptr),
                      RDDL_OK);
            ASSERT_EQ(functions.set_seeds(single.get(), begin + k, 1, &seeds[place]), RDDL_OK);
        }
        for (int time = 0; time < 12; ++time) {
            std::vector<std::uint8_t> causes(size), expected(size);
            functions.get_causes(many.get(), 0, size, causes.data());
            functions.get_causes(single.get(), 0, size, expected.data());
            ASSERT_EQ(causes, expected) << time;
            if (time == 6) {
                functions.draw_medians(many.get(), begin, count);
                for (std::int64_t k = 0; k < count; ++k)
                    functions.draw_medians(single.get(), begin + k, 1);
            }
            many.step();
            single.step();
            for (std::size_t i = 0; i < size; ++i) {
                ASSERT_EQ(many.rewards[i], single.rewards[i]) << time << " " << i;
                ASSERT_EQ(std::memcmp(&many.observations[i], &single.observations[i],
                                      sizeof(StateRecord)),
                          0)
                    << time << " " << i;
            }
        }
    }
}

TEST(CopyEnvironments, RefusesOtherSimulatorsAndPlaces) {
    TinyBatch batch(batch_options(4));
    const std::int64_t beyond = 4;
    EXPECT_EQ(functions.copy_environments(batch.get(), 0, 1, batch.get(), &beyond),
              RDDL_BAD_ARGUMENT);
    EXPECT_EQ(functions.copy_environments(batch.get(), 3, 2, batch.get(), nullptr),
              RDDL_BAD_ARGUMENT);
    static const rddl::SimulatorTable other(rddl::About{problem, sites, {}},
                                            rddl::Compiled<Simulator, problem>());
    TinyBatch stranger(batch_options(1), other.get());
    EXPECT_EQ(functions.copy_environments(batch.get(), 0, 1, stranger.get(), nullptr),
              RDDL_BAD_ARGUMENT);
    EXPECT_STREQ(functions.last_error(&functions), "the batches are of different simulators");
}

TEST(Seeds, OfEachEnvironmentAreThoseOfABatchOfOne) {
    for (const std::int64_t size : sizes) {
        TinyBatch batch(batch_options(size, 3)), one(batch_options(1, 0, 1234));
        batch.step();
        const auto last = static_cast<std::size_t>(size - 1);
        const std::uint64_t seed = 1234;
        ASSERT_EQ(functions.set_seeds(batch.get(), size - 1, 1, &seed), RDDL_OK);
        functions.reset(batch.get(), nullptr, nullptr);
        std::int64_t episodes = -1;
        EXPECT_EQ(functions.get_progress(batch.get(), size - 1, 1, nullptr, &episodes), RDDL_OK);
        EXPECT_EQ(episodes, 0);
        for (int episode = 0; episode < 2; ++episode) {
            for (int time = 0; time < 10; ++time) {
                batch.step();
                one.step();
                ASSERT_EQ(batch.observations[last].wear, one.observations[0].wear) << time;
            }
            functions.reset(batch.get(), nullptr, nullptr);
            functions.reset(one.get(), nullptr, nullptr);
        }
    }
}

TEST(Seeds, OfAllAreThoseOfANewBatch) {
    TinyBatch batch(batch_options(21, 3)), fresh(batch_options(21, 3, 77));
    for (int time = 0; time < 5; ++time) batch.step();
    ASSERT_EQ(functions.set_seed(batch.get(), 77), RDDL_OK);
    functions.reset(batch.get(), nullptr, nullptr);
    for (int time = 0; time < 10; ++time) {
        batch.step();
        fresh.step();
    }
    for (std::size_t i = 0; i < 21; ++i)
        EXPECT_EQ(batch.observations[i].wear, fresh.observations[i].wear);
}

TEST(Seeds, GiveACopyAFutureOfItsOwn) {
    for (const std::int64_t size : sizes) {
        TinyBatch batch(batch_options(size));
        batch.step();
        const auto count = static_cast<std::size_t>(size);
        TinyBatch copy(functions.copy(batch.get()), count),
            other(functions.copy(batch.get()), count);
        const std::vector<std::uint64_t> seeds(count, 5), others(count, 6);
        functions.set_seeds(copy.get(), 0, size, seeds.data());
        functions.set_seeds(other.get(), 0, size, others.data());
        EXPECT_EQ(copy.states()[0].wear, batch.states()[0].wear) << "the present stays";
        EXPECT_EQ(steps_of(copy, 0), 1);
        batch.step();
        copy.step();
        other.step();
        EXPECT_NE(copy.observations[0].wear, batch.observations[0].wear);
        EXPECT_NE(copy.observations[0].wear, other.observations[0].wear);
    }
}

TEST(FinalStates, AreToldWhereAStepResets) {
    for (const std::int64_t size : sizes) {
        const auto count = static_cast<std::size_t>(size);
        TinyBatch resetting(batch_options(size, 0, 42, 1, RDDL_AUTORESET_SAME_STEP));
        TinyBatch staying(batch_options(size));
        const std::size_t width = 2 * machines + 2;
        std::vector<StateRecord> finals = blank_states(count);
        std::vector<float> observations(count * width, -7), values(count * width, -7);
        const std::vector<float> actions(count * (machines + 2));
        rddl_transition out{};
        out.terminated = resetting.terminated.data();
        out.truncated = resetting.truncated.data();
        out.final_states = finals.data();
        out.final_observation_values = values.data();
        int ended = 0;
        for (int time = 0; time < 50; ++time) {
            ASSERT_EQ(functions.step_values(resetting.get(), RDDL_FLOAT, actions.data(),
                                            observations.data(), &out),
                      RDDL_OK);
            staying.step();
            for (std::size_t i = 0; i < count; ++i) {
                const bool over = resetting.terminated[i] || resetting.truncated[i];
                if (!over || staying.finals[i].repairs == 1) continue;
                staying.finals[i].repairs = 1;  // seen
                ++ended;
                EXPECT_EQ(finals[i].wear, staying.observations[i].wear);
                EXPECT_EQ(values[i * width], static_cast<float>(staying.observations[i].wear[0]));
                EXPECT_EQ(observations[i * width], 0.0F);
            }
        }
        EXPECT_EQ(ended, size);
    }
}

// The mask of one environment beside a given action.
std::vector<std::uint8_t> mask_of(const rddl_simulator& simulator, const ActionRecord& action) {
    rddl_batch* const batch = simulator.create(&simulator, nullptr);
    std::vector<std::uint8_t> mask(5, 9);
    EXPECT_EQ(simulator.action_mask(batch, &action, mask.data()), RDDL_OK);
    simulator.destroy(batch);
    return mask;
}

TEST(Masks, TellWhichChangesAnActionStillTakes) {
    rddl_problem pair = problem;
    pair.max_nondef_actions = 2;
    const rddl::SimulatorTable table(rddl::About{pair, sites, {}},
                                     rddl::Compiled<Simulator, problem>());
    using Mask = std::vector<std::uint8_t>;
    ActionRecord action{};
    EXPECT_EQ(mask_of(*table.get(), action), (Mask{1, 1, 1, 1, 1}));
    action.repair[1] = true;
    EXPECT_EQ(mask_of(*table.get(), action), (Mask{1, 0, 0, 0, 1})) << "one repair at a time";
    action.set_mode = 1;
    EXPECT_EQ(mask_of(*table.get(), action), (Mask{1, 0, 0, 0, 0})) << "two changes are made";
    action.repair[2] = true;
    EXPECT_EQ(mask_of(*table.get(), action)[0], 0) << "it breaks both";
}

TEST(Masks, OfPacksAreThoseOfEachAction) {
    TinyBatch batch(batch_options(21));
    batch.actions[20].repair[0] = true;
    std::vector<std::uint8_t> masks(21 * 5, 9);
    ASSERT_EQ(functions.action_mask(batch.get(), batch.actions.data(), masks.data()), RDDL_OK);
    const std::vector<std::uint8_t> last(masks.end() - 5, masks.end()),
        first(masks.begin(), masks.begin() + 5);
    EXPECT_EQ(first, (std::vector<std::uint8_t>{1, 1, 1, 1, 1}));
    EXPECT_EQ(last, (std::vector<std::uint8_t>{1, 0, 0, 0, 0})) << "max-nondef-actions is 1";
}

TEST(Choices, AreDescribed) {
    rddl_choice choice{};
    ASSERT_EQ(functions.action_choice(&functions, 0, nullptr, &choice), RDDL_OK);
    EXPECT_EQ(choice.fluent, -1);
    ASSERT_EQ(functions.action_choice(&functions, 3, nullptr, &choice), RDDL_OK);
    EXPECT_EQ(choice.fluent, 5);
    EXPECT_EQ(choice.grounding, 2);
    EXPECT_EQ(choice.value, 1);
    ASSERT_EQ(functions.action_choice(&functions, 4, nullptr, &choice), RDDL_OK);
    EXPECT_EQ(choice.fluent, 6);
    EXPECT_EQ(choice.value, 1);
}

// Steps of all environments without actions.
void make_steps(TinyBatch& batch, int count) {
    for (int time = 0; time < count; ++time) batch.step();
}

TEST(DrawMedians, LeavesNothingToLuck) {
    TinyBatch one(batch_options(1, 0, 42)), many(batch_options(21, 0, 7));
    for (TinyBatch* batch : {&one, &many}) {
        const auto count = static_cast<std::int64_t>(batch->size());
        ASSERT_EQ(functions.draw_medians(batch->get(), 0, count), RDDL_OK);
        make_steps(*batch, 10);
        for (const StateRecord& state : batch->states()) {
            EXPECT_EQ(state.running, good_state().running);  // they stop with the probability 0.02
            EXPECT_EQ(state.wear, one.states().front().wear);
        }
    }
    // The next episodes are also without luck; with other seeds there is luck again.
    TinyBatch other(batch_options(1, 0, 1));
    const std::uint64_t seed = 5;
    for (TinyBatch* batch : {&one, &other}) {
        functions.reset(batch->get(), nullptr, nullptr);
        ASSERT_EQ(functions.draw_medians(batch->get(), 0, 1), RDDL_OK);
        functions.reset(batch->get(), nullptr, nullptr);
        make_steps(*batch, 3);
    }
    EXPECT_EQ(one.states().front().wear, other.states().front().wear);
    const auto without_luck = one.states().front().wear;
    for (TinyBatch* batch : {&one, &other}) {
        ASSERT_EQ(functions.set_seeds(batch->get(), 0, 1, &seed), RDDL_OK);
        functions.reset(batch->get(), nullptr, nullptr);
        make_steps(*batch, 3);
    }
    EXPECT_EQ(one.states().front().wear, other.states().front().wear);
    EXPECT_NE(one.states().front().wear, without_luck);
}

TEST(DrawMedians, LeavesOtherEnvironmentsTheirLuck) {
    TinyBatch some(batch_options(21)), none(batch_options(21));
    ASSERT_EQ(functions.draw_medians(some.get(), 3, 1), RDDL_OK);
    for (TinyBatch* batch : {&some, &none}) make_steps(*batch, 4);
    const auto states = some.states(), lucky = none.states();
    for (std::size_t k = 0; k < states.size(); ++k) {
        if (k == 3)
            EXPECT_NE(states[k].wear, lucky[k].wear);
        else
            EXPECT_EQ(states[k].wear, lucky[k].wear) << k;
    }
    EXPECT_EQ(functions.draw_medians(some.get(), 20, 2), RDDL_BAD_ARGUMENT);
}

}  // namespace
}  // namespace tiny
