// Bools of many objects in registers have the values and draws that they have with one object after
// the other, for one environment and for packs. Also built for other instruction sets
// (CMakeLists.txt).
#include <rddl/object_lanes/many_objects.hpp>
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace rddl {
namespace {

template <class L>
constexpr int lanes = L::width;

template <class L>
Context<L> context_of_lanes() {
    if constexpr (lanes<L> == 1) {
        return {stream_key(1, 2, 3), 4, {}};
    } else {
        typename L::Word low, high;
        for (int lane = 0; lane < lanes<L>; ++lane) {
            const StreamKey key = stream_key(1, static_cast<std::uint64_t>(lane), 3);
            low.set(lane, key.low);
            high.set(lane, key.high);
        }
        return Context<L>::of(low, high, typename L::Word{std::uint64_t{4}}, true);
    }
}

// A pattern that differs between objects and lanes.
template <class L>
typename L::Bool bool_at(std::size_t i) {
    typename L::Bool result{false};
    for (int lane = 0; lane < lanes<L>; ++lane)
        set_lane(result, lane, (i * 7 + static_cast<std::size_t>(lane) * 5) % 11 < 4);
    return result;
}

template <class L, std::size_t n>
struct Tables {
    // The one behind the last is not touched.
    std::array<typename L::Bool, n + 1> on{}, chosen{}, drawn{}, drawn_everywhere{};
};

template <std::size_t size>
constexpr auto constants = [] {
    std::array<bool, size> bools{};
    for (std::size_t i = 0; i < size; ++i) bools[i] = i % 3 == 0 || i % 7 == 2;
    return bools;
}();

// Objects in loops over several at once and in loops over many.
template <class L, std::size_t n, std::size_t size, const auto& places>
void expect_the_same_at() {
    std::array<typename L::Bool, size> from;
    for (std::size_t i = 0; i < size; ++i) from[i] = bool_at<L>(i);
    std::array<typename L::Element, n> chance;
    for (std::size_t i = 0; i < n; ++i) chance[i] = static_cast<typename L::Element>(i % 6) / 5;
    const typename L::Bool flag = bool_at<L>(3);
    const auto body = [&](Tables<L, n>& to) {
        return [&](auto& several, auto x) {
            elements(to.on, x) = select(at(constants<n>, x), !at_places<places>(from, x), flag);
            elements(to.chosen, x) = branch(
                flag && at(constants<n>, x), [&] { return true; },
                [&] { return flag != at(constants<n>, x); }, [&] { return false; },
                [&] { return at_places<places>(from, x) == flag; });
            elements(to.drawn, x) = branch(
                several, at_places<places>(from, x) && at(constants<n>, x),
                [&] {
                    return sample::valid_bernoulli(several, {0, x}, at(chance, x));
                },
                [&] { return flag; });
            elements(to.drawn_everywhere, x) = sample::bernoulli(several, {1, x, 2}, 0.25);
        };
    };
    Tables<L, n> expected, result;
    Context<L> context = context_of_lanes<L>(), same_context = context_of_lanes<L>();
    for_each_object<n>(context, body(expected));
    for_many_objects<n>(same_context, body(result));
    const auto expect = [](const auto& a, const auto& b) {
        for (std::size_t i = 0; i <= n; ++i)
            for (int lane = 0; lane < lanes<L>; ++lane)
                EXPECT_EQ(get_lane(a[i], lane), get_lane(b[i], lane))
                    << n << " objects, object " << i << ", lane " << lane;
    };
    expect(expected.on, result.on);
    expect(expected.chosen, result.chosen);
    expect(expected.drawn, result.drawn);
    expect(expected.drawn_everywhere, result.drawn_everywhere);
}

template <std::size_t n, std::size_t size, class Place>
constexpr auto places_of = [] {
    std::array<Place, n> places{};
    for (std::size_t i = 0; i < n; ++i) places[i] = static_cast<Place>((11 * i + size - 1) % size);
    return places;
}();
// Places that follow each other, that are equal, and others, each for 40 objects.
template <std::size_t n, std::size_t size, class Place>
constexpr auto lines_of = [] {
    std::array<Place, n> places{};
    for (std::size_t i = 0; i < n; ++i)
        places[i] = static_cast<Place>((i / 40 % 3 == 0 ? i : i / 40 % 3 == 1 ? 5 : 11 * i) % size);
    return places;
}();
template <class L, std::size_t n, std::size_t size, class Place>
void expect_the_same() {
    expect_the_same_at<L, n, size, places_of<n, size, Place>>();
    expect_the_same_at<L, n, size, lines_of<n, size, Place>>();
}

// Full registers and parts of them, and tables that registers can look up and greater ones.
TEST(ManyObjects, OfOneEnvironment) {
    expect_the_same<Scalar, 5, 4, std::uint8_t>();
    expect_the_same<Scalar, 17, 64, std::uint8_t>();
    expect_the_same<Scalar, 64, 128, std::uint8_t>();
    expect_the_same<Scalar, 100, 192, std::uint8_t>();
    expect_the_same<Scalar, 257, 256, std::uint8_t>();
    expect_the_same<Scalar, 261, 64, std::uint8_t>();
    expect_the_same<Scalar, 300, 300, std::uint16_t>();
    expect_the_same<ScalarOf<float>, 72, 100, std::uint8_t>();
}
TEST(ManyObjects, OfPacks) {
    expect_the_same<Pack<8>, 100, 72, std::uint8_t>();
    expect_the_same<Pack<16>, 33, 130, std::uint8_t>();
    expect_the_same<Pack<64>, 3, 33, std::uint8_t>();
    expect_the_same<Pack<64>, 16, 300, std::uint16_t>();
    expect_the_same<Pack<64, float>, 21, 21, std::uint8_t>();
}

// Aggregations of rows that others choose, by rows of places.
template <class L, std::size_t n, std::size_t size>
void expect_the_same_rows() {
    constexpr std::size_t terms = 3;
    [[maybe_unused]] static constexpr auto places = [] {
        std::array<std::array<std::uint8_t, n>, terms> rows{};
        for (std::size_t j = 0; j < terms; ++j)
            for (std::size_t i = 0; i < n; ++i)
                rows[j][i] = static_cast<std::uint8_t>((7 * i + 3 * j) % size);
        return rows;
    }();
    std::array<std::array<typename L::Bool, size>, terms> from;
    std::array<typename L::Bool, n + 1> expected{}, result{};
    std::array<typename L::Bool, terms> wanted;
    for (std::size_t j = 0; j < terms; ++j) {
        wanted[j] = bool_at<L>(j);
        for (std::size_t i = 0; i < size; ++i) from[j][i] = bool_at<L>(3 * i + j);
    }
    const auto body = [&](auto& to) {
        return [&](auto& several, auto x) {
            const auto any = exists(several, Index{terms}, [&](Index j) {
                return wanted[static_cast<std::size_t>(j)] &&
                       at_places<places>(from[static_cast<std::size_t>(j)], x, j);
            });
            const auto all = for_all(several, Index{terms}, [&](Index j) {
                return at(constants<n>, x) ||
                       !at_places<places>(from[static_cast<std::size_t>(terms - 1 - j)], x, j);
            });
            elements(to, x) = any != all;
        };
    };
    Context<L> context = context_of_lanes<L>();
    for_each_object<n>(context, body(expected));
    for_rows_of_bools<n>(context, body(result));
    for (std::size_t i = 0; i <= n; ++i)
        for (int lane = 0; lane < lanes<L>; ++lane)
            EXPECT_EQ(get_lane(expected[i], lane), get_lane(result[i], lane))
                << n << " objects, object " << i << ", lane " << lane;
}
TEST(ManyObjects, AggregateRows) {
    expect_the_same_rows<Scalar, 5, 6>();
    expect_the_same_rows<Scalar, 6, 17>();
    expect_the_same_rows<Scalar, 8, 8>();
    expect_the_same_rows<Scalar, 13, 40>();
    expect_the_same_rows<Scalar, 16, 16>();
    expect_the_same_rows<Scalar, 16, 64>();
    expect_the_same_rows<Scalar, 17, 20>();
    expect_the_same_rows<Scalar, 70, 64>();
    expect_the_same_rows<ScalarOf<float>, 7, 9>();
    expect_the_same_rows<Pack<16>, 40, 50>();
    expect_the_same_rows<Pack<64>, 6, 6>();
    expect_the_same_rows<Pack<64>, 11, 20>();
}

// Probabilities of which some are 0 or 1: those of a few objects only are not, or of many.
template <std::size_t n, std::size_t every, class R>
constexpr auto chances_of = [] {
    std::array<R, n> table{};
    for (std::size_t i = 0; i < n; ++i)
        table[i] = i % every == every / 2 ? static_cast<R>(i % 5 + 1) / 6 : R(i % 3 == 0);
    return table;
}();
// Draws of one object of each `apart`.
template <class L, std::size_t n, std::size_t every>
void expect_the_same_draws(std::size_t apart = 1) {
    static constexpr const auto& table = chances_of<n, every, typename L::Element>;
    std::array<typename L::Bool, n> wanted, expected, result;
    for (std::size_t i = 0; i < n; ++i)
        wanted[i] = i % apart == 0 ? bool_at<L>(i) : typename L::Bool(false);
    Context<L> context = context_of_lanes<L>(), same_context = context_of_lanes<L>();
    for_many_objects<n>(context, [&](auto& several, auto x) {
        elements(expected, x) = branch(
            several, at(wanted, x),
            [&] {
                return sample::valid_bernoulli(several, {0, x}, at(table, x));
            },
            [&] { return false; });
    });
    for_many_objects<n>(same_context, [&](auto& several, auto x) {
        elements(result, x) = branch(
            several, at(wanted, x),
            [&] {
                return sample::valid_bernoulli(several, {0, x}, chances<table>(x));
            },
            [&] { return false; });
    });
    for (std::size_t i = 0; i < n; ++i)
        for (int lane = 0; lane < lanes<L>; ++lane)
            EXPECT_EQ(get_lane(expected[i], lane), get_lane(result[i], lane))
                << n << " objects, object " << i << ", lane " << lane;
}
TEST(ManyObjects, DrawWithChancesSomeOfWhichAreCertain) {
    expect_the_same_draws<Scalar, 12, 5>();
    expect_the_same_draws<Scalar, 73, 36>();
    expect_the_same_draws<Scalar, 130, 13>();
    expect_the_same_draws<Scalar, 100, 2>();
    expect_the_same_draws<Scalar, 50, 200>();
    expect_the_same_draws<Scalar, 300, 17>();
    expect_the_same_draws<Scalar, 80, 1>();
    expect_the_same_draws<ScalarOf<float>, 72, 20>();
    expect_the_same_draws<Pack<16>, 73, 20>();
    expect_the_same_draws<Pack<64>, 40, 3>();
    expect_the_same_draws<Pack<16>, 5, 2>();
    expect_the_same_draws<Pack<64, float>, 7, 3>();
    expect_the_same_draws<Pack<64>, 90, 3>(40);
    expect_the_same_draws<Pack<64>, 90, 1>(40);
    expect_the_same_draws<Pack<16>, 90, 3>(40);
}
// Few objects, and tables that each object chooses from.
template <class L, std::size_t n, std::size_t every>
void expect_the_same_choices() {
    using R = typename L::Element;
    static constexpr const auto& yes = chances_of<n, every, R>;
    static constexpr const auto& no = chances_of<n, 2 * every, R>;
    std::array<typename L::Bool, n> wanted, expected, result, expected_by_flag, by_flag;
    const typename L::Bool flag = bool_at<L>(1);
    for (std::size_t i = 0; i < n; ++i) wanted[i] = bool_at<L>(i);
    Context<L> context = context_of_lanes<L>(), same_context = context_of_lanes<L>();
    for_each_object<n>(context, [&](auto& several, auto x) {
        elements(expected, x) = sample::valid_bernoulli(
            several, {0, x}, select(at(wanted, x) || flag, at(yes, x), at(no, x)));
        elements(expected_by_flag, x) =
            sample::valid_bernoulli(several, {1, x}, select(flag, at(yes, x), at(no, x)));
    });
    for_each_object<n>(same_context, [&](auto& several, auto x) {
        elements(result, x) = sample::valid_bernoulli(
            several, {0, x}, select(at(wanted, x) || flag, chances<yes>(x), chances<no>(x)));
        elements(by_flag, x) =
            sample::valid_bernoulli(several, {1, x}, select(flag, chances<yes>(x), chances<no>(x)));
    });
    for (std::size_t i = 0; i < n; ++i)
        for (int lane = 0; lane < lanes<L>; ++lane) {
            EXPECT_EQ(get_lane(expected[i], lane), get_lane(result[i], lane))
                << n << " objects, object " << i << ", lane " << lane;
            EXPECT_EQ(get_lane(expected_by_flag[i], lane), get_lane(by_flag[i], lane))
                << n << " objects, object " << i << ", lane " << lane;
        }
}
TEST(ManyObjects, DrawWithChancesOfOneOfTwoTables) {
    expect_the_same_choices<Scalar, 7, 1>();
    expect_the_same_choices<Scalar, 45, 3>();
    expect_the_same_choices<ScalarOf<float>, 30, 2>();
    expect_the_same_choices<Pack<16>, 9, 2>();
}
constexpr std::array<double, 3> three_chances = {0, 0.5, 1};
TEST(ManyObjects, DrawForOneObjectWithChances) {
    Context<Scalar> context = context_of_lanes<Scalar>();
    const auto drawn = [&](Index i) {
        return sample::valid_bernoulli(context, {0, i}, chances<three_chances>(OneObject{i}));
    };
    EXPECT_FALSE(drawn(0));
    EXPECT_EQ(drawn(1), sample::valid_bernoulli(context, {0, 1}, 0.5));
    EXPECT_TRUE(drawn(2));
}
constexpr std::array<double, 40> two_chances = [] {
    std::array<double, 40> table{};
    table[7] = 0.75;
    table[30] = 0.5;
    return table;
}();
TEST(ManyObjects, DrawMediansWithChances) {
    Context<Scalar> context{median_key, 4, {}};
    std::array<bool, 40> drawn;
    for_many_objects<40>(context, [&](auto& several, auto x) {
        elements(drawn, x) = sample::valid_bernoulli(several, {0, x}, chances<two_chances>(x));
    });
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(drawn[i], i == 7) << i;
}

// A uniform number is below p just as its multiple of 2^-52, or of 2^-23, is below the count.
TEST(ManyObjects, CountTheNumbersBelowChances) {
    constexpr std::int64_t all = std::int64_t{1} << 52, of_floats = std::int64_t{1} << 23;
    EXPECT_EQ(detail::count_below(0.0), 0);
    EXPECT_EQ(detail::count_below(-1.0), 0);
    EXPECT_EQ(detail::count_below(0x1p-60), 1);
    EXPECT_EQ(detail::count_below(0x1p-52), 1);
    EXPECT_EQ(detail::count_below(0x1.8p-52), 2);
    EXPECT_EQ(detail::count_below(0.5), all / 2);
    EXPECT_EQ(detail::count_below(1 - 0x1p-52), all - 1);
    EXPECT_EQ(detail::count_below(1 - 0x1p-53), all);
    EXPECT_EQ(detail::count_below(1.0), all);
    EXPECT_EQ(detail::count_below(0.3f), static_cast<std::int64_t>(0.3f * 0x1p23) + 1);
    EXPECT_EQ(detail::count_below(1 - 0x1p-23f), of_floats - 1);
    EXPECT_EQ(detail::count_below(1 - 0x1p-24f), of_floats);
}

constexpr std::size_t affected_count = 100;
constexpr auto affected_places = [] {
    std::array<std::uint8_t, affected_count> places{};
    for (std::size_t i = 0; i < affected_count; ++i)
        places[i] = static_cast<std::uint8_t>((3 * i + 1) % affected_count);
    return places;
}();

// Object i reads the bools i and 3 i + 1 of few; none, one, some or many of which are true.
template <class L>
void expect_the_affected(std::size_t every) {
    constexpr std::size_t n = affected_count;
    std::array<std::int64_t, n + 1> rows{};
    std::array<std::int64_t, 2 * n> readers;
    std::array<typename L::Bool, n> few;
    for (std::size_t k = 0; k < n; ++k) {
        rows[k + 1] = rows[k];
        for (std::size_t i = 0; i < n; ++i)
            if (i == k || affected_places[i] == k)
                readers[static_cast<std::size_t>(rows[k + 1]++)] = static_cast<std::int64_t>(i);
        few[k] = typename L::Bool(every != 0 && k % every == every / 2);
    }
    std::array<double, n> chance;
    chance.fill(0.5);
    std::array<typename L::Bool, n> expected, result;
    result.fill(typename L::Bool(true));  // what was there does not count
    const auto body = [&](auto& to) {
        return [&](auto& several, auto x) {
            elements(to, x) = branch(
                several, at(few, x),
                [&] {
                    return sample::valid_bernoulli(several, {0, x}, at(chance, x));
                },
                [&] { return at_places<affected_places>(few, x); });
        };
    };
    Context<L> context = context_of_lanes<L>(), same_context = context_of_lanes<L>();
    for_each_object<n>(context, body(expected));
    for_affected_objects<n>(same_context, few, rows, readers, result, body(result));
    for (std::size_t i = 0; i < n; ++i)
        for (int lane = 0; lane < lanes<L>; ++lane)
            EXPECT_EQ(get_lane(expected[i], lane), get_lane(result[i], lane)) << every << ' ' << i;
}
TEST(ManyObjects, ThatFewBoolsAffect) {
    for (const std::size_t every : {0, 3, 17, 65, 199}) {
        expect_the_affected<Scalar>(every);
        expect_the_affected<Pack<16>>(every);
    }
}

// Callers give any byte but 0 for true; in packs they are masks already.
TEST(ManyObjects, TestTheBytesOfActions) {
    constexpr int n = 100;
    std::array<std::uint8_t, n> given, tested;
    for (std::size_t i = 0; i < n; ++i)
        given[i] = static_cast<std::uint8_t>(i % 3 == 0 ? 0 : 5 * i);
    store_many(is_true(load_many<n>(reinterpret_cast<const bool*>(given.data()))),
               reinterpret_cast<bool*>(tested.data()));
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(tested[i], given[i] != 0) << i;

    std::array<Mask<16>, n> masks, same;
    for (std::size_t i = 0; i < n; ++i) masks[i] = bool_at<Pack<16>>(i);
    store_many(is_true(load_many<n>(masks.data())), same.data());
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(same[i].bits, masks[i].bits) << i;
}

}  // namespace
}  // namespace rddl
