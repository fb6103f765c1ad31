// All outputs of a batch of the hand-written simulator, step by step, to be compared byte for byte.
#pragma once

#include "tiny_batch.hpp"

#include <cstdint>
#include <cstring>
#include <vector>

namespace tiny {

inline constexpr std::int64_t all_environments = 1000;
inline constexpr int step_count = 120;  // more than two horizons

// All outputs of a step for one environment.
struct Told {
    unsigned char observation[sizeof(StateRecord)];
    unsigned char final_observation[sizeof(StateRecord)];
    unsigned char reward[sizeof(double)];
    std::uint8_t terminated, truncated, causes;

    bool operator==(const Told&) const = default;
};
using Trajectory = std::vector<Told>;

inline Told told_of(const TinyBatch& batch, std::size_t i) {
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
inline std::vector<Trajectory> trajectories(std::int64_t first, std::int64_t count, int threads,
                                            const rddl_simulator* functions = simulator(),
                                            int lanes = 0) {
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

inline const std::vector<Trajectory>& reference() {
    static const std::vector<Trajectory> alone =
        trajectories(0, all_environments, 1, simulator(), 1);
    return alone;
}

}  // namespace tiny
