#include <rddl/random.hpp>

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
    EXPECT_EQ(unit_real(0), 0.0);
    EXPECT_EQ(unit_real(~std::uint64_t{0}), 1.0 - 0x1p-53);
    EXPECT_EQ(open_unit_real(0), 0x1p-53);
    EXPECT_EQ(open_unit_real(~std::uint64_t{0}), 1.0 - 0x1p-53);
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
    EXPECT_EQ(draws.uniform(), 0.36776241941931453);
    EXPECT_EQ(draws.uniform(), 0.5572804209662372);
    EXPECT_EQ(draws.uniform(), 0.36071073076087223);
}

TEST(Draws, TakeTwoNumbersFromEachCounter) {
    const Context<Scalar> context = context_of(1, 2, 3, 4);
    const auto block = [&](std::uint32_t number) {
        return philox::generate({4, 5, 6, number}, {context.key.low, context.key.high});
    };
    Draws draws(context, {5, 6});
    for (std::uint32_t number = 0; number < 3; ++number) {
        const philox::Block words = block(number);
        EXPECT_EQ(draws.uniform(), unit_real(std::uint64_t{words[1]} << 32 | words[0]));
        EXPECT_EQ(draws.uniform(), unit_real(std::uint64_t{words[3]} << 32 | words[2]));
    }
}

TEST(Draws, AreTheSameHoweverOftenAndInWhateverOrderTheyAreMade) {
    const Context<Scalar> context = context_of(1, 2, 3, 4);
    const double first = uniform_at(context, {0, 0});
    const double second = uniform_at(context, {1, 0});
    EXPECT_NE(first, second);
    EXPECT_EQ(uniform_at(context, {1, 0}), second);
    EXPECT_EQ(uniform_at(context, {0, 0}), first);
}

}  // namespace
}  // namespace rddl
