// One episode, printed digit by digit: the same text from every way of using a simulator.
#pragma once

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdio>
#include <vector>

inline int print_episode(const rddl_simulator* simulator) {
    const rddl_batch_options options{.environment_count = 2,
                                     .first_environment = 0,
                                     .seed = 7,
                                     .thread_count = 1,
                                     .autoreset = RDDL_AUTORESET_DISABLED,
                                     .horizon = -1,
                                     .lane_count = 0};
    rddl_batch* const batch = simulator->create(simulator, &options);
    if (!batch) return 1;
    const auto size = static_cast<std::size_t>(simulator->problem->action_size);
    std::vector<std::byte> actions(2 * size);
    double rewards[2] = {0, 0};
    const rddl_transition out{.observations = nullptr,
                              .rewards = rewards,
                              .terminated = nullptr,
                              .truncated = nullptr,
                              .causes = nullptr,
                              .final_observations = nullptr};
    for (int step = 0; step < 20; ++step) {
        actions[static_cast<std::size_t>(step) % size] = std::byte{1};
        if (simulator->step(batch, actions.data(), &out) != RDDL_OK) return 1;
        std::printf("%d %.17g %.17g\n", step, rewards[0], rewards[1]);
    }
    simulator->destroy(batch);
    return 0;
}
