// One episode, printed digit by digit: the same text from every way of using a simulator.
#pragma once

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdio>
#include <vector>

inline int print_episode(const rddl_simulator* simulator) {
    rddl_batch_options options{};
    options.environment_count = 2;
    options.seed = 7;
    options.thread_count = 1;
    rddl_batch* const batch = simulator->create(simulator, &options);
    if (!batch) return 1;
    const auto size = static_cast<std::size_t>(simulator->problem->action_size);
    std::vector<std::byte> actions(2 * size);
    double rewards[2] = {0, 0};
    rddl_transition out{};
    out.rewards = rewards;
    for (int step = 0; step < 20; ++step) {
        actions[static_cast<std::size_t>(step) % size] = std::byte{1};
        if (simulator->step(batch, actions.data(), &out) != RDDL_OK) return 1;
        std::printf("%d %.17g %.17g\n", step, rewards[0], rewards[1]);
    }
    simulator->destroy(batch);
    return 0;
}
