#include <rddl/interface/describe.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace rddl {
namespace {

template <class T>
std::vector<T> values_of(const Constants& constants, std::int64_t begin, std::int64_t count) {
    std::vector<T> values(static_cast<std::size_t>(count));
    write_constants(constants, begin, count, reinterpret_cast<std::byte*>(values.data()));
    return values;
}

TEST(Constants, OfOneValueAreThatOne) {
    EXPECT_EQ(values_of<double>(constant(3, 0.5), 1, 2), (std::vector<double>{0.5, 0.5}));
}

TEST(Constants, OfATableAreRowMajor) {
    static constexpr std::array<std::array<std::int64_t, 3>, 2> table = {{{1, 2, 3}, {4, 5, 6}}};
    EXPECT_EQ(values_of<std::int64_t>(constants(0, table), 2, 3),
              (std::vector<std::int64_t>{3, 4, 5}));
}

TEST(Constants, HaveACommonValueAndOthers) {
    static constexpr std::array<std::int64_t, 2> places = {1, 999'999'999};
    static constexpr std::array<double, 2> others = {2.5, -0.0};
    const Constants some = constants<double>(0, 7.0, places, others);
    EXPECT_EQ(values_of<double>(some, 0, 3), (std::vector<double>{7.0, 2.5, 7.0}));
    EXPECT_TRUE(std::signbit(values_of<double>(some, 999'999'999, 1)[0]));
}

TEST(Constants, OfBoolsNeedOnlyThePlacesOfOthers) {
    static constexpr std::array<std::int64_t, 2> places = {0, 3};
    EXPECT_EQ(values_of<std::uint8_t>(constants(0, true, places), 0, 4),
              (std::vector<std::uint8_t>{0, 1, 1, 0}));
}

}  // namespace
}  // namespace rddl
