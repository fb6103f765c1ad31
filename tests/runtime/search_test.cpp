#include <rddl/search.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace rddl {
namespace {

template <std::size_t size>
void expect_counts() {
    std::array<double, size> table;
    std::array<std::int64_t, size> whole;
    for (std::size_t i = 0; i < size; ++i) {
        table[i] = 2.0 * static_cast<double>(i);
        whole[i] = 2 * static_cast<std::int64_t>(i);
    }
    for (std::int64_t value = -3; value <= static_cast<std::int64_t>(2 * size) + 3; ++value) {
        std::int64_t expected = 0;
        for (const std::int64_t entry : whole) expected += entry <= value ? 1 : 0;
        const auto real = static_cast<double>(value);
        EXPECT_EQ(search<std::int64_t>(table, real), expected) << size << " " << value;
        EXPECT_EQ(search<std::int64_t>(whole, value), expected) << size << " " << value;
        EXPECT_EQ(search<std::int64_t>(table, std::nextafter(real, -HUGE_VAL)),
                  value % 2 == 0 && value >= 0 && expected > 0 &&
                          value <= 2 * (static_cast<std::int64_t>(size) - 1)
                      ? expected - 1
                      : expected);
    }
    EXPECT_EQ(search<std::int64_t>(table, HUGE_VAL), static_cast<std::int64_t>(size));
    EXPECT_EQ(search<std::int64_t>(table, -HUGE_VAL), 0);
    EXPECT_EQ(search<std::int64_t>(table, std::nan("")), 0);
}

TEST(Search, CountsEntriesThatAreAtMostTheValue) {
    expect_counts<1>();
    expect_counts<2>();
    expect_counts<3>();
    expect_counts<4>();
    expect_counts<5>();
    expect_counts<7>();
    expect_counts<8>();
    expect_counts<100>();
}

}  // namespace
}  // namespace rddl
