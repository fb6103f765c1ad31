// Several objects of one environment take from their rows what one object after the other takes,
// whether that is looked up or computed. Also built for other instruction sets (CMakeLists.txt).
#include <rddl/object_lanes/rows.hpp>
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl {
namespace {

// The number is not a multiple of the lanes.
constexpr std::size_t height = 7, width = 5, objects = height * width, cases = 4;

template <class R>
using Rows = std::array<std::array<R, cases>, 3>;

constexpr Rows<double> lines = {{{0.25, 0.5, 0.75, 1}, {0.1, 0.4, 0.4, 0.4}, {-2, -2, -2, -2}}};
constexpr Rows<double> curves = {{{0, 1, 4, 9}, {1, 0.5, 0.25, 0.125}, {-2, -2, -2, -2}}};
// Rounding puts some of these elements above and some below the line, also beyond zero.
constexpr Rows<double> nearly_lines = {
    {{0.1, 0.2, 0.3, 0.4}, {-0.4, -0.3, -0.2, -0.1}, {0.55, 0.65, 0.75, 0.8500000000000001}}};
// One element is too far from its line, and one has another sign.
constexpr Rows<double> hardly_lines = {{{0.1, 0.2, 0.3000000000001, 0.4}, {0, 1, 2, 3}, {}}};
constexpr Rows<double> signs = {{{0, 0, -0.0, 0}, {0, 1, 2, 3}, {0, 1, 2, 3}}};
// The bits of an element and of the line differ by more than an int has.
constexpr Rows<double> apart = {{{0, 1, -1, 3}, {0, 1, 2, 3}, {0, 1, 2, 3}}};
static_assert(!detail::are_nearly_lines<apart>);
// Differences of these overflow, or are nan.
constexpr double greatest = std::numeric_limits<double>::max();
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Rows<double> extreme = {{{-greatest, greatest, greatest, greatest},
                                   {infinite, infinite, infinite, infinite},
                                   {1, greatest, infinite, infinite}}};
constexpr Rows<float> float_lines = {{{0.25, 0.5, 0.75, 1}, {0.5, 2, 2, 2}, {0, 0, 0, 0}}};
constexpr Rows<float> nearly_float_lines = {
    {{0.1f, 0.2f, 0.3f, 0.4f}, {-0.4f, -0.3f, -0.2f, -0.1f}, {0.45f, 0.5875f, 0.725f, 0.8625f}}};
static_assert(!detail::are_lines<nearly_float_lines> &&
              detail::are_nearly_lines<nearly_float_lines>);
static_assert(detail::are_lines<lines> && detail::are_lines<float_lines>);
static_assert(!detail::are_lines<nearly_lines> && detail::are_nearly_lines<nearly_lines>);
static_assert(!detail::are_nearly_lines<curves> && !detail::are_nearly_lines<extreme> &&
              !detail::are_nearly_lines<hardly_lines> && !detail::are_nearly_lines<signs>);

// As many elements as a word can have differences of, and more.
template <std::size_t size>
constexpr auto thirds = [] {
    std::array<std::array<double, size>, 1> rows{};
    for (std::size_t count = 0; count < size; ++count)
        rows[0][count] = static_cast<double>(count + 1) / 3;
    return rows;
}();
static_assert(!detail::are_lines<thirds<32>> && detail::are_nearly_lines<thirds<8>> &&
              detail::Differences<32>::bits == 2 && !detail::are_nearly_lines<thirds<33>>);

constexpr auto kinds = [] {
    std::array<std::array<std::int64_t, width>, height> table{};
    for (std::size_t x = 0; x < objects; ++x)
        table[x / width][x % width] = static_cast<std::int64_t>((5 * x + 2) % 3);
    return table;
}();

constexpr std::array<std::array<std::int64_t, width>, height> zeros{};

template <class R>
constexpr auto rows_of_objects = [] {
    std::array<std::array<R, cases>, objects> table{};
    for (std::size_t x = 0; x < objects; ++x)
        for (std::size_t count = 0; count < cases; ++count)
            table[x][count] = static_cast<R>(x) + static_cast<R>(0.5) * static_cast<R>(count);
    return table;
}();
constexpr auto rows = rows_of_objects<double>;
static_assert(detail::are_lines<rows>);

std::array<std::int64_t, objects> some_counts() {
    std::array<std::int64_t, objects> counts{};
    for (std::size_t x = 0; x < objects; ++x) counts[x] = static_cast<std::int64_t>(x * 7 % cases);
    return counts;
}

// `take(x, count)` of all objects at once, or one after the other.
template <class R, class Take>
std::array<R, objects> taken(const Take& take) {
    const auto counts = some_counts();
    Context<ScalarOf<R>> context{stream_key(1, 2, 3), 1, {}};
    std::array<R, objects> values{};
    for_each_object<objects>(context,
                             [&](auto&, auto x) { elements(values, x) = take(x, at(counts, x)); });
    return values;
}

template <const auto& table, class R>
void expect_rows_of_kinds() {
    const auto values =
        taken<R>([](auto x, const auto& count) { return at_row<table, kinds>(x, count); });
    for (std::size_t x = 0; x < objects; ++x) {
        const auto kind = static_cast<std::size_t>(kinds[x / width][x % width]);
        EXPECT_EQ(bits_of(values[x]),
                  bits_of(table[kind][static_cast<std::size_t>(some_counts()[x])]));
    }
}

TEST(Rows, AreThoseOfKinds) {
    expect_rows_of_kinds<lines, double>();
    expect_rows_of_kinds<curves, double>();
    expect_rows_of_kinds<nearly_lines, double>();
    expect_rows_of_kinds<hardly_lines, double>();
    expect_rows_of_kinds<signs, double>();
    expect_rows_of_kinds<extreme, double>();
    expect_rows_of_kinds<float_lines, float>();
    expect_rows_of_kinds<nearly_float_lines, float>();
}

TEST(Rows, AreThoseOfObjects) {
    const auto values =
        taken<double>([](auto x, const auto& count) { return at_row<rows>(x, count); });
    for (std::size_t x = 0; x < objects; ++x)
        EXPECT_EQ(values[x], rows[x][static_cast<std::size_t>(some_counts()[x])]);
}

template <std::size_t size>
void expect_thirds() {
    for (std::size_t count = 0; count < size; ++count) {
        const auto values = taken<double>([&](auto x, const auto&) {
            return at_row<thirds<size>, zeros>(x, static_cast<std::int64_t>(count));
        });
        EXPECT_EQ(values[objects - 1], thirds<size>[0][count]);
    }
}
TEST(Rows, HaveAsManyElementsAsAWordHasDifferences) {
    expect_thirds<8>();
    expect_thirds<20>();
    expect_thirds<32>();
    expect_thirds<33>();
}

TEST(Rows, TakeOneCountForAll) {
    const auto values =
        taken<double>([](auto x, const auto&) { return at_row<lines, kinds>(x, std::int64_t{2}); });
    for (std::size_t x = 0; x < objects; ++x)
        EXPECT_EQ(values[x], lines[static_cast<std::size_t>(kinds[x / width][x % width])][2]);
}

}  // namespace
}  // namespace rddl
