// Tests and counts of few bits in packs: those of ints. This file is also built for other
// instruction sets than the compiler's default (CMakeLists.txt).
#include "random_masks.hpp"

#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace rddl {
namespace {

constexpr int width = 16;
using Bools = Pack<width>::Bool;

// Elements of up to four ones, two at least, and of more.
constexpr std::array<std::array<std::int64_t, 3>, 2> few = {{{0, 1, 0x802}, {0x70, 0xf00, 0x208}}};
constexpr std::array<std::int64_t, 3> two_at_least = {0x003, 0x70, 0x0e1};
constexpr std::array<std::int64_t, 2> more = {0x7f, 0xfe0};

template <const auto& table, class Narrow, class Wide, class... Row>
void expect_those_of_ints(const Narrow& narrow, const Wide& wide, const Row&... row) {
    const auto ones = count_ones(bit_and(wide, at(table, row...)));
    const Bools any = has_any_of<table>(narrow, row...);
    for (std::int64_t count = -1; count <= 8; ++count) {
        const Bools is_count = count_of<table>(narrow, row...) == count;
        const Bools is_other = count_of<table>(narrow, row...) != count;
        for (int lane = 0; lane < width; ++lane) {
            EXPECT_EQ(is_count[lane], ones[lane] == count);
            EXPECT_EQ(is_other[lane], ones[lane] != count);
            EXPECT_EQ(any[lane], ones[lane] != 0);
        }
    }
}

template <class Narrow, class Wide>
void expect_those_of_ints_in_tables(const Narrow& narrow, const Wide& wide) {
    for (Index i = 0; i < 2; ++i) {
        for (Index j = 0; j < 3; ++j) expect_those_of_ints<few>(narrow, wide, i, j);
        expect_those_of_ints<more>(narrow, wide, i);
    }
    for (Index i = 0; i < 3; ++i) expect_those_of_ints<two_at_least>(narrow, wide, i);
    Context<Pack<width>> context;
    for_few_objects<6>(
        context, [&](auto&, auto object) { expect_those_of_ints<few>(narrow, wide, object); });
}

template <std::size_t count>
void expect_bits_of_ints() {
    const RandomMasks<count> masks;
    const auto& [some, others] = masks;
    const auto a = narrow_bits(some), b = narrow_action_bits(others);
    const auto c = bits(some), d = bits(others);
    const std::int64_t all = -1;
    expect_those_of_ints_in_tables(a, c);
    expect_those_of_ints_in_tables(bit_and(a, b), bit_and(c, d));
    expect_those_of_ints_in_tables(bit_or(a, b), bit_or(c, d));
    expect_those_of_ints_in_tables(bit_xor(a, b), bit_xor(c, d));
    expect_those_of_ints_in_tables(bit_and(a, bit_xor(b, all)), bit_and(c, bit_xor(d, all)));
    expect_those_of_ints_in_tables(bit_or(0x505, b), bit_or(std::int64_t{0x505}, d));
    expect_those_of_ints_in_tables(bit_and(0x505, b), bit_and(std::int64_t{0x505}, d));
}

TEST(FewBits, AreThoseOfInts) {
    expect_bits_of_ints<12>();
    expect_bits_of_ints<20>();
}

TEST(FewBits, OfOneEnvironmentAreOfAnInt) {
    EXPECT_TRUE((has_any_of<few>(std::int64_t{0x800}, Index{0}, Index{2})));
    EXPECT_FALSE((has_any_of<few>(std::int64_t{0x7fd}, Index{0}, Index{2})));
    EXPECT_EQ(count_of<more>(std::int64_t{0x7c}, Index{1}), 2);
}

}  // namespace
}  // namespace rddl
