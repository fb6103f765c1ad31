#include <rddl/values/moderate.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace rddl {
namespace {

template <class R>
struct OfOne {
    static constexpr int width = 1;
    using Real = R;
    using Bool = bool;
};

template <class R>
constexpr R limit = static_cast<R>(moderate);
template <class R>
const std::array<R, 5> not_moderate = {
    std::nextafter(limit<R>, R(2) * limit<R>), -std::nextafter(limit<R>, R(2) * limit<R>),
    std::numeric_limits<R>::infinity(), -std::numeric_limits<R>::infinity(),
    std::numeric_limits<R>::quiet_NaN()};

// Rows of three, so that registers begin inside of rows.
template <class R, std::size_t rows>
void expect_each_element_counts() {
    std::array<std::array<R, 3>, rows> table{};
    for (auto& row : table) row = {limit<R>, -limit<R>, R(-0.0)};
    EXPECT_TRUE((is_moderate<OfOne<R>>(table))) << rows;
    for (auto& row : table)
        for (R& element : row)
            for (const R value : not_moderate<R>) {
                const R before = std::exchange(element, value);
                EXPECT_FALSE((is_moderate<OfOne<R>>(table))) << rows << ' ' << value;
                element = before;
            }
}
template <class R, std::size_t... rows>
void expect_all_sizes(std::index_sequence<rows...>) {
    (expect_each_element_counts<R, rows + 1>(), ...);
}

TEST(ModerateTables, HaveNoElementThatIsNot) {
    expect_all_sizes<double>(std::make_index_sequence<24>());
    expect_all_sizes<float>(std::make_index_sequence<48>());
}

TEST(ModerateTables, AreFoundLaneByLane) {
    using Real = Lanes<double, 16>;
    std::array<std::array<Real, 3>, 2> table{};
    table[1][0].set(3, 2 * moderate);
    table[0][2].set(9, std::numeric_limits<double>::quiet_NaN());
    table[1][2].set(15, -moderate);
    EXPECT_EQ((is_moderate<Pack<16>>(table)).bits, 0xffffU & ~(1U << 3 | 1U << 9));
}

TEST(ModerateReals, HaveMagnitudesUpToTheLimit) {
    EXPECT_TRUE(is_moderate<OfOne<double>>(-moderate));
    for (const double value : not_moderate<double>)
        EXPECT_FALSE(is_moderate<OfOne<double>>(value)) << value;
}

}  // namespace
}  // namespace rddl
