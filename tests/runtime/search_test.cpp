#include <rddl/pack.hpp>
#include <rddl/pack_ops.hpp>
#include <rddl/search.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace rddl {
namespace {

// Twice the places, so that there is a value between two of them.
template <class Entry, std::size_t size>
constexpr std::array<Entry, size> even = [] {
    std::array<Entry, size> table{};
    for (std::size_t i = 0; i < size; ++i) table[i] = static_cast<Entry>(2 * i);
    return table;
}();

constexpr std::array<double, 5> uneven = {-7.5, 0.0, 0.25, 3.0, 1e9};
// Even but for steps a tenth too long or too short.
constexpr std::array<double, 7> nearly_even = {0.1, 0.9, 2.1, 2.9, 4.1, 4.9, 6.0};

std::int64_t counted(const auto& table, auto value) {
    return std::ranges::count_if(table, [&](auto entry) { return entry <= value; });
}

// At the entries, beside them, between them, and far away.
template <const auto& table>
void expect_counts_of_reals() {
    std::vector<double> values = {HUGE_VAL, -HUGE_VAL, std::nan(""), 1e300, -1e300, -0.0};
    for (const double entry : table)
        for (const double value :
             {entry, entry + 0.01, entry - 0.01, entry + 1.0, entry - 1.0,
              std::nextafter(entry, HUGE_VAL), std::nextafter(entry, -HUGE_VAL)})
            values.push_back(value);
    for (const double value : values)
        EXPECT_EQ((search<table, std::int64_t>(value)), counted(table, value))
            << std::size(table) << " " << value;

    constexpr int lanes = 8;
    using Pack = rddl::Pack<lanes>;
    for (std::size_t i = 0; i < values.size(); ++i) {
        typename Pack::Real packed;
        for (int lane = 0; lane < lanes; ++lane)
            packed.set(lane, values[(i + static_cast<std::size_t>(lane)) % values.size()]);
        const auto counts = search<table, typename Pack::Int>(packed);
        for (int lane = 0; lane < lanes; ++lane)
            EXPECT_EQ(counts[lane], counted(table, packed[lane])) << packed[lane];
    }
}

template <const auto& table>
void expect_counts_of_ints() {
    for (std::int64_t value = -3; value <= 2 * std::ssize(table) + 3; ++value)
        EXPECT_EQ((search<table, std::int64_t>(value)), counted(table, value)) << value;
}

template <std::size_t size>
void expect_counts() {
    expect_counts_of_reals<even<double, size>>();
    expect_counts_of_ints<even<std::int64_t, size>>();
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
    expect_counts_of_reals<uneven>();
    expect_counts_of_reals<nearly_even>();
}

TEST(Search, GuessesAmongEvenEntriesOnly) {
    static_assert(detail::has_even_entries<even<double, 100>>);
    static_assert(detail::has_even_entries<nearly_even>);
    static_assert(!detail::has_even_entries<uneven>);
    static_assert(!detail::has_even_entries<even<std::int64_t, 100>>);
}

}  // namespace
}  // namespace rddl
