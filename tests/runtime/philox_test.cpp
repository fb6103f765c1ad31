// Known answers and agreement with the authors' own implementation.
#include <rddl/philox.hpp>
#include <rddl/random.hpp>

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace rddl::philox {
namespace {

// The published vectors of Random123 1.14 (kat_vectors, philox4x32 10).
TEST(Philox, GivesThePublishedKnownAnswers) {
    EXPECT_EQ(generate({0, 0, 0, 0}, {0, 0}),
              (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(generate({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
              (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(generate({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, AgreesWithRandom123) {
    std::mt19937 words(1);
    for (int i = 0; i < 10000; ++i) {
        philox4x32_ctr_t counter;
        philox4x32_key_t key;
        for (auto& word : counter.v) word = static_cast<std::uint32_t>(words());
        for (auto& word : key.v) word = static_cast<std::uint32_t>(words());
        const philox4x32_ctr_t expected = philox4x32(counter, key);
        const Block found = generate({counter.v[0], counter.v[1], counter.v[2], counter.v[3]},
                                     {key.v[0], key.v[1]});
        for (std::size_t k = 0; k < 4; ++k) ASSERT_EQ(found[k], expected.v[k]);
    }
}

static_assert(generate({0, 0, 0, 0}, {0, 0})[0] == 0x6627e8d5, "usable in constant expressions");

}  // namespace
}  // namespace rddl::philox
