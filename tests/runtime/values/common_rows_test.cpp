// Rows of bools that have a true element in common: those of 16 environments and of each alone.
#include "random_masks.hpp"

#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace rddl {
namespace {

template <std::size_t count>
std::array<bool, count> of_lane(const std::array<Mask<16>, count>& masks, int lane) {
    std::array<bool, count> row{};
    for (std::size_t i = 0; i < count; ++i) row[i] = masks[i][lane];
    return row;
}

template <std::size_t count>
void expect_common_elements() {
    const RandomMasks<count> masks;
    const Mask<16> both = is_any_in_all(masks.some, masks.others);
    const Mask<16> one = is_any_in_all(masks.others);
    for (int lane = 0; lane < 16; ++lane) {
        const auto some = of_lane(masks.some, lane), others = of_lane(masks.others, lane);
        bool any_of_both = false, any_of_one = false;
        for (std::size_t i = 0; i < count; ++i) {
            any_of_both = any_of_both || (some[i] && others[i]);
            any_of_one = any_of_one || others[i];
        }
        EXPECT_EQ(both[lane], any_of_both);
        EXPECT_EQ(is_any_in_all(some, others), any_of_both);
        EXPECT_EQ(one[lane], any_of_one);
        EXPECT_EQ(is_any_in_all(others), any_of_one);
        EXPECT_EQ(is_any_in_all(some, others, some), any_of_both);
    }
}

TEST(CommonRows, HaveATrueElementInAll) {
    expect_common_elements<4>();
    expect_common_elements<6>();
    expect_common_elements<7>();
    expect_common_elements<8>();
    expect_common_elements<21>();
}

// Each element counts, and the byte behind a row does not.
TEST(CommonRows, EndWithTheirLastElement) {
    struct {
        std::array<bool, 13> row{};
        bool next = true;
    } some, others;
    EXPECT_FALSE(is_any_in_all(some.row, others.row));
    for (std::size_t i = 0; i < some.row.size(); ++i) {
        some.row[i] = true;
        EXPECT_FALSE(is_any_in_all(some.row, others.row));
        others.row[i] = true;
        EXPECT_TRUE(is_any_in_all(some.row, others.row));
        some.row[i] = others.row[i] = false;
    }
}

}  // namespace
}  // namespace rddl
