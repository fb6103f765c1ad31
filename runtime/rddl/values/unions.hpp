// Unions of masks that bits choose: the bits that one mask at least has, of those in a row of a
// constant table. Bit i chooses element i; the row may differ between lanes.
#pragma once

#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/ops.hpp>
#include <rddl/values/pack_ops.hpp>
#include <rddl/values/tables.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace rddl {

namespace detail {

// Rows whose masks move bits: those of `moved` by the same distance, round the ends of a word, and
// those of `kept` not at all. Such are the steps of a grid, apart from those that its ends stop.
template <std::size_t rows>
struct BitMoves {
    std::array<std::int64_t, rows> moved{}, kept{}, distance{};
    bool are_all = true;  // whether no mask of any row does anything else
};
template <class Masks>
consteval BitMoves<1> bit_moves_of(const Masks&) {
    return {.are_all = false};
}
template <std::size_t rows, std::size_t count>
consteval BitMoves<rows> bit_moves_of(
    const std::array<std::array<std::int64_t, count>, rows>& masks) {
    BitMoves<rows> moves;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t i = 0; i < count; ++i) {
            const auto mask = static_cast<std::uint64_t>(masks[row][i]);
            const std::uint64_t bit = std::uint64_t{1} << i;
            const auto distance = static_cast<std::int64_t>((64 + std::countr_zero(mask) - i) % 64);
            if (mask == 0) continue;
            if (mask == bit) {
                moves.kept[row] |= static_cast<std::int64_t>(bit);
                continue;
            }
            const bool is_first = moves.moved[row] == 0;
            moves.are_all = moves.are_all && std::has_single_bit(mask) &&
                            (is_first || moves.distance[row] == distance);
            moves.moved[row] |= static_cast<std::int64_t>(bit);
            moves.distance[row] = distance;
        }
    return moves;
}
template <const auto& masks>
inline constexpr auto bit_moves = bit_moves_of(masks);

RDDL_INLINE std::int64_t rotated(std::int64_t bits, std::int64_t distance) {
    return static_cast<std::int64_t>(
        std::rotl(static_cast<std::uint64_t>(bits), static_cast<int>(distance)));
}
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> rotated(const Lanes<std::int64_t, n>& bits,
                                           const Lanes<std::int64_t, n>& distance) {
    return Lanes<std::int64_t, n>::each([](auto x, auto by)
                                            RDDL_INLINE_LAMBDA { return simd::rotate_left(x, by); },
                                        bits, distance);
}

template <class Masks, class... Row>
RDDL_INLINE std::int64_t union_one_by_one(const Masks& masks, std::int64_t bits, Row... row) {
    std::int64_t all = 0;
    for (auto left = static_cast<std::uint64_t>(bits); left != 0; left &= left - 1)
        all |= at(masks, row..., Index{__builtin_ctzll(left)});
    return all;
}
template <class Masks, int n, class... Row>
RDDL_INLINE Lanes<std::int64_t, n> union_one_by_one(const Masks& masks, Lanes<std::int64_t, n> bits,
                                                    const Row&... row) {
    using Int = Lanes<std::int64_t, n>;
    Int all{0};
    for (Mask<n> some = bits != 0; any(some); some = bits != 0) {
        const Int others = bits & wrap_sub(bits, Int{1});
        const Int place = count_ones(wrap_sub(bits ^ others, Int{1}));
        const Int mask = at(masks, row..., select(some, place, Int{0}));
        all = all | select(some, mask, Int{0});
        bits = others;
    }
    return all;
}

}  // namespace detail

template <const auto& masks, class Bits, class... Row>
RDDL_INLINE Bits union_of(const Bits& bits, const Row&... row) {
    constexpr const auto& moves = detail::bit_moves<masks>;
    if constexpr (moves.are_all) {
        const Bits moved = bit_and(bits, at(moves.moved, row...));
        const Bits kept = bit_and(bits, at(moves.kept, row...));
        return bit_or(detail::rotated(moved, Bits(at(moves.distance, row...))), kept);
    } else {
        return detail::union_one_by_one(masks, bits, row...);
    }
}

}  // namespace rddl
