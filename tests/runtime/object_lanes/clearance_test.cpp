#include <rddl/object_lanes/clearance.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace rddl {
namespace {

constexpr Index count = 11;
template <class R>
constexpr Grid<2, R> grid{{-1, 2}, {4, 2}, R{0.125}, static_cast<R>(0.01)};

// Cell (i, j) has clearance i + j, in units of the grid.
constexpr auto steps = [] {
    std::array<std::array<std::uint8_t, 8>, 8> table{};
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < 8; ++j) table[i][j] = static_cast<std::uint8_t>(i + j);
    return table;
}();
template <class R>
constexpr std::array<R, count> levels = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};

// True of the last object alone, wherever it is looked at.
constexpr auto is_last = [](auto&, auto object, const auto&, const auto&, const auto& move) {
    using R = std::remove_cvref_t<decltype(move)>;
    return move < R{0.5} && at(levels<R>, object) > R{9.5};
};

template <class R>
bool exists(R x, R y, R move) {
    Context<ScalarOf<R>> context{};
    return exists_near_object<count, steps>(context, grid<R>, std::array{x, y}, std::array{move},
                                            is_last);
}

TEST(Clearance, LooksAtObjectsWhereAMoveIsTooLong) {
    EXPECT_TRUE(exists(-0.9, 2.1, 0.02));  // cell (0, 0) has no clearance
    EXPECT_FALSE(exists(-0.4, 2.1, 0.2));  // (2, 0): up to 0.25
    EXPECT_FALSE(exists(-0.4, 2.1, -0.2));
    EXPECT_TRUE(exists(-0.4, 2.1, 0.25));
    EXPECT_TRUE(exists(-0.4, 2.1, 0.009));  // too near to 0
    EXPECT_FALSE(exists(0.9, 5.9, 0.6));    // the last cell
    for (const auto& [x, y] : {std::array{-1.01, 3.0}, {1.0, 3.0}, {0.0, 1.9}, {0.0, 6.0}})
        EXPECT_TRUE(exists(x, y, 0.02)) << x << ' ' << y;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(exists(nan, 3.0, 0.02));
    EXPECT_FALSE(exists(0.0, 3.0, nan));  // it looks, and nan is not below 0.5
}

// Each lane has the bool that it has alone.
template <class R>
void compare_lanes() {
    using Reals = Lanes<R, 16>;
    using Packs = Pack<16, R>;
    using Word = typename Packs::Word;
    auto packs = Context<Packs>::of(Word{7}, Word{9}, Word{1}, true);
    for (int offset = 0; offset < 50; ++offset) {
        R x[16], y[16], move[16];
        for (int k = 0; k < 16; ++k) {
            x[k] = static_cast<R>(-1.2 + 0.01 * (k * 17 + offset));
            y[k] = static_cast<R>(1.9 + 0.05 * (k * 7 % 16) * offset / 10);
            move[k] = static_cast<R>(0.04 * (offset % 20) - 0.01 * k);
        }
        const Mask<16> found = exists_near_object<count, steps>(
            packs, grid<R>, std::array{Reals::load(x), Reals::load(y)},
            std::array{Reals::load(move)}, is_last);
        for (int k = 0; k < 16; ++k)
            EXPECT_EQ((found.bits >> k & 1) != 0, exists(x[k], y[k], move[k]))
                << x[k] << ' ' << y[k] << ' ' << move[k];
    }
}
TEST(Clearance, LooksAtTheLanesThatAreNear) {
    compare_lanes<double>();
    compare_lanes<float>();
}

}  // namespace
}  // namespace rddl
