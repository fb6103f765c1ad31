// The functions that main.cpp calls in the shared object of a kernel.
#pragma once

#include <cstddef>
#include <cstdint>

namespace least_steps {

inline constexpr int width = 16;  // environments of a pack

// Environments before a step: their records, as callers of a simulator have them, one after the
// other, and the coordinates of their random numbers (docs/randomness.md).
struct Environments {
    std::size_t count;  // a multiple of `width`
    std::size_t state_size, action_size;
    const std::byte* states;
    const std::byte* actions;
    const std::uint64_t* steps;
    const std::uint64_t* keys_low;
    const std::uint64_t* keys_high;
};

struct Kernel {
    // Makes one step: the next state records and the rewards.
    void (*step)(const Environments&, std::byte* next_states, double* rewards);
    // The nanoseconds that a step takes for one environment, the least of many rounds in that time.
    double (*nanoseconds)(const Environments&, double seconds);
};

}  // namespace least_steps
