// Unions of masks that bits choose, in one environment and in packs. Also built for other
// instruction sets (CMakeLists.txt).
#include <rddl/simulator.hpp>
#include <rddl/values/unions.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace rddl {
namespace {

constexpr int width = 16;

template <std::size_t n>
using Masks = std::array<std::array<std::int64_t, n>, 3>;

template <std::size_t n>
constexpr Masks<n> any_masks = [] {
    Masks<n> masks{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t i = 0; i < n; ++i)
            masks[row][i] = static_cast<std::int64_t>((0x9E3779B97F4A7C15 * (row * n + i + 1) ^ i) &
                                                      ~std::uint64_t{0} >> (64 - n));
    return masks;
}();
// Each row moves by another distance, round the ends, and some of its bits stay or have no mask.
template <std::size_t n>
constexpr Masks<n> moves = [] {
    Masks<n> masks{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t place = i % 3 == 1 ? i : (i + 63 * row) % 64;
            const bool is_there = i % 5 != 4 && place < n;
            masks[row][i] = is_there ? static_cast<std::int64_t>(std::uint64_t{1} << place) : 0;
        }
    return masks;
}();
static_assert(!detail::bit_moves<any_masks<16>>.are_all && detail::bit_moves<moves<16>>.are_all &&
              detail::bit_moves<moves<64>>.are_all);

// Bit i chooses mask i of the row; the elements of a table take the bits of the union.
template <std::size_t n, const Masks<n>& masks>
void expect_unions() {
    Lanes<std::int64_t, width> all_bits, rows;
    std::array<std::int64_t, width> expected{};
    for (int lane = 0; lane < width; ++lane) {
        const std::uint64_t bits = (std::uint64_t{1} << (lane * 5) % n) |
                                   (lane % 3 == 2 ? std::uint64_t{1} << (n - 1) : 0);
        all_bits.set(lane, lane == 7 ? 0 : static_cast<std::int64_t>(bits));
        rows.set(lane, lane % 3);
        for (std::size_t i = 0; i < n; ++i)
            if (lane != 7 && (bits >> i & 1) != 0)
                expected[static_cast<std::size_t>(lane)] |=
                    masks[static_cast<std::size_t>(lane % 3)][i];
    }
    const auto unions = union_of<masks>(all_bits, rows);
    const auto of_row_1 = union_of<masks>(all_bits, Index{1});
    std::array<std::array<Mask<width>, n / 2>, 2> of_masks;
    spread(of_masks, unions);
    for (int lane = 0; lane < width; ++lane) {
        const std::int64_t bits = union_of<masks>(get_lane(all_bits, lane), Index{lane % 3});
        EXPECT_EQ(bits, expected[static_cast<std::size_t>(lane)]);
        EXPECT_EQ(get_lane(unions, lane), bits);
        EXPECT_EQ(get_lane(of_row_1, lane), union_of<masks>(get_lane(all_bits, lane), Index{1}));
        std::array<std::array<bool, n / 2>, 2> of_one;
        spread(of_one, bits);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(of_one[i / (n / 2)][i % (n / 2)], (bits >> i & 1) != 0);
            EXPECT_EQ(of_masks[i / (n / 2)][i % (n / 2)][lane], (bits >> i & 1) != 0);
        }
    }
}

TEST(UnionOf, JoinsTheMasksThatBitsChoose) {
    expect_unions<2, any_masks<2>>();
    expect_unions<8, any_masks<8>>();
    expect_unions<16, any_masks<16>>();
    expect_unions<34, any_masks<34>>();
    expect_unions<64, any_masks<64>>();
}

TEST(UnionOf, MovesBitsWhereAllMasksDo) {
    expect_unions<2, moves<2>>();
    expect_unions<16, moves<16>>();
    expect_unions<34, moves<34>>();
    expect_unions<64, moves<64>>();
}

}  // namespace
}  // namespace rddl
