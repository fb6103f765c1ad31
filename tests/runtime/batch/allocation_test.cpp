// A batch never allocates after its creation, in a million steps with resets and faults.
#include "../../counted_allocations.hpp"
#include "tiny_batch.hpp"
#include "tiny_policy.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace tiny {
namespace {

constexpr std::int64_t environments = 50;
constexpr int steps = 1'000'000 / environments;

TEST(Allocations, AreCounted) {
    const std::int64_t before = allocations;
    TinyBatch batch(batch_options(environments, 0, 42, 1, RDDL_AUTORESET_DISABLED));
    EXPECT_GT(allocations, before);
}

void expect_no_allocations(const rddl_batch_options& options) {
    TinyBatch batch(options);
    const std::int64_t before = allocations;
    for (int time = 0; time < steps; ++time) {
        for (std::size_t i = 0; i < batch.size(); ++i)
            batch.actions[i] = action_of(static_cast<std::int64_t>(i), time);
        batch.step();
    }
    std::int32_t violated[environments];
    std::uint8_t masks[environments * 5];
    rddl_fault fault{};
    ASSERT_EQ(simulator()->action_choice_count(simulator()), 5);
    simulator()->action_mask(batch.get(), nullptr, masks);
    simulator()->violated_preconditions(batch.get(), batch.actions.data(), violated);
    simulator()->get_fault(batch.get(), 13, &fault);
    simulator()->set_state(batch.get(), 0, environments, batch.observations.data(), nullptr);
    simulator()->reset(batch.get(), nullptr, batch.observations.data());
    EXPECT_EQ(allocations, before) << options.thread_count << " threads, mode " << options.autoreset
                                   << ", lanes " << options.lane_count;
}

TEST(Allocations, DoNotHappenInSteps) {
    ASSERT_GT(simulator()->lane_count, 1);
    for (const int lanes : {1, simulator()->lane_count})
        for (const int threads : {1, 2})
            for (const rddl_autoreset mode : {RDDL_AUTORESET_NEXT_STEP, RDDL_AUTORESET_SAME_STEP})
                expect_no_allocations(batch_options(environments, 0, 42, threads, mode, 0, lanes));
}

TEST(Allocations, DoNotHappenInStepsWithMatrices) {
    const auto action_count =
        static_cast<std::size_t>(simulator()->action_value_count(simulator()));
    const auto observation_count =
        static_cast<std::size_t>(simulator()->observation_value_count(simulator()));
    std::vector<float> actions(environments * action_count);
    std::vector<float> observations(environments * observation_count);
    for (const int lanes : {1, simulator()->lane_count}) {
        TinyBatch batch(batch_options(environments, 0, 42, 2, RDDL_AUTORESET_SAME_STEP, 0, lanes));
        const rddl_transition out{};
        const std::int64_t before = allocations;
        for (int time = 0; time < 1000; ++time)
            ASSERT_EQ(simulator()->step_values(batch.get(), RDDL_FLOAT, actions.data(),
                                               observations.data(), &out),
                      RDDL_OK);
        EXPECT_EQ(allocations, before) << lanes << " lanes";
    }
}

TEST(Allocations, DoNotHappenWithFloats) {
    using Engine = rddl::Compiled<Simulator, problem, rddl::ScalarOf<float>>;
    static const rddl::SimulatorTable<Engine, rddl::Packed<Simulator, problem, 16, float>> table(
        {problem, sites, {}}, {});
    for (const int lanes : {1, 16}) {
        TinyBatch batch(batch_options(environments, 0, 42, 2, RDDL_AUTORESET_SAME_STEP, 0, lanes),
                        table.get());
        const std::int64_t before = allocations;
        for (int time = 0; time < 1000; ++time) batch.step();
        EXPECT_EQ(allocations, before) << lanes;
    }
}

TEST(Allocations, DoNotHappenInDecisions) {
    const rddl_simulator& functions = *simulator_with_policy();
    const rddl_batch_options options =
        batch_options(environments, 0, 42, 2, RDDL_AUTORESET_SAME_STEP);
    TinyBatch batch(options, &functions);
    const std::int64_t before = allocations;
    for (int time = 0; time < 1000; ++time) {
        functions.policy_act(batch.get(), batch.actions.data());
        batch.step();
    }
    EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace tiny
