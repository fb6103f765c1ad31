// Bools of packs become the bits of words and back, in each lane as scalars do. This file is also
// built for other instruction sets than the compiler's default (CMakeLists.txt).
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

namespace rddl {
namespace {

// 70 bools in each lane, as two words.
template <int width>
void expect_bits_of_scalars() {
    using Bools = typename Pack<width>::Bool;
    constexpr std::size_t rows = 7, columns = 10;
    using Table = std::array<std::array<bool, columns>, rows>;
    std::mt19937_64 random(12);
    std::array<Table, width> tables{};
    std::array<std::array<Bools, columns>, rows> packed{};
    for (int lane = 0; lane < width; ++lane)
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t c = 0; c < columns; ++c) {
                const bool value = random() % 2 == 0;
                tables[static_cast<std::size_t>(lane)][r][c] = value;
                packed[r][c].set(lane, value);
            }
    for (int lane = 0; lane < width; ++lane) {
        const Table& table = tables[static_cast<std::size_t>(lane)];
        std::uint64_t first = 0, last = 0;
        for (std::size_t i = 0; i < rows * columns; ++i)
            (i < 64 ? first : last) |= std::uint64_t{table[i / columns][i % columns]} << (i % 64);
        EXPECT_EQ(rddl::bits(table), static_cast<std::int64_t>(first));
        EXPECT_EQ(rddl::bits<64>(table), static_cast<std::int64_t>(last));
        EXPECT_EQ(rddl::bits(packed)[lane], static_cast<std::int64_t>(first));
        EXPECT_EQ(rddl::bits<64>(packed)[lane], static_cast<std::int64_t>(last));
    }
}
TEST(PackBits, AreThoseOfScalars) {
    expect_bits_of_scalars<16>();
    expect_bits_of_scalars<64>();
}

template <std::size_t count, int width>
void expect_spread_bits() {
    using Ints = typename Pack<width>::Int;
    using Bools = typename Pack<width>::Bool;
    std::mt19937_64 random(count);
    Ints bits;
    for (int lane = 0; lane < width; ++lane) bits.set(lane, static_cast<std::int64_t>(random()));
    struct {
        std::array<Bools, count> row;
        Bools behind{true};
    } bools;
    spread(bools.row, bits);
    EXPECT_TRUE(all(bools.behind));
    constexpr std::uint64_t there = ~std::uint64_t{0} >> (64 - count);
    const Ints again = rddl::bits(bools.row);
    for (int lane = 0; lane < width; ++lane) {
        const auto own = static_cast<std::uint64_t>(bits[lane]);
        for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(bools.row[i][lane], (own >> i & 1) != 0);
        EXPECT_EQ(static_cast<std::uint64_t>(again[lane]), own & there);
    }
}

TEST(PackBits, SpreadBitsOverBools) {
    expect_spread_bits<1, 16>();
    expect_spread_bits<20, 16>();
    expect_spread_bits<33, 16>();
    expect_spread_bits<64, 16>();
    expect_spread_bits<1, 64>();
    expect_spread_bits<20, 64>();
    expect_spread_bits<64, 64>();
}

template <int width>
void expect_lanes_of_masks() {
    using Bools = typename Pack<width>::Bool;
    constexpr std::uint64_t everywhere = ~std::uint64_t{0} >> (64 - width);
    for (const std::uint64_t some : {0x0000u, 0x0001u, 0x8008u, 0xA5A5u, 0xFFFFu}) {
        const std::uint64_t pattern = some & everywhere;
        const Bools mask = Bools::of_bits(pattern);
        const typename Pack<width>::Int numbers = to_int(mask);
        std::uint64_t visited = 0;
        for_each_lane(mask, [&](int lane) { visited |= std::uint64_t{1} << lane; });
        EXPECT_EQ(visited, pattern);
        EXPECT_EQ(any(mask), pattern != 0);
        EXPECT_EQ(all(mask), pattern == everywhere);
        EXPECT_EQ((!mask).bits, ~pattern & everywhere);
        EXPECT_EQ((!mask || mask).bits, Bools(true).bits);
        for (int lane = 0; lane < width; ++lane)
            EXPECT_EQ(numbers[lane], static_cast<std::int64_t>(pattern >> lane & 1));
    }
}
TEST(PackBits, CountLanesOfMasks) {
    expect_lanes_of_masks<4>();
    expect_lanes_of_masks<16>();
}

template <int width>
void expect_some_lanes_together() {
    using Bools = typename Pack<width>::Bool;
    using Reals = typename Pack<width>::Real;
    for (const std::uint64_t pattern : {0x0000u, 0x8001u, 0x0100u, 0xA5A5u, 0xFF00u, 0x00FFu}) {
        const Bools mask = Bools::of_bits(pattern) && Bools(true);
        Reals values, target{-1.0};
        for (int lane = 0; lane < width; ++lane) values.set(lane, 100 + lane);
        const Lanes<double, 8> some = compress(mask, values, 7.0);
        expand(mask, some, target);
        int next = 0;
        for_each_lane(mask, [&](int lane) { EXPECT_EQ(some[next++], 100 + lane); });
        while (next < 8) EXPECT_EQ(some[next++], 7.0);
        for (int lane = 0; lane < width; ++lane)
            EXPECT_EQ(target[lane], mask[lane] ? 100 + lane : -1.0);
    }
}
TEST(PackBits, BringSomeLanesTogetherAndBack) {
    expect_some_lanes_together<4>();
    expect_some_lanes_together<16>();
}

}  // namespace
}  // namespace rddl
