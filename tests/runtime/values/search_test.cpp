#include <rddl/lanes/pack.hpp>
#include <rddl/values/pack_ops.hpp>
#include <rddl/values/search.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
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
// Even steps, except that some are a tenth too long or too short.
template <class Real>
constexpr std::array<Real, 7> nearly_even = {Real(0.1), Real(0.9), Real(2.1), Real(2.9),
                                             Real(4.1), Real(4.9), Real(6.0)};
// Doubles that are nearer to each other than floats become such floats.
constexpr std::array<float, 5> repeated = {0.1f, 0.1f, 0.3f, 0.5f, 0.5f};
// No line goes through these without overflow, or a nan; nor could a constant expression have one.
template <class Real>
constexpr Real tiniest = std::numeric_limits<Real>::denorm_min();
template <class Real>
constexpr Real greatest = std::numeric_limits<Real>::max();
template <class Real>
constexpr Real infinite = std::numeric_limits<Real>::infinity();
template <class Real>
constexpr std::array<Real, 2> near = {Real(0), tiniest<Real>};
template <class Real>
constexpr std::array<Real, 3> far = {-greatest<Real>, Real(0), greatest<Real>};
template <class Real>
constexpr std::array<Real, 3> endless = {-infinite<Real>, Real(0), infinite<Real>};
template <class Real>
constexpr std::array<Real, 2> both_infinite = {infinite<Real>, infinite<Real>};

std::int64_t counted(const auto& table, auto value) {
    return std::ranges::count_if(table, [&](auto entry) { return entry <= value; });
}

// Searches at the entries, beside them, between them, and far away.
template <const auto& table>
void expect_counts_of_reals() {
    using Real = typename std::remove_cvref_t<decltype(table)>::value_type;
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    constexpr Real most = std::numeric_limits<Real>::max();
    std::vector<Real> values = {infinity, -infinity, Real(std::nan("")), most, -most, Real(-0.0)};
    for (const Real entry : table)
        for (const Real value :
             {entry, entry + Real(0.01), entry - Real(0.01), entry + Real(1), entry - Real(1),
              std::nextafter(entry, infinity), std::nextafter(entry, -infinity)})
            values.push_back(value);
    for (const Real value : values)
        EXPECT_EQ((search<table, std::int64_t>(value)), counted(table, value))
            << std::size(table) << " " << value;

    constexpr int lanes = 16;
    using Pack = rddl::Pack<lanes, Real>;
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
    expect_counts_of_reals<even<float, size>>();
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
    expect_counts_of_reals<nearly_even<double>>();
    expect_counts_of_reals<nearly_even<float>>();
    expect_counts_of_reals<repeated>();
}

template <class Real>
void expect_counts_at_the_ends_of() {
    expect_counts_of_reals<near<Real>>();
    expect_counts_of_reals<far<Real>>();
    expect_counts_of_reals<endless<Real>>();
    expect_counts_of_reals<both_infinite<Real>>();
}

TEST(Search, CountsEntriesAtTheEndsOfReals) {
    expect_counts_at_the_ends_of<double>();
    expect_counts_at_the_ends_of<float>();
}

TEST(Search, GuessesAmongEvenEntriesOnly) {
    static_assert(detail::has_even_entries<even<double, 100>>);
    static_assert(detail::has_even_entries<even<float, 100>>);
    static_assert(detail::has_even_entries<nearly_even<double>>);
    static_assert(!detail::has_even_entries<uneven>);
    static_assert(!detail::has_even_entries<even<std::int64_t, 100>>);
}

}  // namespace
}  // namespace rddl
