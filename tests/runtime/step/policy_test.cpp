// The policy of a problem through the C interface, with a policy written by hand.
#include "tiny_batch.hpp"
#include "tiny_policy.hpp"

#include <rddl/step/policy.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace tiny {
namespace {

const rddl_simulator& functions = *simulator_with_policy();

rddl_batch_options options(std::int64_t count, std::int64_t first = 0) {
    return batch_options(count, first, 42, 1, RDDL_AUTORESET_DISABLED, RDDL_NO_HORIZON);
}

void act(TinyBatch& batch) {
    ASSERT_EQ(functions.policy_act(batch.get(), batch.actions.data()), RDDL_OK);
}

// The machine that an action repairs.
int repaired(const ActionRecord& action) {
    for (std::size_t m = 0; m < machines; ++m)
        if (action.repair[m]) return static_cast<int>(m);
    return -1;
}

TEST(Policy, IsDescribed) {
    EXPECT_EQ(functions.policy, &policy);
    EXPECT_EQ(simulator()->policy, nullptr);
    EXPECT_EQ(simulator()->policy_act, nullptr);
}

TEST(Policy, RemembersWithinAnEpisode) {
    TinyBatch batch(options(2), &functions);
    for (const int expected : {1, 2, 0, 1}) {
        act(batch);
        EXPECT_EQ(repaired(batch.actions[0]), expected);
        EXPECT_EQ(repaired(batch.actions[1]), expected);
        batch.step();
    }
    const std::uint8_t mask[] = {0, 1};
    functions.reset(batch.get(), mask, nullptr);
    act(batch);
    EXPECT_EQ(repaired(batch.actions[0]), 2);
    EXPECT_EQ(repaired(batch.actions[1]), 1) << "a new episode";
}

// All actions and states of the first environments, as bytes.
std::string course(std::int64_t count, std::int64_t first, int threads) {
    rddl_batch_options chosen = options(count, first);
    chosen.thread_count = threads;
    chosen.autoreset = RDDL_AUTORESET_SAME_STEP;
    TinyBatch batch(chosen, &functions);
    std::vector<std::string> courses(batch.size());
    for (int time = 0; time < 40; ++time) {
        act(batch);
        batch.step();
        for (std::size_t i = 0; i < batch.size(); ++i) {
            const ActionRecord& action = batch.actions[i];
            const StateRecord& state = batch.observations[i];
            courses[i] += std::to_string(repaired(action)) + std::to_string(action.set_mode) +
                          std::to_string(state.repairs) + std::to_string(state.wear[1]) + " ";
        }
    }
    std::string all;
    for (const std::string& each : courses) all += each;
    return all;
}

TEST(Policy, DoesNotDependOnBatchAndThreads) {
    const std::string together = course(12, 0, 1);
    EXPECT_EQ(course(12, 0, 3), together);
    EXPECT_EQ(course(5, 0, 1) + course(7, 5, 2), together);
    EXPECT_NE(course(12, 12, 1), together);
}

TEST(Policy, DoesNotDisturbTheSimulator) {
    TinyBatch asked(options(8), &functions);
    TinyBatch left_alone(options(8), &functions);
    std::vector<ActionRecord> unused(8);
    for (int time = 0; time < 15; ++time) {
        functions.policy_act(asked.get(), unused.data());
        for (std::size_t i = 0; i < asked.size(); ++i)
            asked.actions[i] = left_alone.actions[i] =
                action_of(static_cast<std::int64_t>(i), time);
        asked.step();
        left_alone.step();
        for (std::size_t i = 0; i < asked.size(); ++i)
            EXPECT_EQ(asked.observations[i].wear, left_alone.observations[i].wear);
    }
}

TEST(Policy, IsCopiedWithTheBatch) {
    TinyBatch batch(options(3), &functions);
    for (int time = 0; time < 4; ++time) act(batch);
    TinyBatch copy(functions.copy(batch.get()), batch.size(), &functions);
    act(batch);
    act(copy);
    EXPECT_EQ(repaired(batch.actions[2]), repaired(copy.actions[2]));
    EXPECT_EQ(repaired(batch.actions[2]), 2);
}

TEST(Policy, FaultsEndTheEpisode) {
    TinyBatch batch(options(2), &functions);
    for (int decision = 1; decision < 24; ++decision) act(batch);
    EXPECT_GE(repaired(batch.actions[1]), 0);
    act(batch);
    EXPECT_EQ(repaired(batch.actions[1]), -1) << "the default action";
    rddl_fault fault{};
    ASSERT_EQ(functions.get_fault(batch.get(), 1, &fault), RDDL_OK);
    EXPECT_TRUE(fault.faulty);
    EXPECT_EQ(fault.step, 0);
    EXPECT_STREQ(fault.message,
                 "policy.rddl:8:20: Bernoulli's probability must be in [0, 1], found 1.5");
    const auto before = batch.states();
    batch.step();
    EXPECT_EQ(batch.causes[1], RDDL_FAULTED);
    EXPECT_EQ(batch.states()[1].wear, before[1].wear) << "the step is not made";
    act(batch);
    EXPECT_EQ(repaired(batch.actions[1]), -1) << "the episode is over";
}

TEST(Policy, FaultsAreToldByTheStepThatResets) {
    rddl_batch_options chosen = options(1);
    chosen.autoreset = RDDL_AUTORESET_SAME_STEP;
    TinyBatch batch(chosen, &functions);
    for (int decision = 1; decision <= 24; ++decision) act(batch);
    batch.step();
    EXPECT_TRUE(batch.truncated[0]);
    EXPECT_EQ(batch.causes[0], RDDL_FAULTED);
    act(batch);
    EXPECT_EQ(repaired(batch.actions[0]), 1) << "the first decision of the next episode";
}

TEST(Policy, CountsValuesThatAreNotTheDefault) {
    ActionRecord action{};
    const auto count = [&] {
        return rddl::count_non_default(problem, reinterpret_cast<const std::byte*>(&action));
    };
    EXPECT_EQ(count(), 0);
    action.hazard = -0.0;
    EXPECT_EQ(count(), 0) << "as RDDL compares";
    action.hazard = 0.5;
    action.set_mode = 1;
    action.repair = {true, false, true};
    EXPECT_EQ(count(), 4);
}

TEST(Policy, RefusesBadArguments) {
    TinyBatch batch(options(1), &functions);
    EXPECT_EQ(functions.policy_act(nullptr, batch.actions.data()), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(functions.policy_act(batch.get(), nullptr), RDDL_BAD_ARGUMENT);
}

}  // namespace
}  // namespace tiny
