// The description of a simulator: names, columns, constants, errors in words.
#include "tiny_batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace tiny {
namespace {

const rddl_simulator& functions = *simulator();

std::string name_of(std::int32_t fluent, std::int64_t grounding) {
    char text[64];
    const std::int64_t length =
        functions.grounding_name(&functions, fluent, grounding, text, sizeof text);
    return length < 0 ? "none" : std::string(text, static_cast<std::size_t>(length));
}

TEST(Names, AreThoseOfTraces) {
    EXPECT_EQ(name_of(0, 1), "wear___mill");
    EXPECT_EQ(name_of(2, 0), "mode");
    EXPECT_EQ(name_of(2, 1), "none");
    EXPECT_EQ(name_of(-1, 0), "none");
    EXPECT_EQ(name_of(8, 0), "none");
}

TEST(Names, AreCutWhereTheRoomEnds) {
    char text[6] = "-----";
    EXPECT_EQ(functions.grounding_name(&functions, 0, 1, text, 5), 11);
    EXPECT_STREQ(text, "wear");
    EXPECT_EQ(functions.grounding_name(&functions, 0, 1, nullptr, 0), 11);
}

rddl_column column_of(decltype(functions.action_column) which, std::int64_t column) {
    rddl_column told{};
    EXPECT_EQ(which(&functions, column, &told), RDDL_OK) << column;
    return told;
}

TEST(ColumnDescriptions, TellKindsAndBounds) {
    const rddl_column repair = column_of(functions.action_column, 2);
    EXPECT_EQ(name_of(repair.fluent, repair.grounding), "repair___press");
    EXPECT_EQ(repair.scalar, RDDL_BOOL);
    EXPECT_EQ(repair.lower, 0.0);
    EXPECT_EQ(repair.upper, 1.0);
    const rddl_column mode = column_of(functions.action_column, 3);
    EXPECT_EQ(mode.scalar, RDDL_INT);
    EXPECT_EQ(mode.object_count, 2);
    EXPECT_EQ(mode.upper, 1.0);
    const rddl_column wear = column_of(functions.observation_column, 0);
    EXPECT_EQ(wear.object_count, 0);
    EXPECT_EQ(wear.lower, -std::numeric_limits<double>::infinity());
    rddl_column none{};
    EXPECT_EQ(functions.action_column(&functions, 5, &none), RDDL_BAD_ARGUMENT);
    EXPECT_STREQ(functions.last_error(&functions), "there is no column 5");
    EXPECT_EQ(functions.observation_column(&functions, -1, &none), RDDL_BAD_ARGUMENT);
}

TEST(Fixed, AreInitialStatesAndDefaults) {
    StateRecord state{};
    ASSERT_EQ(functions.initial_state(&functions, &state), RDDL_OK);
    EXPECT_TRUE(state.running[2]);
    EXPECT_EQ(state.wear[0], 0.0);
    std::uint8_t running[2] = {7, 7};
    ASSERT_EQ(functions.get_constants(&functions, 1, 1, 2, running), RDDL_OK);
    EXPECT_EQ(running[0], 1);
    EXPECT_EQ(running[1], 1);
    double hazard = -1;
    ASSERT_EQ(functions.get_constants(&functions, 7, 0, 1, &hazard), RDDL_OK);
    EXPECT_EQ(hazard, 0.0);
    EXPECT_EQ(functions.get_constants(&functions, 4, 0, 1, &hazard), RDDL_BAD_ARGUMENT);
    EXPECT_STREQ(functions.last_error(&functions), "'strain' is not fixed by the instance");
    EXPECT_EQ(functions.get_constants(&functions, 1, 2, 2, running), RDDL_BAD_ARGUMENT);
    EXPECT_STREQ(functions.last_error(&functions), "'running' has no 2 values from 2 on, but 3");
}

TEST(Descriptions, AreFoundByTheirSizes) {
    const rddl_problem& problem = *functions.problem;
    EXPECT_EQ(rddl_fluent_at(&problem, 3), &problem.fluents[3]);
    EXPECT_EQ(rddl_type_at(&problem, 1), &problem.types[1]);
    EXPECT_EQ(rddl_condition_at(&problem, problem.invariants, 0), problem.invariants);
}

TEST(Options, ThatAreZeroMeanOneEnvironmentOfTheInstance) {
    const rddl_batch_options zero{};
    for (const rddl_batch_options* const options : {&zero, (const rddl_batch_options*)nullptr}) {
        TinyBatch batch(functions.create(&functions, options), 1);
        ASSERT_NE(batch.get(), nullptr);
        for (int time = 0; time < 60 && batch.causes[0] == RDDL_RUNNING; ++time) batch.step();
        std::int64_t steps = 0;
        EXPECT_EQ(functions.get_progress(batch.get(), 0, 1, &steps, nullptr), RDDL_OK);
        EXPECT_LE(steps, problem.horizon);
        EXPECT_NE(batch.causes[0], RDDL_RUNNING);
        EXPECT_EQ(functions.get_progress(batch.get(), 1, 1, &steps, nullptr), RDDL_BAD_ARGUMENT);
    }
}

TEST(Options, OfNewerHeadersAreRefusedIfTheyAskForMore) {
    struct Newer {
        rddl_batch_options options;
        std::int64_t more;
    } newer{};
    newer.options.struct_size = sizeof newer;
    TinyBatch batch(functions.create(&functions, &newer.options), 1);
    EXPECT_NE(batch.get(), nullptr);
    newer.more = 1;
    EXPECT_EQ(functions.create(&functions, &newer.options), nullptr);
    EXPECT_STREQ(functions.last_error(&functions), "an option is newer than the simulator");
}

TEST(Options, OfOlderHeadersAreTakenAsFarAsTheyGo) {
    rddl_batch_options options = batch_options(2);
    options.struct_size = offsetof(rddl_batch_options, horizon);
    options.horizon = -7;  // beyond the caller's struct
    TinyBatch batch(functions.create(&functions, &options), 2);
    EXPECT_NE(batch.get(), nullptr);
}

TEST(Errors, HaveAReason) {
    TinyBatch batch(batch_options(4));
    EXPECT_EQ(functions.get_causes(batch.get(), 3, 2, nullptr), RDDL_BAD_ARGUMENT);
    EXPECT_STREQ(functions.last_error(&functions), "the room for causes is missing");
    std::uint8_t causes[8];
    EXPECT_EQ(functions.get_causes(batch.get(), 3, 2, causes), RDDL_BAD_ARGUMENT);
    EXPECT_STREQ(functions.last_error(&functions), "there are no 2 environments from 3 on among 4");
    rddl_batch_options options = batch_options(1);
    options.lane_count = 5;
    EXPECT_EQ(functions.create(&functions, &options), nullptr);
    EXPECT_STREQ(functions.last_error(&functions),
                 "lane_count is 5, but the simulator has 16 lanes, or 1");
    batch.actions[1].set_mode = 2;
    const rddl_transition nothing{};
    EXPECT_EQ(functions.step(batch.get(), batch.actions.data(), &nothing), RDDL_BAD_ARGUMENT);
    EXPECT_STREQ(functions.last_error(&functions),
                 "environment 1: set-mode is 2, beyond the 2 objects of 'speed'");
    std::vector<double> values(
        static_cast<std::size_t>(4 * functions.action_value_count(&functions)));
    values.back() = std::nan("");
    EXPECT_EQ(functions.step_values(batch.get(), RDDL_DOUBLE, values.data(), nullptr, &nothing),
              RDDL_BAD_ARGUMENT);
    EXPECT_TRUE(std::string(functions.last_error(&functions)).starts_with("environment 3: "));
    EXPECT_TRUE(std::string(functions.last_error(&functions)).ends_with(" is nan, no number"));
}

TEST(Transitions, OfNewerHeadersAreRefusedIfTheyAskForMore) {
    TinyBatch batch(batch_options(2));
    struct {
        rddl_transition known;
        void* newer;
    } out{};
    out.known.struct_size = sizeof out;
    const auto step = [&] {
        return functions.step(batch.get(), batch.actions.data(), &out.known);
    };
    EXPECT_EQ(step(), RDDL_OK);
    out.newer = &out;
    EXPECT_EQ(step(), RDDL_UNSUPPORTED);
    EXPECT_STREQ(functions.last_error(&functions),
                 "a member of the transition is newer than the simulator");
}

}  // namespace
}  // namespace tiny
