// Tables of bools as the bits of words, and Bernoulli draws for all bits of a word: for one
// environment, and for several in registers.
#pragma once

#include "reference.hpp"
#include "registers.hpp"

#include <array>
#include <cstring>

namespace handwritten {

constexpr std::uint64_t first_bits(std::size_t count) {
    return count == 0 ? 0 : ~std::uint64_t{0} >> (64 - count);
}

// ------------------------------------------------------------------------------- the caller's

// A word of each record: read(record) for one environment, the same of each in registers.
template <class Read>
void load_words(std::uint64_t& words, const std::byte* record, std::size_t, const Read& read) {
    words = read(record);
}
template <int n, class Read>
void load_words(rddl::Lanes<std::uint64_t, n>& words, const std::byte* records,
                std::size_t record_size, const Read& read) {
    std::uint64_t each[n];
    for (std::size_t lane = 0; lane < n; ++lane) each[lane] = read(records + lane * record_size);
    words = rddl::Lanes<std::uint64_t, n>::load(each);
}

// Four bools that make up a record, each as a word whose bits are all the same.
template <class Word>
struct FourBools {
    Word first, second, third, fourth;
};
template <class Word>
void load_four_bools(FourBools<Word>& bools, const std::byte* records) {
    Word bytes;
    load_words(bytes, records, 4, [](const std::byte* record) {
        std::uint32_t four;
        std::memcpy(&four, record, sizeof four);
        return std::uint64_t{four};
    });
    const auto spread = [&](int byte) {
        return Word{std::uint64_t{0}} - (bytes >> 8 * byte & std::uint64_t{1});
    };
    bools = {spread(0), spread(1), spread(2), spread(3)};
}

// --------------------------------------------------------------------------------------- bits

inline bool is_zero(std::uint64_t a) {
    return a == 0;
}
template <int n>
rddl::Mask<n> is_zero(const rddl::Lanes<std::uint64_t, n>& a) {
    return rddl::ints_of(a) == std::int64_t{0};
}
inline std::uint64_t if_zero(std::uint64_t a, std::uint64_t yes, std::uint64_t no) {
    return a == 0 ? yes : no;
}
template <int n>
rddl::Lanes<std::uint64_t, n> if_zero(const rddl::Lanes<std::uint64_t, n>& a,
                                      const rddl::Lanes<std::uint64_t, n>& yes,
                                      const rddl::Lanes<std::uint64_t, n>& no) {
    return select(is_zero(a), yes, no);
}

// Calls body(k) for each bit k that is set.
template <class Body>
void for_each_bit(std::uint64_t bits, Body&& body) {
    for (; bits != 0; bits &= bits - 1) body(static_cast<std::size_t>(__builtin_ctzll(bits)));
}

// -------------------------------------------------------------------------------------- draws

// So many of the integers below 2^52, each times 2^-52, are less than the probability.
constexpr std::uint64_t threshold(double probability) {
    if (probability <= 0) return 0;
    if (probability >= 1) return std::uint64_t{1} << 52;
    const double scaled = probability * 0x1p52;
    const auto rounded = static_cast<std::uint64_t>(scaled);
    return rounded + (static_cast<double>(rounded) < scaled);
}

inline bool is_below(std::uint64_t number, std::uint64_t limit) {
    return number < limit;
}
template <int n>
rddl::Mask<n> is_below(const rddl::Lanes<std::uint64_t, n>& number,
                       const rddl::Lanes<std::uint64_t, n>& limit) {
    return rddl::ints_of(number) < rddl::ints_of(limit);
}

// One draw of one environment.
inline std::uint64_t integer_at(const Draws<std::uint64_t>& draws, std::uint64_t site,
                                std::size_t index) {
    const auto two = draws.two_integers(site, index / 2);
    return index % 2 == 0 ? two.even : two.odd;
}

// The thresholds of at most 64 objects; those with even numbers apart from the others, since one
// counter value serves two neighbours.
struct Thresholds {
    static constexpr std::size_t half = 32;
    std::array<std::uint64_t, 2 * half> of{};

    template <std::size_t count>
    static constexpr Thresholds of_chances(const double (&chances)[count]) {
        static_assert(count <= 2 * half);
        Thresholds all;
        for (std::size_t k = 0; k < count; ++k)
            all.of[k / 2 + k % 2 * half] = threshold(chances[k]);
        return all;
    }
    static constexpr Thresholds equal(double chance) {
        Thresholds all;
        all.of.fill(threshold(chance));
        return all;
    }
    constexpr std::uint64_t operator[](std::size_t object) const {
        return of[object / 2 + object % 2 * half];
    }
};

// For each table of thresholds a word, whose bit k says whether number k of the site is below the
// threshold. Only bits that are wanted need be right. Registers over the objects.
template <std::size_t count, class... Tables>
std::array<std::uint64_t, sizeof...(Tables)> draw_bits(const Draws<std::uint64_t>& draws,
                                                       std::uint64_t site, std::uint64_t wanted,
                                                       const Tables&... tables) {
    constexpr int n = lanes_in_one;
    using Word = rddl::Lanes<std::uint64_t, n>;
    const Draws<Word> many{Word{draws.step}, {Word{draws.key[0]}, Word{draws.key[1]}}};
    std::array<std::uint64_t, sizeof...(Tables)> halves{};
    for (std::size_t first = 0; 2 * first < count; first += n) {
        if ((wanted >> 2 * first & first_bits(2 * n)) == 0) continue;
        const auto numbers = many.two_integers(Word{site}, counting_from<n>(first));
        std::size_t at = 0;
        const auto compare = [&](const Thresholds& table) {
            const auto even = is_below(numbers.even, Word::load(&table.of[first]));
            const auto odd = is_below(numbers.odd, Word::load(&table.of[first + table.half]));
            halves[at++] |= std::uint64_t{even.bits} << first | std::uint64_t{odd.bits}
                                                                    << (first + table.half);
        };
        (compare(tables), ...);
    }
    for (std::uint64_t& bits : halves) bits = joined_halves(bits);
    return halves;
}
// Registers over environments.
template <std::size_t count, int n, class... Tables>
std::array<rddl::Lanes<std::uint64_t, n>, sizeof...(Tables)> draw_bits(
    const Draws<rddl::Lanes<std::uint64_t, n>>& draws, std::uint64_t site,
    const rddl::Lanes<std::uint64_t, n>& wanted, const Tables&... tables) {
    using Word = rddl::Lanes<std::uint64_t, n>;
    std::array<Word, sizeof...(Tables)> bits;
    bits.fill(Word{std::uint64_t{0}});
    for (std::uint64_t k = 0; k < count; k += 2) {
        if (all(is_zero(wanted & (std::uint64_t{3} << k)))) continue;
        const auto numbers = draws.two_integers(Word{site}, Word{k / 2});
        std::size_t at = 0;
        const auto compare = [&](const Thresholds& table) {
            const auto bit = [&](const Word& number, std::uint64_t object) {
                return select(is_below(number, Word{table[object]}),
                              Word{std::uint64_t{1} << object}, Word{std::uint64_t{0}});
            };
            bits[at] = bits[at] | bit(numbers.even, k) | bit(numbers.odd, k + 1);
            ++at;
        };
        (compare(tables), ...);
    }
    return bits;
}

}  // namespace handwritten
