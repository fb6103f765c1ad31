// Philox4x32-10: a keyed bijection of 128-bit counters whose values pass as random bits.
// J. Salmon, M. Moraes, R. Dror, D. Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
#pragma once

#include <array>
#include <cstdint>

namespace rddl::philox {

using Block = std::array<std::uint32_t, 4>;
using Key = std::array<std::uint32_t, 2>;

inline constexpr int rounds = 10;

constexpr std::uint32_t low_word(std::uint64_t a) {
    return static_cast<std::uint32_t>(a);
}
constexpr std::uint32_t high_word(std::uint64_t a) {
    return static_cast<std::uint32_t>(a >> 32);
}

constexpr Block one_round(const Block& counter, const Key& key) {
    const std::uint64_t first = std::uint64_t{0xD2511F53} * counter[0];
    const std::uint64_t second = std::uint64_t{0xCD9E8D57} * counter[2];
    return {high_word(second) ^ counter[1] ^ key[0], low_word(second),
            high_word(first) ^ counter[3] ^ key[1], low_word(first)};
}

// The same key and counter always give the same four words.
constexpr Block generate(Block counter, Key key) {
    for (int round = 0; round < rounds; ++round) {
        counter = one_round(counter, key);
        key = {key[0] + 0x9E3779B9u, key[1] + 0xBB67AE85u};
    }
    return counter;
}

}  // namespace rddl::philox
