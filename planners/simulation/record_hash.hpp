// Keys of records of bytes.
#pragma once

#include "planners/simulation/random_stream.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddlc::planners {

// Both halves of a product in one: each bit depends on all of theirs, as in the hash function
// wyhash (Wang Yi, 2019).
inline std::uint64_t folded_product(std::uint64_t a, std::uint64_t b) {
    __extension__ using Wide = unsigned __int128;
    const Wide product = Wide{a} * b;
    return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
}

// Two records of 10^6 have the same key with a chance of 10^-7; such are taken for one.
inline std::uint64_t hash_of(const std::byte* record, std::size_t size, std::uint64_t start = 0) {
    constexpr std::uint64_t factor = 0x9E3779B97F4A7C15u;
    std::uint64_t key = scrambled(start + 1), word = 0;
    std::size_t b = 0;
    for (; b + 8 < size; b += 8) {
        std::memcpy(&word, record + b, 8);
        key = folded_product(key ^ word, factor) + factor;
    }
    // The last word may have bytes of the one before it.
    if (size >= 8)
        std::memcpy(&word, record + size - 8, 8);
    else if (size > 0)  // else there may be no record
        std::memcpy(&word, record, size);
    return scrambled(key ^ word);
}

}  // namespace rddlc::planners
