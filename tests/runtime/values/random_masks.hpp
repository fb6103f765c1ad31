// Bools of 16 environments for tests of their bits.
#pragma once

#include <rddl/simulator.hpp>

#include <array>
#include <cstddef>
#include <random>

namespace rddl {

// Two rows of random masks: a half holds of the first, a third of the second.
template <std::size_t count>
struct RandomMasks {
    std::array<Mask<16>, count> some{}, others{};

    RandomMasks() {
        std::mt19937_64 random(count);
        for (std::size_t i = 0; i < count; ++i)
            for (int lane = 0; lane < 16; ++lane) {
                some[i].set(lane, random() % 2 == 0);
                others[i].set(lane, random() % 3 == 0);
            }
    }
};

}  // namespace rddl
