#include <rddl/lanes/pack.hpp>
#include <rddl/step/step_counts.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

namespace rddl {
namespace {

constexpr int lanes = 16;

// A number for each lane.
struct Plain {
    std::array<std::int64_t, lanes> steps{};

    Mask<lanes> count(Mask<lanes> some, std::int64_t horizon) {
        Mask<lanes> late{false};
        for (int lane = 0; lane < lanes; ++lane) {
            if (!some[lane]) continue;
            std::int64_t& its = steps[static_cast<std::size_t>(lane)];
            late.set(lane, ++its >= horizon);
        }
        return late;
    }
};

void compare(std::int64_t horizon, int seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    StepCounts<Pack<lanes>> counts;
    Plain plain;
    for (int time = 0; time < 2000; ++time) {
        auto some = Mask<lanes>::of_bits(random());
        const bool are_all = random() % 4 != 0;
        if (are_all) some = Mask<lanes>{true};
        const auto expected = plain.count(some, horizon);
        const auto late = are_all ? counts.count_all(horizon) : counts.count(some, horizon);
        ASSERT_EQ(late.bits, expected.bits) << "horizon " << horizon << ", time " << time;
        auto begun = random() % 8 == 0 ? Mask<lanes>::of_bits(random()) : Mask<lanes>{false};
        for (int lane = 0; lane < lanes; ++lane)
            if (plain.steps[static_cast<std::size_t>(lane)] >= horizon) begun.set(lane, true);
        counts.begin(begun);
        const int set = static_cast<int>(random() % (8 * lanes));
        const auto number = static_cast<std::int64_t>(random() % 50);
        if (set < lanes) counts.set(set, number);
        for (int lane = 0; lane < lanes; ++lane) {
            std::int64_t& its = plain.steps[static_cast<std::size_t>(lane)];
            if (begun[lane]) its = 0;
            if (lane == set) its = number;
            ASSERT_EQ(counts.of(lane), its);
            ASSERT_EQ(counts.all()[lane], its);
        }
    }
}

TEST(StepCounts, OfPacksAreThoseOfEachLane) {
    int seed = 0;
    for (const std::int64_t horizon : {1, 2, 7, 40, 1000}) compare(horizon, ++seed);
    compare(std::numeric_limits<std::int64_t>::max(), ++seed);
}

TEST(StepCounts, HoldAnyNumber) {
    StepCounts<Pack<lanes>> counts;
    for (const std::int64_t number : {std::int64_t{0}, std::numeric_limits<std::int64_t>::max()}) {
        counts.count_all(5);
        counts.set(3, number);
        EXPECT_EQ(counts.of(3), number);
    }
}

}  // namespace
}  // namespace rddl
