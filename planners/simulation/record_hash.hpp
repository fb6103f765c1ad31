// Keys of records of bytes.
#pragma once

#include "planners/simulation/random_stream.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddlc::planners {

// Two records of 10^6 have the same key with a chance of 10^-7; such are taken for one.
inline std::uint64_t hash_of(const std::byte* record, std::size_t size, std::uint64_t start = 0) {
    std::uint64_t key = scrambled(start + 1);
    std::size_t b = 0;
    for (; b + 8 <= size; b += 8) {
        std::uint64_t word;
        std::memcpy(&word, record + b, 8);
        key = scrambled(key ^ word) + 0x9E3779B97F4A7C15u;
    }
    std::uint64_t rest = 0;
    if (b < size) std::memcpy(&rest, record + b, size - b);
    return scrambled(key ^ rest);
}

}  // namespace rddlc::planners
