// One environment whose objects are in registers has the values, draws and faults that it has with
// one object after the other. Also built for other instruction sets (CMakeLists.txt).
//
// Over 400 lines: a test for each thing that loops over several objects do, on shared tables.
#include <rddl/object_lanes/objects.hpp>
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl {
namespace {

// The number is not a multiple of the lanes.
constexpr Index rows = 11, columns = 5, count = rows * columns;

template <class T>
using Grid = std::array<std::array<T, columns>, rows>;

struct Tables {
    Grid<bool> on;
    Grid<std::int64_t> number;
    Grid<double> level;
    Grid<std::array<double, 3>> by_number;
};
Tables tables() {
    Tables result;
    Index i = 0;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c, ++i) {
            result.on[r][c] = i % 3 == 0 || i % 7 == 2;
            result.number[r][c] = i % 3;
            result.level[r][c] = 0.01 * static_cast<double>(i);
            result.by_number[r][c] = {0.1, 0.5, 1.0 - result.level[r][c]};
        }
    return result;
}

Context<Scalar> context_of_step(std::uint32_t step) {
    return {stream_key(1, 2, 3), step, {}};
}

// One object after the other, several in registers, and packs.
TEST(Objects, DrawMediansInAStreamWithoutLuck) {
    const Tables from = tables();
    Context<Scalar> context{median_key, 1, {}};
    Grid<bool> drawn;
    Grid<double> normal;
    for_each_object<count>(context, [&](auto& several, auto x) {
        elements(drawn, x) = sample::bernoulli(several, {0, x}, at(from.level, x));
        elements(normal, x) = sample::normal(several, {1, x}, at(from.level, x), 4.0);
    });
    using Lane = Pack<16>;
    const auto word = [](std::uint64_t bits) {
        return Lanes<std::uint64_t, 16>{bits};
    };
    auto packs =
        Context<Lane>::of(word(median_key.low), word(median_key.high), word(1), Mask<16>(true));
    for (Index i = 0; i < count; ++i) {
        const auto at_i = [&](const auto& grid) {
            return grid[i / columns][i % columns];
        };
        const double level = at_i(from.level);
        EXPECT_EQ(at_i(drawn), level > 0.5) << level;
        EXPECT_NEAR(at_i(normal), level, 1e-14);  // 1/2 is rounded up before a quantile
        EXPECT_EQ(sample::bernoulli(context, {0, i}, level), level > 0.5);
        EXPECT_EQ(sample::bernoulli(packs, {0, i}, level).bits, level > 0.5 ? 0xFFFF : 0);
    }
}

// The first objects of the tables, whose number is no multiple of the lanes.
template <Index objects>
void expect_elements() {
    const Tables from = tables();
    Context<Scalar> context = context_of_step(1);
    struct {
        Grid<bool> on{};
        bool behind_on = true;
        Grid<double> level{};
        double behind_level = -1;
        Grid<std::int64_t> number{};
        std::int64_t behind_number = -1;
    } to;
    for_each_object<objects>(context, [&](auto&, auto x) {
        elements(to.on, x) = !at(from.on, x);
        elements(to.level, x) = at(from.by_number, x, at(from.number, x)) + at(from.level, x);
        elements(to.number, x) = wrap_add(at(from.number, x), 3);
    });
    const auto at_i = [](const auto& grid, Index i) {
        return grid[static_cast<std::size_t>(i / columns)][static_cast<std::size_t>(i % columns)];
    };
    for (Index i = 0; i < objects; ++i) {
        const auto number = static_cast<std::size_t>(at_i(from.number, i));
        EXPECT_EQ(at_i(to.on, i), !at_i(from.on, i));
        EXPECT_EQ(at_i(to.level, i), at_i(from.by_number, i)[number] + at_i(from.level, i));
        EXPECT_EQ(at_i(to.number, i), at_i(from.number, i) + 3);
    }
    for (Index i = objects; i < count; ++i) {
        EXPECT_FALSE(at_i(to.on, i));
        EXPECT_EQ(at_i(to.level, i), 0);
        EXPECT_EQ(at_i(to.number, i), 0);
    }
    EXPECT_TRUE(to.behind_on);
    EXPECT_EQ(to.behind_level, -1);
    EXPECT_EQ(to.behind_number, -1);
}

TEST(Objects, AreElementsOfTables) {
    expect_elements<count>();
    expect_elements<16>();
    expect_elements<9>();
    expect_elements<8>();
    expect_elements<5>();
    expect_elements<1>();
}

template <std::size_t kinds>
void expect_own_choices() {
    std::array<std::array<double, 9>, kinds> values;
    std::array<std::array<bool, 9>, kinds> flags;
    for (std::size_t k = 0; k < 9 * kinds; ++k) {
        values[k / 9][k % 9] = 0.5 * static_cast<double>(k);
        flags[k / 9][k % 9] = k % 3 == 1;
    }
    Grid<std::int64_t> kind;
    Index i = 0;
    for (auto& row : kind)
        for (std::int64_t& of_object : row) of_object = (5 * i++ + 2) % static_cast<Index>(kinds);
    const Tables from = tables();
    Context<Scalar> context = context_of_step(1);
    Grid<double> value;
    Grid<bool> flag;
    for_each_object<count>(context, [&](auto&, auto x) {
        const auto number = wrap_add(at(from.number, x), 6);
        elements(value, x) = at_own(values, x, at(kind, x), number);
        elements(flag, x) = at_own(flags, x, at(kind, x), number);
    });
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) {
            const auto row = static_cast<std::size_t>(kind[r][c]);
            const auto number = static_cast<std::size_t>(from.number[r][c] + 6);
            EXPECT_EQ(value[r][c], values[row][number]);
            EXPECT_EQ(flag[r][c], flags[row][number]);
        }
}

// Elements are chosen from tables that registers may hold, and from greater ones.
TEST(Objects, ChooseElementsOfTheirOwn) {
    expect_own_choices<1>();
    expect_own_choices<2>();
    expect_own_choices<3>();
    expect_own_choices<9>();
}

// The places of some objects in tables of other sizes: those that registers hold, and greater ones.
template <std::size_t size, class Place, std::size_t objects>
constexpr auto places_of = [] {
    std::array<Place, objects> places{};
    for (std::size_t i = 0; i < objects; ++i)
        places[i] = static_cast<Place>((11 * i + size - 1) % size);
    return places;
}();
template <std::size_t size, class Place, std::size_t objects>
void expect_bools_at_places() {
    std::array<bool, size> on;
    for (std::size_t i = 0; i < size; ++i) on[i] = i % 3 == 0 || i % 7 == 2;
    static constexpr const auto& places = places_of<size, Place, objects>;
    Context<Scalar> context = context_of_step(1);
    std::array<bool, objects + 1> chosen{};
    constexpr auto object_count = static_cast<Index>(objects);
    for_each_object<object_count>(
        context, [&](auto&, auto x) { elements(chosen, x) = at_places<places>(on, x); });
    for (std::size_t i = 0; i < objects; ++i) {
        EXPECT_EQ(chosen[i], on[places[i]]) << size << " " << i;
        EXPECT_EQ(element(on, static_cast<Index>(places[i])), on[places[i]]);
    }
    EXPECT_FALSE(chosen[objects]);
}

TEST(Objects, ReadBoolsAtPlaces) {
    expect_bools_at_places<1, std::uint8_t, 20>();
    expect_bools_at_places<9, std::uint8_t, 5>();
    expect_bools_at_places<130, std::uint8_t, 7>();
    expect_bools_at_places<15, std::uint8_t, 64>();
    expect_bools_at_places<33, std::uint8_t, 17>();
    expect_bools_at_places<64, std::uint8_t, 65>();
    expect_bools_at_places<72, std::uint8_t, 72>();
    expect_bools_at_places<128, std::uint8_t, 130>();
    expect_bools_at_places<130, std::uint8_t, 90>();
    expect_bools_at_places<200, std::uint8_t, 31>();
    expect_bools_at_places<256, std::uint8_t, 300>();
    expect_bools_at_places<300, std::uint16_t, 100>();
}

// Each object aggregates elements that lie beside those of its neighbours: the same results as one
// object after the other, with the first of two zeros, nan and the order of additions.
template <std::size_t objects>
void expect_aggregates_of_own_terms() {
    constexpr std::size_t terms = 7;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::array<std::array<double, objects>, terms> level;
    std::array<std::array<bool, objects>, terms> on;
    for (std::size_t k = 0; k < terms; ++k)
        for (std::size_t i = 0; i < objects; ++i) {
            level[k][i] = k % 2 == 0 ? 0.1 * static_cast<double>(i + k) : -1e16;
            if (i % 5 == 0) level[k][i] = k % 2 == 0 ? -0.0 : 0.0;
            if (i % 11 == 3 && k == 4) level[k][i] = nan;
            on[k][i] = (i * k) % 3 == 1 || i % 4 == 0;
        }
    struct Results {
        std::array<double, objects> sum, product, least, greatest;
        std::array<std::int64_t, objects> count;
        std::array<bool, objects> all, any;
    } together, alone;
    constexpr auto term_count = static_cast<Index>(terms);
    const auto row = [](auto& table, Index k) -> auto& {
        return table[static_cast<std::size_t>(k)];
    };
    Context<Scalar> context = context_of_step(1);
    for_each_object<static_cast<Index>(objects)>(context, [&](auto& several, auto x) {
        const auto term = [&](Index k) {
            return at(row(level, k), x);
        };
        const auto condition = [&](Index k) {
            return at(row(on, k), x);
        };
        elements(together.sum, x) = sum(several, term_count, term);
        elements(together.product, x) = product(several, term_count, term);
        elements(together.least, x) = minimum_over(several, term_count, term);
        elements(together.greatest, x) = maximum_over(several, term_count, term);
        elements(together.count, x) =
            sum(several, IndexRange(1, 5), [&](Index k) { return to_int(condition(k)); });
        elements(together.all, x) = for_all(several, term_count, condition);
        elements(together.any, x) = exists(several, term_count, condition);
    });
    for (std::size_t i = 0; i < objects; ++i) {
        const auto term = [&](Index k) {
            return row(level, k)[i];
        };
        const auto condition = [&](Index k) {
            return row(on, k)[i];
        };
        alone.sum[i] = sum<double>(term_count, term);
        alone.product[i] = product<double>(term_count, term);
        alone.least[i] = minimum_over<double>(term_count, term);
        alone.greatest[i] = maximum_over<double>(term_count, term);
        alone.count[i] =
            sum<std::int64_t>(IndexRange(1, 5), [&](Index k) { return to_int(condition(k)); });
        alone.all[i] = for_all<bool>(term_count, condition);
        alone.any[i] = exists<bool>(term_count, condition);
        for (const auto reals :
             {&Results::sum, &Results::product, &Results::least, &Results::greatest})
            EXPECT_EQ(std::bit_cast<std::uint64_t>((together.*reals)[i]),
                      std::bit_cast<std::uint64_t>((alone.*reals)[i]))
                << i;
        EXPECT_EQ(together.count[i], alone.count[i]) << i;
        EXPECT_EQ(together.all[i], alone.all[i]) << i;
        EXPECT_EQ(together.any[i], alone.any[i]) << i;
    }
}

TEST(Objects, AggregateTheirOwnTerms) {
    expect_aggregates_of_own_terms<37>();
    expect_aggregates_of_own_terms<6>();
}

template <Index n>
void expect_one_value_for_all() {
    std::array<bool, 65> on{};
    std::array<double, 65> level{};
    Context<Scalar> context = context_of_step(1);
    for_each_object<n>(context, [&](auto&, auto x) {
        elements(on, x) = true;
        elements(level, x) = 2.5;
    });
    for (std::size_t i = 0; i < on.size(); ++i) {
        EXPECT_EQ(on[i], static_cast<Index>(i) < n);
        EXPECT_EQ(level[i], static_cast<Index>(i) < n ? 2.5 : 0);
    }
}

TEST(Objects, TakeOneValueForAll) {
    expect_one_value_for_all<3>();
    expect_one_value_for_all<8>();
    expect_one_value_for_all<16>();
    expect_one_value_for_all<17>();
    expect_one_value_for_all<64>();
}

template <Index objects>
void expect_draws_one_by_one() {
    const Tables from = tables();
    Context<Scalar> context = context_of_step(7), other = context;
    Grid<bool> on;
    Grid<double> level, wait;
    Grid<std::int64_t> kind, share, other_kind;
    const auto weight_by = [](const auto& p) {
        return [p](Index i) {
            return i == 0 ? p : (1.0 - p) * 0.5;
        };
    };
    for_each_object<objects>(context, [&](auto& several, auto x) {
        elements(on, x) = branch(
            several, at(from.on, x), [&] { return true; },
            [&] {
                return sample::bernoulli(several, {3, x}, at(from.level, x));
            });
        elements(level, x) = sample::normal(several, {4, x, 3}, at(from.level, x), 2.0);
        elements(wait, x) = sample::exponential(several, {5, x}, 2.0);
        const auto weight = weight_by(at(from.level, x) + 0.0);
        elements(kind, x) = sample::discrete_over(several, {6, x}, 3, weight);
        elements(share, x) = sample::discrete_of_shares_over(several, {6, x}, 3,
                                                             at(from.level, x) * 0.0 + 1.0, weight);
        elements(other_kind, x) = sample::unnormalised_discrete_over(several, {7, x}, 2, weight);
    });
    for (Index i = 0; i < objects; ++i) {
        const auto r = static_cast<std::size_t>(i / columns);
        const auto c = static_cast<std::size_t>(i % columns);
        const double p = from.level[r][c];
        EXPECT_EQ(on[r][c], from.on[r][c] || sample::bernoulli(other, {3, i}, p));
        EXPECT_EQ(level[r][c], sample::normal(other, {4, i, 3}, p, 2.0));
        EXPECT_EQ(wait[r][c], sample::exponential(other, {5, i}, 2.0));
        EXPECT_EQ(kind[r][c], sample::discrete_over(other, {6, i}, 3, weight_by(p)));
        EXPECT_EQ(share[r][c], kind[r][c]);
        EXPECT_EQ(other_kind[r][c],
                  sample::unnormalised_discrete_over(other, {7, i}, 2, weight_by(p)));
    }
    EXPECT_FALSE(context.faulted());
}

TEST(Objects, DrawWhatTheyDrawOneByOne) {
    expect_draws_one_by_one<count>();
    expect_draws_one_by_one<8>();
    expect_draws_one_by_one<3>();
}

// Shared are the normals of all objects, of most of them, and of few.
template <Index objects>
void expect_shared_normals(Context<Scalar> context) {
    constexpr auto size = static_cast<std::size_t>(objects);
    std::array<bool, size> few{};
    for (std::size_t i = 5; i < size; i += 16) few[i] = true;
    std::array<double, size> all{}, some{};
    for_each_object<objects>(context, [&](auto& several, auto x) {
        elements(all, x) = sample::normal(several, PlaceAmong<objects>{1, x}, 3.0, 2.0);
        elements(some, x) = branch(
            several, at(few, x),
            [&] {
                return sample::normal(several, PlaceAmong<objects>{2, x}, 0.0, 1.0);
            },
            [&] {
                return sample::normal(several, PlaceAmong<objects>{3, x, 9}, 0.0, 1.0);
            });
    });
    for (Index i = 0; i < objects; ++i) {
        const auto x = static_cast<std::size_t>(i);
        EXPECT_EQ(all[x], sample::normal(context, {1, i}, 3.0, 2.0)) << i;
        EXPECT_EQ(some[x], few[x] ? sample::normal(context, {2, i}, 0.0, 1.0)
                                  : sample::normal(context, {3, i, 9}, 0.0, 1.0))
            << i;
    }
}

TEST(Objects, MakeTheirNormalsTogether) {
    expect_shared_normals<2>(context_of_step(5));
    expect_shared_normals<4>(context_of_step(6));
    expect_shared_normals<2>({median_key, 1, {}});
    expect_shared_normals<16>(context_of_step(1));
    expect_shared_normals<21>(context_of_step(2));
    expect_shared_normals<64>(context_of_step(3));
    expect_shared_normals<150>(context_of_step(4));
    expect_shared_normals<40>({median_key, 1, {}});
}

// Series of one loop do not drive each other out: 1 and 2 are kept, and 5 has no room.
TEST(Objects, KeepTheNormalsOfSeveralSeries) {
    constexpr std::array<std::uint32_t, 3> series = {1, 2, 5};
    Context<Scalar> context = context_of_step(5);
    std::array<std::array<double, 64>, 3> drawn{};
    std::array<int, 3> kept{};
    for_each_object<64>(context, [&](auto& several, auto x) {
        for (std::size_t i = 0; i < series.size(); ++i) {
            const PlaceAmong<64> place{series[i], x};
            kept[i] += several.normals->of(place).has(place);
            elements(drawn[i], x) = sample::normal(several, place, 0.0, 1.0);
        }
    });
    for (std::size_t i = 0; i < series.size(); ++i)
        for (Index x = 0; x < 64; ++x)
            EXPECT_EQ(drawn[i][static_cast<std::size_t>(x)],
                      sample::normal(context, {series[i], x}, 0.0, 1.0))
                << series[i] << ' ' << x;
    // The first objects make them for all.
    constexpr int others = 64 / objects_at_once - 1;
    EXPECT_EQ(kept, (std::array{others, others, 0}));
}

constexpr std::array<std::array<double, 2>, 3> thresholds_by_kind = {{
    {0.2, 0.4},
    {0.5, 0.5},
    {0.1, 0.9},
}};
// The objects are more than a register has lanes.
constexpr std::array<std::array<double, 9>, 21> thresholds_by_object = [] {
    std::array<std::array<double, 9>, 21> all{};
    for (std::size_t x = 0; x < all.size(); ++x)
        for (std::size_t i = 0; i < all[x].size(); ++i)
            all[x][i] = 0.1 * static_cast<double>(i) + 0.01 * static_cast<double>(x);
    return all;
}();

TEST(Objects, DrawIntervalsFromRowsOfTheirOwn) {
    std::array<std::int64_t, 21> kinds{}, of_kind{}, of_object{}, chosen{};
    for (std::size_t x = 0; x < kinds.size(); ++x) kinds[x] = static_cast<std::int64_t>(x % 3);
    Context<Scalar> context = context_of_step(7), other = context;
    for_each_object<21>(context, [&](auto& several, auto x) {
        elements(of_kind, x) = sample::interval<thresholds_by_kind>(several, {3, x}, at(kinds, x));
        elements(of_object, x) = sample::interval<thresholds_by_object>(several, {4, x}, x);
        elements(chosen, x) = branch(
            several, at(kinds, x) > 0,
            [&] {
                return sample::interval<thresholds_by_kind>(several, {5, x},
                                                            wrap_sub(at(kinds, x), 1));
            },
            [&] { return std::int64_t{-1}; });
    });
    for (Index x = 0; x < 21; ++x) {
        const auto i = static_cast<std::size_t>(x);
        EXPECT_EQ(of_kind[i], sample::interval<thresholds_by_kind>(other, {3, x}, kinds[i]));
        EXPECT_EQ(of_object[i], sample::interval<thresholds_by_object>(other, {4, x}, x));
        EXPECT_EQ(chosen[i], kinds[i] > 0
                                 ? sample::interval<thresholds_by_kind>(other, {5, x}, kinds[i] - 1)
                                 : -1);
    }
}

// The first of several faults counts, though one operator comes before the other.
TEST(Objects, TellTheFaultOfTheFirstObject) {
    std::array<double, 40> p{}, variance{};
    p[30] = 2;
    variance[21] = -1;
    variance[30] = -1;
    std::array<bool, 40> draws{};
    std::array<double, 40> levels{};
    Context<Scalar> context = context_of_step(1);
    for_each_object<40>(context, [&](auto& several, auto x) {
        elements(draws, x) = sample::bernoulli(several, {0, x}, at(p, x));
        elements(levels, x) = sample::normal(several, {1, x}, 0.0, at(variance, x));
    });
    EXPECT_EQ(context.fault.kind, FaultKind::Variance);
    EXPECT_EQ(context.fault.place, Place(1, 21));
    EXPECT_EQ(context.fault.value, -1);
}

template <Index objects>
void expect_quantifiers() {
    std::array<double, static_cast<std::size_t>(objects)> level{};
    Context<Scalar> context = context_of_step(1);
    auto packs =
        Context<Pack<16>>::of(Pack<16>::Word{7}, Pack<16>::Word{9}, Pack<16>::Word{1}, true);
    const auto expect = [&](bool any, bool all) {
        const auto is_high = [&](auto&, auto x) {
            return at(level, x) > 0.0;
        };
        EXPECT_EQ(exists_object<objects>(context, is_high), any);
        EXPECT_EQ(for_all_objects<objects>(context, is_high), all);
        const auto is_high_in_some = [&](auto&, auto x) {
            return Lanes<double, 16>(at(level, x)) > 0.0;
        };
        EXPECT_EQ(exists_object<objects>(packs, is_high_in_some).bits, any ? 0xFFFF : 0);
        EXPECT_EQ(for_all_objects<objects>(packs, is_high_in_some).bits, all ? 0xFFFF : 0);
    };
    expect(false, false);
    for (double& each : level) {
        each = 1;
        expect(true, objects == 1);
        each = 0;
    }
    level.fill(1);
    expect(true, true);
}

TEST(Objects, TellWhetherABoolHoldsForOneOrForAll) {
    expect_quantifiers<1>();
    expect_quantifiers<8>();
    expect_quantifiers<13>();
    expect_quantifiers<24>();
}

TEST(Objects, DoNotFaultInBranchesThatTheyDoNotTake) {
    std::array<double, 20> p{};
    p[3] = 2;
    std::array<bool, 20> draws{};
    Context<Scalar> context = context_of_step(1);
    for_each_object<20>(context, [&](auto& several, auto x) {
        elements(draws, x) = branch(
            several, at(p, x) > 1.0, [&] { return false; },
            [&] {
                return sample::bernoulli(several, {0, x}, at(p, x));
            });
    });
    EXPECT_FALSE(context.faulted());
}

// Packs of environments take one object after the other.
TEST(Objects, ArePlainElementsInPacks) {
    using L = Pack<16>;
    std::array<L::Bool, count> on;
    std::array<L::Real, count> level;
    const Tables from = tables();
    Context<L> context = Context<L>::of(L::Word{7}, L::Word{9}, L::Word{1}, true);
    for_each_object<count>(context, [&](auto& several, auto x) {
        elements(on, x) = sample::bernoulli(several, {0, x}, at(from.level, x));
        elements(level, x) = at(from.by_number, x, 1) + 1.0;
    });
    Context<Scalar> alone{StreamKey{7, 9}, 1, {}};
    Grid<bool> expected;
    for_each_object<count>(alone, [&](auto& several, auto x) {
        elements(expected, x) = sample::bernoulli(several, {0, x}, at(from.level, x));
    });
    for (std::size_t i = 0; i < on.size(); ++i) {
        EXPECT_EQ(on[i][5], expected[i / columns][i % columns]);
        EXPECT_EQ(level[i][5], 1.5);
    }
}

template <Index count>
void expect_draws_of_floats() {
    std::array<float, count> p;
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = 0.05f * static_cast<float>(i);
    std::array<bool, count> draws{};
    std::array<float, count> sums{};
    Context<ScalarOf<float>> context{stream_key(1, 2, 3), 1, {}}, other = context;
    for_each_object<count>(context, [&](auto& several, auto x) {
        elements(draws, x) = sample::bernoulli(several, {0, x}, at(p, x));
        elements(sums, x) = at(p, x) + sample::uniform(several, {1, x}, 0.0f, at(p, x));
    });
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto x = static_cast<Index>(i);
        EXPECT_EQ(draws[i], sample::bernoulli(other, {0, x}, p[i]));
        EXPECT_EQ(sums[i], p[i] + sample::uniform(other, {1, x}, 0.0f, p[i]));
    }
}

// Up to 8 take half a register of AVX-512, and up to 4 are stored one by one.
TEST(Objects, HaveFloats) {
    expect_draws_of_floats<1>();
    expect_draws_of_floats<3>();
    expect_draws_of_floats<7>();
    expect_draws_of_floats<8>();
    expect_draws_of_floats<20>();
    expect_draws_of_floats<37>();
}

template <class R, std::size_t rows, std::size_t size>
void expect_sums_of_rows() {
    std::array<std::array<R, size>, rows> table;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t k = 0; k < size; ++k)
            table[r][k] = k == 0 ? R(-0.0) : R(1) / static_cast<R>(r * size + k);
    const auto expect_all = [&](const auto& objects, const auto& sums) {
        for (int lane = 0; lane < objects.count; ++lane)
            EXPECT_EQ(get_lane(sums, lane), sum_of_row(table, OneObject{objects.first + lane}));
    };
    const SomeObjects<8> eight{0, 8}, few{1, 5};
    expect_all(eight, sum_of_row(table, eight));
    expect_all(few, sum_of_row(table, few));
    if constexpr (rows >= 16) {
        const SomeObjects<16> all{0, 16}, most{2, 11};
        expect_all(all, sum_of_row(table, all));
        expect_all(most, sum_of_row(table, most));
    }
}
TEST(SeveralObjects, AddTheirRowsInOrder) {
    expect_sums_of_rows<double, 8, 8>();
    expect_sums_of_rows<double, 16, 16>();
    expect_sums_of_rows<double, 16, 11>();
    expect_sums_of_rows<float, 16, 8>();
}

}  // namespace
}  // namespace rddl
