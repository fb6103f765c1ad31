// Where futures begin.
#pragma once

#include "planners/simulation/random_stream.hpp"

#include <rddl/simulator.h>

#include <cstdint>

namespace rddlc::planners {

// Environments [first, first + count) of a batch: one whose state is known, or particles, each of
// which may be the state.
struct Origin {
    const rddl_batch* batch;
    std::int64_t first;
    std::int64_t count = 1;

    // Futures of the same stream begin in the same environment.
    std::int64_t place(std::uint64_t stream) const {
        constexpr std::uint64_t mark = 0x7061727469636C65u;
        if (count == 1) return first;
        const std::uint64_t bits = scrambled(stream ^ mark) >> 32;
        return first + static_cast<std::int64_t>((bits * static_cast<std::uint64_t>(count)) >> 32);
    }
};

}  // namespace rddlc::planners
