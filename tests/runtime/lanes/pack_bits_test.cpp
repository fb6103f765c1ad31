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

}  // namespace
}  // namespace rddl
