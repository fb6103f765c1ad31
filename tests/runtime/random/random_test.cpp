#include <rddl/random/random.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <utility>

namespace rddl {
namespace {

Context<Scalar> context_of(std::uint64_t seed, std::uint64_t environment, std::uint64_t episode,
                           std::uint32_t step) {
    return {stream_key(seed, environment, episode), step, {}};
}

TEST(UnitReals, CoverTheIntervalTheyPromise) {
    const std::uint64_t none = 0, all = 0xFFFFFFFF;
    EXPECT_EQ(unit_real(none, none), 0.0);
    EXPECT_EQ(unit_real(all, all), 1.0 - 0x1p-52);
    EXPECT_EQ(unit_real(all << 32, none), 0.0) << "the upper halves are ignored";
    EXPECT_EQ(open_unit_real(unit_real(none, none)), 0x1p-53);
    EXPECT_EQ(open_unit_real(unit_real(all, all)), 1.0 - 0x1p-53);
}

TEST(StreamKeys, DependOnEachOfTheirParts) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> keys;
    const std::uint64_t values[] = {0, 1, 2, 1ull << 32, 1ull << 63, ~0ull};
    for (const auto seed : values)
        for (const auto environment : values)
            for (const auto episode : values) {
                const StreamKey key = stream_key(seed, environment, episode);
                keys.insert({key.low, key.high});
            }
    EXPECT_EQ(keys.size(), 6u * 6u * 6u);
}

// Pinned: a change of these numbers changes every recorded trajectory.
TEST(Draws, AreWhatTheyWere) {
    const StreamKey key = stream_key(42, 7, 3);
    EXPECT_EQ(key.low, 1704915664u);
    EXPECT_EQ(key.high, 3053594036u);
    Draws draws(context_of(42, 7, 3, 5), {11, 13});
    EXPECT_EQ(draws.uniform(), 0.80028379037782216);
    EXPECT_EQ(draws.uniform(), 0.12085953643689962);
    EXPECT_EQ(draws.uniform(), 0.44806561113164434);
}

TEST(Draws, TakeTwoNumbersFromEachCounter) {
    const Context<Scalar> context = context_of(1, 2, 3, 4);
    const auto numbers = [&](std::uint64_t index, std::uint64_t number) {
        const auto words = philox::generate<philox::draw_rounds>(
            philox::Block<std::uint64_t>{4, 5, index, number},
            philox::Key<std::uint64_t>{context.key.low, context.key.high});
        return std::pair(unit_real(words[0], words[1]), unit_real(words[2], words[3]));
    };
    Draws even(context, {5, 6}), odd(context, {5, 7});
    EXPECT_EQ(even.uniform(), numbers(3, 0).first);
    EXPECT_EQ(odd.uniform(), numbers(3, 0).second);
    for (std::uint64_t number = 1; number < 4; ++number) {
        EXPECT_EQ(even.uniform(), numbers(6, number).first);
        EXPECT_EQ(even.uniform(), numbers(6, number).second);
        EXPECT_EQ(odd.uniform(), numbers(7, number).first);
        EXPECT_EQ(odd.uniform(), numbers(7, number).second);
    }
}

TEST(Draws, StartWithTheNumberOfDrawsThatNeedOne) {
    Context<Scalar> context = context_of(1, 2, 3, 4);
    for (const Index index : {0, 1, 2, 3, 15, 16, 17, 1000001, 7, 0}) {
        Draws draws(context, {5, index});
        EXPECT_EQ(uniform_at(context, {5, index}), draws.uniform()) << index;
    }
}

TEST(Draws, HaveTheNumbersOfTheirSeries) {
    Context<Scalar> context = context_of(1, 2, 3, 4);
    EXPECT_EQ(uniform_at(context, {5, 3, 2}), uniform_at(context, {2, 3}));
    EXPECT_NE(uniform_at(context, {5, 3, 2}), uniform_at(context, {5, 3}));
    Draws of_series(context, {5, 3, 2}), of_site(context, {2, 3});
    for (int number = 0; number < 3; ++number) EXPECT_EQ(of_series.uniform(), of_site.uniform());
}

TEST(Draws, AreTheSameHoweverOftenAndInWhateverOrderTheyAreMade) {
    Context<Scalar> context = context_of(1, 2, 3, 4);
    const double first = uniform_at(context, {0, 0});
    const double second = uniform_at(context, {1, 0});
    EXPECT_NE(first, second);
    EXPECT_EQ(uniform_at(context, {1, 0}), second);
    EXPECT_EQ(uniform_at(context, {0, 0}), first);
}

using Sixteen = Pack<16>;

Context<Sixteen> context_of_sixteen() {
    Sixteen::Word low, high, step;
    for (int lane = 0; lane < 16; ++lane) {
        const StreamKey key = stream_key(1, static_cast<std::uint64_t>(lane), 3);
        low.set(lane, key.low);
        high.set(lane, key.high);
        step.set(lane, static_cast<std::uint64_t>(lane) + 1);
    }
    return Context<Sixteen>::of(low, high, step, true);
}

TEST(Draws, OfPacksAreThoseOfTheirLanes) {
    auto context = context_of_sixteen();
    const auto expect_same = [&](const Lanes<double, 16>& numbers, Place place) {
        for (int lane = 0; lane < 16; ++lane) {
            Draws draws(context.key(lane), static_cast<std::uint32_t>(lane) + 1, place);
            EXPECT_EQ(numbers[lane], draws.uniform()) << place.index << " in lane " << lane;
        }
    };
    for (const Index index : {0, 1, 2, 3, 4, 7, 6, 5, 1000001, 1000003, 0})
        expect_same(uniform_at(context, {5, index, 2}), {5, index, 2});
    for (const Index index : {0, 1, 2}) expect_same(uniform_at(context, {6, index}), {6, index});
    expect_same(uniform_at(context, {6, 3}), {6, 3});  // of an index that the compiler knows
    expect_same(uniform_at(context, {6, 0}), {6, 0});
    expect_same(uniform_at(context, {6, 1}), {6, 1});
}

// The first three are made for all lanes at once.
TEST(Draws, OfSeveralNumbersInPacksAreThoseOfTheirLanes) {
    const auto context = context_of_sixteen();
    Mask<16> valid{true};
    valid.set(5, false);
    for (const Index index : {0, 1, 2, 1000001}) {
        const Place place{7, index, 2};
        for (int count = 1; count <= 8; ++count) {
            const auto last = [count](Draws& draws) {
                for (int i = 1; i < count; ++i) draws.uniform();
                return draws.uniform();
            };
            const Lanes<double, 16> numbers = draw_in_each_lane(context, place, valid, last);
            for (int lane = 0; lane < 16; ++lane) {
                Draws draws(context.key(lane), static_cast<std::uint32_t>(lane) + 1, place);
                EXPECT_EQ(numbers[lane], valid[lane] ? last(draws) : 0.0)
                    << count << " of index " << index << " in lane " << lane;
            }
        }
    }
}

}  // namespace
}  // namespace rddl
