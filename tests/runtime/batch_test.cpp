// The promise: an environment's trajectory is bit for bit the same whatever the batch around it,
// its place in it, the number of threads, and how many environments are stepped together.
#include "tiny_batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tiny {
namespace {

constexpr std::int64_t all_environments = 1000;
constexpr int step_count = 120;  // more than two horizons

// Everything that a step tells of one environment.
struct Told {
    unsigned char observation[sizeof(StateRecord)];
    unsigned char final_observation[sizeof(StateRecord)];
    unsigned char reward[sizeof(double)];
    std::uint8_t terminated, truncated, causes;

    bool operator==(const Told&) const = default;
};
using Trajectory = std::vector<Told>;

Told told_of(const TinyBatch& batch, std::size_t i) {
    Told told{};
    std::memcpy(told.observation, &batch.observations[i], sizeof(StateRecord));
    if (batch.causes[i] != RDDL_RUNNING)
        std::memcpy(told.final_observation, &batch.finals[i], sizeof(StateRecord));
    std::memcpy(told.reward, &batch.rewards[i], sizeof(double));
    told.terminated = batch.terminated[i];
    told.truncated = batch.truncated[i];
    told.causes = batch.causes[i];
    return told;
}

// One trajectory for each environment from `first` on.
std::vector<Trajectory> trajectories(std::int64_t first, std::int64_t count, int threads,
                                     const rddl_simulator* functions = simulator(), int lanes = 0) {
    TinyBatch batch(batch_options(count, first, 42, threads, RDDL_AUTORESET_SAME_STEP, 0, lanes),
                    functions);
    std::vector<Trajectory> result(batch.size());
    for (int time = 0; time < step_count; ++time) {
        for (std::size_t i = 0; i < batch.size(); ++i)
            batch.actions[i] = action_of(first + static_cast<std::int64_t>(i), time);
        batch.step();
        for (std::size_t i = 0; i < batch.size(); ++i) result[i].push_back(told_of(batch, i));
    }
    return result;
}

const std::vector<Trajectory>& reference() {
    static const std::vector<Trajectory> alone =
        trajectories(0, all_environments, 1, simulator(), 1);
    return alone;
}

TEST(Trajectories, CoverEveryCauseOfAnEnd) {
    int causes = 0;
    for (const Trajectory& trajectory : reference())
        for (const Told& told : trajectory) causes |= told.causes;
    EXPECT_EQ(causes,
              RDDL_TERMINATED | RDDL_TRUNCATED_HORIZON | RDDL_TRUNCATED_INVARIANT | RDDL_FAULTED);
}

TEST(Trajectories, DoNotDependOnTheBatchOrThePlace) {
    for (const std::int64_t size : {1, 7, 64, 1000})
        for (std::int64_t first = 0; first < all_environments; first += 83 * size) {
            const std::int64_t count = std::min(size, all_environments - first);
            const auto found = trajectories(first, count, 1);
            for (std::int64_t i = 0; i < count; ++i)
                ASSERT_EQ(found[static_cast<std::size_t>(i)],
                          reference()[static_cast<std::size_t>(first + i)])
                    << "environment " << first + i << " in a batch of " << size;
        }
}

TEST(Trajectories, DoNotDependOnTheThreads) {
    for (const int threads : {2, 3, 4, 0})
        EXPECT_EQ(trajectories(0, all_environments, threads), reference()) << threads;
    EXPECT_EQ(trajectories(0, 5, 4),
              std::vector<Trajectory>(reference().begin(), reference().begin() + 5));
}

template <int lanes, class Real = double>
const rddl_simulator* simulator_with_lanes() {
    using Engine = rddl::Compiled<Simulator, problem, rddl::ScalarOf<Real>>;
    static const rddl::SimulatorTable<Engine, rddl::Packed<Simulator, problem, lanes, Real>> table(
        {problem, sites, {}}, {});
    return table.get();
}

TEST(Trajectories, DoNotDependOnTheLanes) {
    for (const rddl_simulator* const functions :
         {simulator_with_lanes<8>(), simulator_with_lanes<16>(), simulator_with_lanes<32>(),
          simulator_with_lanes<64>()}) {
        EXPECT_EQ(trajectories(0, all_environments, 1, functions, functions->lane_count),
                  reference())
            << functions->lane_count << " lanes, " << functions->instruction_set;
        const auto few = trajectories(3, 5, 1, functions, functions->lane_count);
        EXPECT_EQ(few, std::vector<Trajectory>(reference().begin() + 3, reference().begin() + 8));
    }
}

TEST(Trajectories, OfFloatsDoNotDependOnTheLanes) {
    const rddl_simulator* const sixteen = simulator_with_lanes<16, float>();
    const auto alone = trajectories(0, all_environments, 1, sixteen, 1);
    for (const rddl_simulator* const functions :
         {sixteen, simulator_with_lanes<32, float>(), simulator_with_lanes<64, float>()})
        for (const int threads : {1, 3})
            EXPECT_EQ(trajectories(0, all_environments, threads, functions, functions->lane_count),
                      alone)
                << functions->lane_count << " lanes, " << functions->instruction_set;
}

TEST(Trajectories, OfFloatsAreNearThoseOfDoubles) {
    const rddl_simulator* const floats = simulator_with_lanes<16, float>();
    TinyBatch near(batch_options(all_environments, 0, 42, 1, RDDL_AUTORESET_DISABLED), floats);
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

// The values of a record as a row of a matrix.
template <class Number>
void append(std::vector<Number>& row, const ActionRecord& action) {
    for (const bool repair : action.repair) row.push_back(repair);
    row.push_back(static_cast<Number>(action.set_mode));
    row.push_back(static_cast<Number>(action.hazard));
}
template <class Number>
void append(std::vector<Number>& row, const StateRecord& state) {
    for (const double wear : state.wear) row.push_back(static_cast<Number>(wear));
    for (const bool running : state.running) row.push_back(running);
    row.push_back(static_cast<Number>(state.mode));
    row.push_back(static_cast<Number>(state.repairs));
}

template <class Number>
void expect_matrices_like_records(rddl_number number, std::int64_t count) {
    const rddl_batch_options options = batch_options(count, 0, 42, 1, RDDL_AUTORESET_SAME_STEP);
    TinyBatch records(options), matrices(options);
    ASSERT_EQ(simulator()->action_value_count(simulator()), machines + 2);
    ASSERT_EQ(simulator()->observation_value_count(simulator()), 2 * machines + 2);
    const auto width = static_cast<std::size_t>(2 * machines + 2);
    std::vector<Number> observations(records.size() * width);
    for (int time = 0; time < step_count; ++time) {
        std::vector<Number> actions, expected;
        for (std::size_t i = 0; i < records.size(); ++i) {
            records.actions[i] = action_of(static_cast<std::int64_t>(i), time);
            append(actions, records.actions[i]);
        }
        records.step();
        for (const StateRecord& state : records.observations) append(expected, state);
        rddl_transition out{};
        out.rewards = matrices.rewards.data();
        ASSERT_EQ(simulator()->step_values(matrices.get(), number, actions.data(),
                                           observations.data(), &out),
                  RDDL_OK);
        EXPECT_EQ(matrices.rewards, records.rewards);
        EXPECT_EQ(observations, expected);
        std::ranges::fill(observations, Number{-1});
        ASSERT_EQ(simulator()->get_observation_values(matrices.get(), number, observations.data()),
                  RDDL_OK);
        EXPECT_EQ(observations, expected);
    }
}

TEST(Matrices, StepLikeRecords) {
    for (const std::int64_t count : {1, 7, 40}) {
        expect_matrices_like_records<double>(RDDL_DOUBLE, count);
        expect_matrices_like_records<float>(RDDL_FLOAT, count);
    }
}

TEST(Matrices, OfActionsThatAreNoneAreRefused) {
    TinyBatch batch(batch_options(1, 0, 42, 1, RDDL_AUTORESET_DISABLED));
    const rddl_transition out{};
    const auto status_of = [&](double repair, double mode) {
        const double row[] = {repair, 0, 0, mode, 0};
        return simulator()->step_values(batch.get(), RDDL_DOUBLE, row, nullptr, &out);
    };
    EXPECT_EQ(status_of(1, 1), RDDL_OK);
    EXPECT_EQ(status_of(std::nan(""), 1), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(status_of(1, 2), RDDL_BAD_ARGUMENT) << "there are two modes";
    EXPECT_EQ(status_of(1, -1), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(simulator()->step_values(batch.get(), RDDL_DOUBLE, nullptr, nullptr, &out),
              RDDL_BAD_ARGUMENT);
    EXPECT_STREQ(simulator()->last_error(simulator()), "the actions are missing");
}

TEST(Trajectories, DependOnTheSeed) {
    TinyBatch one(batch_options(1, 0, 1, 1, RDDL_AUTORESET_DISABLED));
    TinyBatch other(batch_options(1, 0, 2, 1, RDDL_AUTORESET_DISABLED));
    one.step();
    other.step();
    EXPECT_NE(one.observations[0].wear, other.observations[0].wear);
}

TEST(Trajectories, AreRepeatedBySettingTheState) {
    TinyBatch batch(batch_options(8, 0, 42, 1, RDDL_AUTORESET_DISABLED, RDDL_NO_HORIZON));
    batch.step();
    const auto before = batch.states();
    batch.step();
    // The step counter goes on, so that the same state meets new random numbers...
    const auto first_time = batch.states();
    ASSERT_EQ(simulator()->set_state(batch.get(), 0, 8, before.data(), nullptr), RDDL_OK);
    batch.step();
    EXPECT_NE(batch.states()[0].wear, first_time[0].wear);
    // ... while a copy made before the step repeats it.
    TinyBatch copy(simulator()->copy(batch.get()), 8);
    batch.step();
    copy.step();
    EXPECT_EQ(
        std::memcmp(batch.observations.data(), copy.observations.data(), 8 * sizeof(StateRecord)),
        0);
}

}  // namespace
}  // namespace tiny
