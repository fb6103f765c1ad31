// Few bools of packs as bits in narrow lanes: what 64 bits give. This file is also built for other
// instruction sets than the compiler's default (CMakeLists.txt).
#include "random_masks.hpp"

#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rddl {
namespace {

constexpr int width = 16;
using Ints = Pack<width>::Int;

template <class A, class B>
void expect_same(const A& a, const B& b) {
    for (int lane = 0; lane < width; ++lane) EXPECT_EQ(a[lane], b[lane]);
}

template <std::size_t count>
void expect_bits_of_wide_lanes() {
    const RandomMasks<count> masks;
    const auto& [some, others] = masks;
    const auto narrow = narrow_bits(some), narrow_others = narrow_action_bits(others);
    const Ints bits = rddl::bits(some), other_bits = rddl::bits(others);
    expect_same(count_ones(narrow), count_ones(bits));
    expect_same(count_ones(bit_and(narrow, narrow_others)), count_ones(bit_and(bits, other_bits)));
    expect_same(count_ones(bit_or(narrow, narrow_others)), count_ones(bit_or(bits, other_bits)));
    expect_same(count_ones(bit_xor(narrow, narrow_others)), count_ones(bit_xor(bits, other_bits)));
    expect_same(count_ones(bit_xor(-1, narrow)), count_ones(bit_xor(bits, std::int64_t{-1})));
    for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t one = std::int64_t{1} << i, rest = (std::int64_t{1} << count) - 1 - one;
        expect_same(bit_and(narrow, one) != 0, bit_and(bits, one) != Ints{0});
        expect_same(bit_and(bit_xor(narrow, -1), one) == 0, bit_and(bits, one) != Ints{0});
        expect_same(bit_or(narrow, rest) == rest, bit_and(bits, one) == Ints{0});
        expect_same(bit_xor(bit_and(narrow, rest), narrow_others) == one,
                    bit_xor(bit_and(bits, rest), other_bits) == Ints{one});
    }
}

TEST(NarrowBits, AreThoseOfWideLanes) {
    [&]<std::size_t... less>(std::index_sequence<less...>) {
        (expect_bits_of_wide_lanes<less + 1>(), ...);
    }
    (std::make_index_sequence<31>());
}

TEST(NarrowBits, OfOneEnvironmentAreAnInt) {
    const std::array<std::array<bool, 2>, 2> table = {{{true, false}, {true, true}}};
    EXPECT_EQ(narrow_bits(table), 13);
    EXPECT_EQ(narrow_action_bits(table), 13);
}

}  // namespace
}  // namespace rddl
