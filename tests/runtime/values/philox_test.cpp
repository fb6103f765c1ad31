// Known answers and agreement with the authors' own implementation.
#include <rddl/random/random.hpp>
#include <rddl/values/philox.hpp>

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>

namespace rddl::philox {
namespace {

using Words = std::array<std::uint32_t, 4>;

template <int rounds>
Words words_of(const Words& counter, const std::array<std::uint32_t, 2>& key) {
    const auto block =
        generate<rounds>(Block<std::uint64_t>{counter[0], counter[1], counter[2], counter[3]},
                         Key<std::uint64_t>{key[0], key[1]});
    Words words{};
    for (std::size_t i = 0; i < 4; ++i) words[i] = static_cast<std::uint32_t>(block[i]);
    return words;
}

// The published vectors of Random123 1.14 (kat_vectors, philox4x32 10).
TEST(Philox, GivesThePublishedKnownAnswers) {
    EXPECT_EQ(words_of<10>({0, 0, 0, 0}, {0, 0}),
              (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(words_of<10>({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
              (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(
        words_of<10>({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
        (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

template <int rounds>
void expect_random123() {
    std::mt19937 random(1);
    for (int i = 0; i < 10000; ++i) {
        philox4x32_ctr_t counter;
        philox4x32_key_t key;
        for (auto& word : counter.v) word = static_cast<std::uint32_t>(random());
        for (auto& word : key.v) word = static_cast<std::uint32_t>(random());
        const philox4x32_ctr_t expected = philox4x32_R(rounds, counter, key);
        const Words found = words_of<rounds>(
            {counter.v[0], counter.v[1], counter.v[2], counter.v[3]}, {key.v[0], key.v[1]});
        for (std::size_t k = 0; k < 4; ++k) ASSERT_EQ(found[k], expected.v[k]);
    }
}

TEST(Philox, AgreesWithRandom123) {
    expect_random123<draw_rounds>();
    expect_random123<key_rounds>();
}

TEST(Philox, IsTheSameInEveryLane) {
    using Word = Lanes<std::uint64_t, 8>;
    const auto word = [](std::uint64_t first) {
        Word lanes{};
        for (int lane = 0; lane < 8; ++lane) lanes.set(lane, first * 0x9E3779B97F4A7C15 + lane);
        return lanes;
    };
    const Block<Word> counter{word(1), word(2), word(3), word(4)};
    const Key<Word> key{word(5), word(6)};
    const Block<Word> found = generate<draw_rounds>(counter, key);
    for (int lane = 0; lane < 8; ++lane) {
        const auto expected =
            generate<draw_rounds>(Block<std::uint64_t>{counter[0][lane], counter[1][lane],
                                                       counter[2][lane], counter[3][lane]},
                                  Key<std::uint64_t>{key[0][lane], key[1][lane]});
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_EQ(static_cast<std::uint32_t>(found[k][lane]),
                      static_cast<std::uint32_t>(expected[k]));
    }
}

TEST(Philox, MakesBlocksOfOneKeyAndFirstWordTogether) {
    using Word = Lanes<std::uint64_t, 16>;
    const Word none{std::uint64_t{0}};
    Word first, key_low, key_high;
    for (int lane = 0; lane < 16; ++lane) {
        first.set(lane, 0xFFFFFFF0u + lane);  // of which the lower half counts
        key_low.set(lane, 0x9E3779B9u * lane);
        key_high.set(lane, 0xFFFFFFFFu - lane);
    }
    const Schedule<draw_rounds, Word> schedule(first, {key_low, key_high});
    for (const std::uint64_t third : {0u, 1u, 77u, 0xFFFFFFFEu}) {
        const std::uint64_t second = 0xFFFFFFFF - third / 2;
        const auto expected = [&](std::uint64_t its_third) {
            return generate<draw_rounds>(Block<Word>{first, Word{second}, Word{its_third}, none},
                                         {key_low, key_high});
        };
        Block<Word> alone, neighbours[2];
        schedule.generate(second, third, alone);
        schedule.generate(second, third, neighbours);
        for (int lane = 0; lane < 16; ++lane)
            for (std::size_t k = 0; k < 4; ++k) {
                const auto lower_half = [&](const Block<Word>& words) {
                    return static_cast<std::uint32_t>(words[k][lane]);
                };
                EXPECT_EQ(lower_half(alone), lower_half(expected(third)));
                EXPECT_EQ(lower_half(neighbours[0]), lower_half(expected(third)));
                EXPECT_EQ(lower_half(neighbours[1]), lower_half(expected(third + 1)));
            }
    }
}

}  // namespace
}  // namespace rddl::philox
