// The C interface over the hand-written simulator: records, copies, refusals, messages.
#include "tiny_batch.hpp"

#include <rddl/batch/action_choices.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace tiny {
namespace {

const rddl_simulator& functions = *simulator();

constexpr rddl_batch_options four = batch_options(4, 0, 42, 1, RDDL_AUTORESET_DISABLED);

TEST(Interface, DescribesItself) {
    EXPECT_EQ(functions.abi_version, static_cast<std::uint32_t>(RDDL_ABI_VERSION));
    EXPECT_EQ(functions.struct_size, sizeof(rddl_simulator));
    EXPECT_EQ(functions.problem, &problem);
}

TEST(Interface, StartsInTheInitialState) {
    TinyBatch batch(four);
    for (const StateRecord& state : batch.states()) {
        EXPECT_EQ(state.running, (std::array{true, true, true}));
        EXPECT_EQ(state.repairs, 0);
    }
    std::int64_t steps[4], episodes[4];
    EXPECT_EQ(functions.get_progress(batch.get(), 0, 4, steps, episodes), RDDL_OK);
    EXPECT_EQ(steps[3], 0);
    EXPECT_EQ(episodes[3], 0);
}

TEST(Interface, ObservesTheStateOfAFullyObservedProblem) {
    TinyBatch batch(four);
    batch.step();
    const auto states = batch.states();
    std::vector<StateRecord> observations(4);
    EXPECT_EQ(functions.get_observation(batch.get(), 0, 4, observations.data()), RDDL_OK);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(observations[i].wear, states[i].wear);
        EXPECT_EQ(batch.observations[i].wear, states[i].wear);
    }
}

TEST(Interface, CountsStepsAndEpisodes) {
    TinyBatch batch(four);
    batch.step();
    batch.step();
    const std::uint8_t mask[] = {0, 1, 0, 0};
    EXPECT_EQ(functions.reset(batch.get(), mask, batch.observations.data()), RDDL_OK);
    EXPECT_EQ(batch.observations[1].wear[0], 0.0);
    EXPECT_NE(batch.observations[0].wear[0], 0.0);
    std::int64_t steps[2], episodes[2];
    EXPECT_EQ(functions.get_progress(batch.get(), 0, 2, steps, nullptr), RDDL_OK);
    EXPECT_EQ(functions.get_progress(batch.get(), 0, 2, nullptr, episodes), RDDL_OK);
    EXPECT_EQ(steps[0], 2);
    EXPECT_EQ(episodes[0], 0);
    EXPECT_EQ(steps[1], 0);
    EXPECT_EQ(episodes[1], 1);
}

TEST(Interface, WritesOnlyWhatIsAskedFor) {
    TinyBatch batch(four);
    const rddl_transition nothing{};
    EXPECT_EQ(functions.step(batch.get(), batch.actions.data(), &nothing), RDDL_OK);
    EXPECT_EQ(functions.reset(batch.get(), nullptr, nullptr), RDDL_OK);
}

TEST(Interface, ReadsActionsAtAnyAddress) {
    const rddl_batch_options one = batch_options(1, 0, 42, 1, RDDL_AUTORESET_DISABLED);
    TinyBatch aligned(one), unaligned(one);
    aligned.actions[0] = action_of(1, 2);
    aligned.step();
    std::array<std::byte, sizeof(ActionRecord) + 1> bytes;
    std::memcpy(&bytes[1], aligned.actions.data(), sizeof(ActionRecord));
    const rddl_transition nothing{};
    EXPECT_EQ(functions.step(unaligned.get(), &bytes[1], &nothing), RDDL_OK);
    EXPECT_EQ(std::memcmp(aligned.states().data(), unaligned.states().data(), sizeof(StateRecord)),
              0);
}

TEST(Interface, TakesTheHorizonFromTheInstanceOrTheOptions) {
    for (const auto& [option, expected] : {std::pair(0, 50), {3, 3}}) {
        TinyBatch batch(batch_options(1, 0, 42, 1, RDDL_AUTORESET_DISABLED, option));
        int steps = 0;
        do {
            batch.actions[0].repair = {true, true, true};
            batch.step();
            ++steps;
        } while (batch.causes[0] == RDDL_RUNNING);
        EXPECT_EQ(steps, expected);
        EXPECT_EQ(batch.causes[0], RDDL_TRUNCATED_HORIZON);
    }
}

TEST(Interface, SetsStatesInPart) {
    TinyBatch batch(four);
    StateRecord state{};
    state.running[1] = true;
    state.wear = {1.0, 2.0, 3.0};
    state.mode = 1;
    EXPECT_EQ(functions.set_state(batch.get(), 2, 1, &state, nullptr), RDDL_OK);
    const auto states = batch.states();
    EXPECT_EQ(states[2].wear, state.wear);
    EXPECT_EQ(states[1].wear[0], 0.0);
}

TEST(Interface, EndsTheEpisodeOfATerminalStateThatIsSet) {
    TinyBatch batch(four);
    const StateRecord nothing_runs{};
    EXPECT_EQ(functions.set_state(batch.get(), 0, 1, &nothing_runs, nullptr), RDDL_OK);
    std::uint8_t causes[4];
    EXPECT_EQ(functions.get_causes(batch.get(), 0, 4, causes), RDDL_OK);
    EXPECT_EQ(causes[0], RDDL_TERMINATED);
    EXPECT_EQ(causes[1], RDDL_RUNNING);
}

// A step of one environment takes another way.
TEST(Interface, RefusesAnActionOfOneEnvironmentThatNamesNoObject) {
    TinyBatch batch(batch_options(1, 0, 42, 1, RDDL_AUTORESET_DISABLED));
    const rddl_transition nothing{};
    for (const std::int64_t mode :
         {std::int64_t{-1}, std::int64_t{2}, std::numeric_limits<std::int64_t>::min()}) {
        batch.actions[0].set_mode = mode;
        EXPECT_EQ(functions.step(batch.get(), batch.actions.data(), &nothing), RDDL_BAD_ARGUMENT);
        EXPECT_EQ(functions.step(batch.get(), nullptr, &nothing), RDDL_BAD_ARGUMENT);
    }
    const auto expect_steps = [&](std::int64_t expected) {
        std::int64_t steps;
        EXPECT_EQ(functions.get_progress(batch.get(), 0, 1, &steps, nullptr), RDDL_OK);
        EXPECT_EQ(steps, expected);
    };
    expect_steps(0);
    batch.actions[0].set_mode = 1;
    EXPECT_EQ(functions.step(batch.get(), batch.actions.data(), &nothing), RDDL_OK);
    expect_steps(1);
}

TEST(Interface, RefusesStatesAndActionsThatNameNoObject) {
    TinyBatch batch(four);
    StateRecord state{};
    for (const std::int64_t mode :
         {std::int64_t{-1}, std::int64_t{2}, std::numeric_limits<std::int64_t>::min()}) {
        state.mode = mode;
        EXPECT_EQ(functions.set_state(batch.get(), 0, 1, &state, nullptr), RDDL_BAD_ARGUMENT);
        batch.actions[3].set_mode = mode;
        const rddl_transition nothing{};
        EXPECT_EQ(functions.step(batch.get(), batch.actions.data(), &nothing), RDDL_BAD_ARGUMENT);
        std::int32_t violated[4];
        EXPECT_EQ(functions.violated_preconditions(batch.get(), batch.actions.data(), violated),
                  RDDL_BAD_ARGUMENT);
    }
    std::int64_t steps[4];
    EXPECT_EQ(functions.get_progress(batch.get(), 0, 4, steps, nullptr), RDDL_OK);
    EXPECT_EQ(steps[0], 0) << "a refused step changes nothing";
}

TEST(Interface, ReadsAnyByteButZeroAsTrue) {
    for (const std::int64_t count : {1, 40})  // alone, and in packs
        for (const int value : {2, 0x80, 0xFF}) {
            const auto byte = static_cast<std::uint8_t>(value);
            const rddl_batch_options options =
                batch_options(count, 0, 42, 1, RDDL_AUTORESET_DISABLED);
            TinyBatch usual(options), unusual(options);
            const auto last = static_cast<std::size_t>(count) - 1;
            usual.actions[last].repair[2] = true;
            std::memcpy(&unusual.actions[last].repair[2], &byte, 1);
            StateRecord state{};
            state.running[1] = true;
            EXPECT_EQ(functions.set_state(usual.get(), 0, 1, &state, nullptr), RDDL_OK);
            std::memcpy(&state.running[1], &byte, 1);
            EXPECT_EQ(functions.set_state(unusual.get(), 0, 1, &state, nullptr), RDDL_OK);
            usual.step();
            unusual.step();
            EXPECT_EQ(usual.rewards, unusual.rewards);
            const auto expected = usual.states(), states = unusual.states();
            EXPECT_EQ(std::memcmp(states.data(), expected.data(), sizeof(StateRecord) * (last + 1)),
                      0);
            EXPECT_EQ(states[last].repairs, 1);
        }
}

TEST(Interface, RefusesOptionsOutOfRange) {
    const auto refused = [](const rddl_batch_options& options) {
        return functions.create(&functions, &options) == nullptr;
    };
    EXPECT_TRUE(refused(batch_options(-5, 0, 0, 1, RDDL_AUTORESET_DISABLED)));
    EXPECT_TRUE(refused(batch_options(1, 0, 0, -1, RDDL_AUTORESET_DISABLED)));
    EXPECT_TRUE(refused(batch_options(1, 0, 0, 1, RDDL_AUTORESET_DISABLED, -2)));
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t count : {std::int64_t{1} << 60, most / 2, most - 15, most - 1, most})
        EXPECT_TRUE(refused(batch_options(count, 0, 0, 1, RDDL_AUTORESET_DISABLED))) << count;
    rddl_batch_options unknown_mode = batch_options(1, 0, 0, 1, RDDL_AUTORESET_DISABLED);
    for (const int number : {-1, 3, 4, 1'000'000}) {
        std::memcpy(&unknown_mode.autoreset, &number, sizeof number);
        EXPECT_TRUE(refused(unknown_mode));
    }
    EXPECT_EQ(functions.create(nullptr, nullptr), nullptr);
}

// A caller in C may write such a number.
TEST(Interface, RefusesNumbersOfNoKind) {
    TinyBatch batch(four);
    using StepValues = rddl_error (*)(rddl_batch*, int, const void*, void*, const rddl_transition*);
    const auto step_values = reinterpret_cast<StepValues>(functions.step_values);
    const rddl_transition nothing{};
    for (const int number : {-1, 2, 3, 1'000'000})
        EXPECT_EQ(step_values(batch.get(), number, nullptr, nullptr, &nothing), RDDL_BAD_ARGUMENT);
}

TEST(Interface, RefusesRangesAndPointersThatAreWrong) {
    TinyBatch batch(four);
    StateRecord states[8];
    for (const auto& [begin, count] : {std::pair<std::int64_t, std::int64_t>(-1, 1),
                                       {0, 5},
                                       {4, 1},
                                       {0, -1},
                                       {1, std::numeric_limits<std::int64_t>::max()},
                                       {5, 0}}) {
        EXPECT_EQ(functions.get_state(batch.get(), begin, count, states), RDDL_BAD_ARGUMENT);
        EXPECT_EQ(functions.set_state(batch.get(), begin, count, states, nullptr),
                  RDDL_BAD_ARGUMENT);
        EXPECT_EQ(functions.get_progress(batch.get(), begin, count, nullptr, nullptr),
                  RDDL_BAD_ARGUMENT);
    }
    EXPECT_EQ(functions.get_state(batch.get(), 4, 0, states), RDDL_OK);
    EXPECT_EQ(functions.get_state(batch.get(), 0, 1, nullptr), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(functions.get_state(nullptr, 0, 1, states), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(functions.step(batch.get(), nullptr, nullptr), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(functions.reset(nullptr, nullptr, nullptr), RDDL_BAD_ARGUMENT);
    rddl_fault fault{};
    EXPECT_EQ(functions.get_fault(batch.get(), 4, &fault), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(functions.copy(nullptr), nullptr);
    functions.destroy(nullptr);
}

TEST(Interface, TellsFaultsInWords) {
    TinyBatch batch(four);
    rddl_fault fault{};
    EXPECT_EQ(functions.get_fault(batch.get(), 2, &fault), RDDL_OK);
    EXPECT_EQ(fault.faulty, 0);
    batch.step();
    batch.actions[2].hazard = 1.28;
    batch.step();
    EXPECT_EQ(batch.causes, (std::vector<std::uint8_t>{0, 0, RDDL_FAULTED, 0}));
    EXPECT_EQ(functions.get_fault(batch.get(), 2, &fault), RDDL_OK);
    EXPECT_EQ(fault.faulty, 1);
    EXPECT_EQ(fault.step, 1);
    EXPECT_EQ(fault.source.line, 22);
    EXPECT_EQ(fault.source.column, 24);
    EXPECT_STREQ(fault.message,
                 "tiny.rddl:22:24: Bernoulli's probability must be in [0, 1], found 1.3 "
                 "(at ?m = mill)");
    EXPECT_EQ(functions.get_fault(batch.get(), 1, &fault), RDDL_OK);
    EXPECT_EQ(fault.faulty, 0);
}

TEST(Interface, ReportsPreconditionsWithoutEnforcingThem) {
    TinyBatch batch(four);
    batch.actions[1].repair = {true, false, true};
    batch.actions[2].repair = {false, false, true};
    std::int32_t violated[4];
    EXPECT_EQ(functions.violated_preconditions(batch.get(), batch.actions.data(), violated),
              RDDL_OK);
    EXPECT_EQ(violated[0], -1);
    EXPECT_EQ(violated[1], 0);
    EXPECT_EQ(violated[2], -1);
    batch.step();
    EXPECT_EQ(batch.states()[1].repairs, 2);
}

// The choices of the tiny simulator: no-op, three repairs, the other mode. A hazard is real.
constexpr std::int64_t tiny_choices = 5;

TEST(Choices, AreTheSingleChangesOfTheDefaultAction) {
    ASSERT_EQ(functions.action_choice_count(&functions), tiny_choices);
    const auto choice = [](std::int64_t k) {
        ActionRecord action;
        EXPECT_EQ(functions.action_choice(&functions, k, &action, nullptr), RDDL_OK);
        EXPECT_EQ(action.hazard, 0.0);
        return std::pair(action.repair, action.set_mode);
    };
    using Repair = decltype(ActionRecord::repair);
    EXPECT_EQ(choice(0), std::pair(Repair{false, false, false}, std::int64_t{0}));
    EXPECT_EQ(choice(1), std::pair(Repair{true, false, false}, std::int64_t{0}));
    EXPECT_EQ(choice(3), std::pair(Repair{false, false, true}, std::int64_t{0}));
    EXPECT_EQ(choice(4), std::pair(Repair{false, false, false}, std::int64_t{1}));
    ActionRecord action;
    EXPECT_EQ(functions.action_choice(&functions, -1, &action, nullptr), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(functions.action_choice(&functions, tiny_choices, &action, nullptr),
              RDDL_BAD_ARGUMENT);
}

using Mask = std::array<std::uint8_t, tiny_choices>;

std::array<Mask, 2> masks_of(const rddl_simulator& simulator) {
    const rddl_batch_options two = batch_options(2, 0, 42, 1, RDDL_AUTORESET_DISABLED);
    rddl_batch* const batch = simulator.create(&simulator, &two);
    StateRecord state{};
    state.wear = {0.0, 12.0, 0.0};
    state.running = {true, true, true};
    EXPECT_EQ(simulator.set_state(batch, 1, 1, &state, nullptr), RDDL_OK);
    std::array<Mask, 2> masks;
    EXPECT_EQ(simulator.action_mask(batch, nullptr, masks[0].data()), RDDL_OK);
    EXPECT_EQ(simulator.action_mask(batch, nullptr, nullptr), RDDL_BAD_ARGUMENT);
    simulator.destroy(batch);
    return masks;
}

// A worn machine must be repaired, others need no repair, and while one is worn nothing is fast.
struct Strict : Simulator {
    template <class L>
    static typename L::Int violated_precondition(const State<L>& state, const Action<L>& action,
                                                 Context<L>&) {
        bool worn = false, fits = true;
        for (Index m = 0; m < machines; ++m) {
            worn |= state.wear[m] > 10.0;
            fits &= action.repair[m] == (state.wear[m] > 10.0);
        }
        return fits && !(worn && action.set_mode == 1) ? -1 : 0;
    }
};

TEST(Choices, AreMaskedByThePreconditionsOfEachState) {
    EXPECT_EQ(masks_of(functions)[0], (Mask{1, 1, 1, 1, 1}));
    const rddl::SimulatorTable strict(rddl::About{problem, sites, {}},
                                      rddl::Compiled<Strict, problem>());
    const auto masks = masks_of(*strict.get());
    EXPECT_EQ(masks[0], (Mask{1, 0, 0, 0, 1}));
    EXPECT_EQ(masks[1], (Mask{0, 0, 1, 0, 0})) << "here even the default action is illegal";
}

TEST(Choices, AreMaskedByTheLimitOfActions) {
    rddl_problem limited = problem;
    limited.max_nondef_actions = 0;
    const rddl::SimulatorTable table(rddl::About{limited, sites, {}},
                                     rddl::Compiled<Simulator, problem>());
    EXPECT_EQ(masks_of(*table.get())[0], (Mask{1, 0, 0, 0, 0}));
}

// Actions of three ints that are bounded differently; the default, 2, is not a value of the last.
TEST(Choices, OfIntsNeedTwoBoundsNotTooFarApart) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double lower[]{0.5, -infinity, 0.0, 5.0, 4.0};
    const double upper[]{3.0, 3.0, 1e9, 6.0, 3.0};
    const std::int64_t defaults[]{2, 2, 2, 2, 2};
    rddl_fluent fluent{};
    fluent.role = RDDL_ACTION;
    fluent.scalar = RDDL_INT;
    fluent.range_type = -1;
    fluent.count = 5;
    fluent.lower = lower;
    fluent.upper = upper;
    rddl_problem ints{};
    ints.fluents = &fluent;
    ints.fluent_count = 1;
    ints.default_action = defaults;

    std::vector<std::vector<std::int64_t>> all;
    rddl::for_each_choice(ints, [&](std::int64_t choice, const rddl::Change& change) {
        all.emplace_back(defaults, defaults + 5);
        EXPECT_EQ(choice, static_cast<std::int64_t>(all.size()));
        EXPECT_EQ(change.exchange(all.back().data(), change.value), 2);
        std::vector<std::int64_t> written(defaults, defaults + 5);
        const rddl::Change same = rddl::change_of(ints, choice);
        same.exchange(written.data(), same.value);
        EXPECT_EQ(written, all.back());
    });
    EXPECT_EQ(all, (std::vector<std::vector<std::int64_t>>{
                       {1, 2, 2, 2, 2}, {3, 2, 2, 2, 2}, {2, 2, 2, 5, 2}, {2, 2, 2, 6, 2}}));
    EXPECT_EQ(rddl::choice_count(ints), 5);
}

TEST(Interface, CopiesAreIndependentAndGoOnAlike) {
    TinyBatch original(batch_options(100, 0, 42, 2, RDDL_AUTORESET_NEXT_STEP));
    for (int t = 0; t < 30; ++t) original.step();
    TinyBatch copy(functions.copy(original.get()), 100);
    for (int t = 0; t < 60; ++t) original.step();
    EXPECT_EQ(copy.states()[0].repairs, 0);
    for (int t = 0; t < 60; ++t) copy.step();
    EXPECT_EQ(copy.rewards, original.rewards);
    EXPECT_EQ(copy.causes, original.causes);
    for (std::size_t i = 0; i < 100; ++i)
        EXPECT_EQ(copy.observations[i].wear, original.observations[i].wear);
}

}  // namespace
}  // namespace tiny
