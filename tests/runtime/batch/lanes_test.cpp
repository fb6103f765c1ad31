// The promise: a trajectory is bit for bit the same however many environments are stepped together,
// with every instruction set.
#include "trajectories.hpp"

#include <rddl/interface/abi.hpp>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

// The tables of 16 and 64 lanes are in batches.cpp.
extern template rddl_simulator rddl::table_of(const SimulatorParts<Pack<16>>&);
extern template rddl_simulator rddl::table_of(const SimulatorParts<Pack<64>>&);
extern template rddl_simulator rddl::table_of(const SimulatorParts<Pack<16, float>>&);
extern template rddl_simulator rddl::table_of(const SimulatorParts<Pack<64, float>>&);

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

}  // namespace
}  // namespace tiny
