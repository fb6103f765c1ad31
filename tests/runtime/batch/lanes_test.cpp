// The promise: a trajectory is bit for bit the same however many environments are stepped together,
// with every instruction set.
#include "trajectories.hpp"

#include <rddl/interface/abi.hpp>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

// The tables of 16 and 64 lanes and of byte ints are in batches.cpp.
extern template rddl_simulator rddl::table_of(const SimulatorParts<Pack<16>>&);
extern template rddl_simulator rddl::table_of(const SimulatorParts<Pack<64>>&);
extern template rddl_simulator rddl::table_of(const SimulatorParts<Pack<16, float>>&);
extern template rddl_simulator rddl::table_of(const SimulatorParts<Pack<64, float>>&);
#ifdef RDDL_SIMD_BYTE_INTS
extern template rddl_simulator rddl::table_of(const SimulatorParts<ByteIntPack<>>&);
extern template rddl_simulator rddl::table_of(const SimulatorParts<ByteIntPack<float>>&);
#endif

namespace tiny {
namespace {

template <int lanes, class Real = double>
const rddl_simulator* simulator_with_lanes() {
    using Engine = rddl::Compiled<Simulator, problem, rddl::ScalarOf<Real>>;
    static const rddl::SimulatorTable<Engine, rddl::Packed<Simulator, problem, lanes, Real>> table(
        {problem, sites, {}}, {});
    return table.get();
}

// A compiler needs its time for each width: these take the fewest registers, as many as by default,
// and the most.
const rddl_simulator* const of_doubles[] = {simulator_with_lanes<8>(), simulator_with_lanes<16>(),
                                            simulator_with_lanes<64>()};
const rddl_simulator* const of_floats[] = {simulator_with_lanes<16, float>(),
                                           simulator_with_lanes<64, float>()};

template <class Real>
const rddl_simulator* simulator_with_byte_ints() {
    using Engine = rddl::Compiled<Simulator, problem, rddl::ScalarOf<Real>>;
    using Packed = rddl::PackedByteInts<Simulator, problem, 16, Real>;
    static const rddl::SimulatorTable<Engine, Packed> table({problem, sites, {}}, {});
    return table.get();
}

TEST(Trajectories, DoNotDependOnTheLanes) {
    for (const rddl_simulator* const functions : of_doubles) {
        EXPECT_EQ(trajectories(0, all_environments, 1, functions, functions->lane_count),
                  reference())
            << functions->lane_count << " lanes, " << functions->instruction_set;
        const auto few = trajectories(3, 5, 1, functions, functions->lane_count);
        EXPECT_EQ(few, std::vector<Trajectory>(reference().begin() + 3, reference().begin() + 8));
    }
}

TEST(Trajectories, OfFloatsDoNotDependOnTheLanes) {
    const auto alone = trajectories(0, all_environments, 1, of_floats[0], 1);
    for (const rddl_simulator* const functions : of_floats)
        for (const int threads : {1, 3})
            EXPECT_EQ(trajectories(0, all_environments, threads, functions, functions->lane_count),
                      alone)
                << functions->lane_count << " lanes, " << functions->instruction_set;
}

TEST(Trajectories, OfFloatsAreNearThoseOfDoubles) {
    TinyBatch near(batch_options(all_environments, 0, 42, 1, RDDL_AUTORESET_DISABLED),
                   of_floats[0]);
    TinyBatch exact(batch_options(all_environments, 0, 42, 1, RDDL_AUTORESET_DISABLED));
    for (int time = 0; time < 5; ++time) {
        for (std::size_t i = 0; i < exact.size(); ++i)
            near.actions[i] = exact.actions[i] = action_of(static_cast<std::int64_t>(i), time);
        near.step();
        exact.step();
        for (std::size_t i = 0; i < exact.size(); ++i)
            for (std::size_t m = 0; m < machines; ++m)
                ASSERT_NEAR(near.observations[i].wear[m], exact.observations[i].wear[m], 2e-3)
                    << "environment " << i << ", time " << time;
    }
}

// Its ints are small: the repairs of an episode.
TEST(ByteInts, GiveTheSameTrajectories) {
    const rddl_simulator* const functions = simulator_with_byte_ints<double>();
    EXPECT_EQ(trajectories(0, all_environments, 3, functions, functions->lane_count), reference());
    const rddl_simulator* const floats = simulator_with_byte_ints<float>();
    EXPECT_EQ(trajectories(0, all_environments, 1, floats, floats->lane_count),
              trajectories(0, all_environments, 1, of_floats[0], 1));
}

// A state that is no byte, after which all environments of the batch go on as they would.
class LargeState : public testing::Test {
  protected:
    static constexpr std::int64_t count = 100, changed = 70;

    LargeState() {
        go_on(3);
        large = packed.states()[changed];
        large.repairs = 1'000'000;
    }
    void go_on(int steps) {
        for (int k = 0; k < steps; ++k, ++time) {
            for (std::size_t i = 0; i < packed.size(); ++i)
                packed.actions[i] = alone.actions[i] =
                    action_of(static_cast<std::int64_t>(i), time);
            packed.step();
            alone.step();
        }
    }
    void expect_equal() {
        const auto states = packed.states(), expected = alone.states();
        for (std::size_t i = 0; i < packed.size(); ++i) {
            EXPECT_EQ(std::memcmp(&states[i], &expected[i], sizeof large), 0) << i;
            EXPECT_EQ(told_of(packed, i), told_of(alone, i)) << i;
        }
        EXPECT_GE(states[changed].repairs, 1'000'000);
    }

    const rddl_simulator* functions = simulator_with_byte_ints<double>();
    TinyBatch packed{
        batch_options(count, 0, 42, 1, RDDL_AUTORESET_DISABLED, 0, functions->lane_count),
        functions};
    TinyBatch alone{batch_options(count, 0, 42, 1, RDDL_AUTORESET_DISABLED, 0, 1), functions};
    StateRecord large{};
    int time = 0;
};

TEST_F(LargeState, IsSet) {
    for (TinyBatch* batch : {&packed, &alone})
        ASSERT_EQ(functions->set_state(batch->get(), changed, 1, &large, nullptr), RDDL_OK);
    go_on(4);
    expect_equal();
}

TEST_F(LargeState, IsCopiedFromABatch) {
    TinyBatch other(batch_options(1), functions);
    const std::int64_t first = 0;
    ASSERT_EQ(functions->set_state(other.get(), 0, 1, &large, nullptr), RDDL_OK);
    for (TinyBatch* batch : {&packed, &alone})
        ASSERT_EQ(functions->copy_environments(batch->get(), changed, 1, other.get(), &first),
                  RDDL_OK);
    go_on(4);
    expect_equal();
}

TEST_F(LargeState, IsInASnapshot) {
    TinyBatch other(batch_options(1), functions);
    ASSERT_EQ(functions->set_state(other.get(), 0, 1, &large, nullptr), RDDL_OK);
    std::vector<std::byte> snapshot(static_cast<std::size_t>(functions->snapshot_size(functions)));
    ASSERT_EQ(functions->get_snapshots(other.get(), 0, 1, snapshot.data()), RDDL_OK);
    for (TinyBatch* batch : {&packed, &alone})
        ASSERT_EQ(functions->set_snapshots(batch->get(), changed, 1, snapshot.data()), RDDL_OK);
    go_on(4);
    expect_equal();
}

}  // namespace
}  // namespace tiny
