// Philox4x32: a keyed bijection of 128-bit counters whose values pass as random bits.
// J. Salmon, M. Moraes, R. Dror, D. Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
//
// Written once for uint64_t and for packs of them (pack.hpp). A word of Philox is the lower half of
// such a number; whatever stands in its upper half is ignored.
#pragma once

#include <rddl/pack.hpp>

#include <array>
#include <cstdint>

namespace rddl::philox {

template <class Word>
using Block = std::array<Word, 4>;
template <class Word>
using Key = std::array<Word, 2>;

// Philox passes BigCrush from 7 rounds on; 10 are its authors' margin (section 4 and table 2).
inline constexpr int draw_rounds = 7;
inline constexpr int key_rounds = 10;

constexpr std::uint64_t multiply_low_halves(std::uint64_t a, std::uint64_t b) {
    return (a & 0xFFFFFFFF) * (b & 0xFFFFFFFF);
}

constexpr std::uint64_t upper_halves(std::uint64_t a) {
    return a >> 32;
}

template <class Word>
RDDL_INLINE Block<Word> one_round(const Block<Word>& counter, const Key<Word>& key) {
    const Word first = multiply_low_halves(counter[0], Word{std::uint64_t{0xD2511F53}});
    const Word second = multiply_low_halves(counter[2], Word{std::uint64_t{0xCD9E8D57}});
    return {upper_halves(second) ^ counter[1] ^ key[0], second,
            upper_halves(first) ^ counter[3] ^ key[1], first};
}

// The same key and counter always give the same four words.
template <int rounds, class Word>
RDDL_INLINE Block<Word> generate(Block<Word> counter, Key<Word> key) {
    for (int round = 0; round < rounds; ++round) {
        counter = one_round(counter, key);
        key = {key[0] + Word{std::uint64_t{0x9E3779B9}}, key[1] + Word{std::uint64_t{0xBB67AE85}}};
    }
    return counter;
}

}  // namespace rddl::philox
