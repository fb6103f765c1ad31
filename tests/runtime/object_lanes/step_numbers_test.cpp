#include <rddl/object_lanes/objects.hpp>
#include <rddl/object_lanes/step_numbers.hpp>

#include <gtest/gtest.h>

#include <array>

namespace rddl {
namespace {

constexpr std::array draws = {counters_of_loop(3), counters_of_draws({{2, 0}, {9, 5}, {4, 1}})};

// Draws have the same numbers as where they are made alone.
template <class R>
void expect_same_numbers(Context<ScalarOf<R>> context) {
    const StepNumbers<ScalarOf<R>, draws> numbers(context);
    for_each_object<5>(context, [&](auto& several, auto object) {
        const auto made = uniform_at(several, place_in_row<0>(numbers, 3, object));
        const auto in_loop = uniform_at(several, place_in_row<0>(numbers, 7, object, 3));
        for (int i = 0; i < 5; ++i) {
            EXPECT_EQ(made[i], uniform_at(context, Place{3, i}));
            EXPECT_EQ(in_loop[i], made[i]);
        }
    });
    for (Index i = 0; i < 5; ++i)
        EXPECT_EQ(uniform_at(context, place_in_row<0>(numbers, 3, i)),
                  uniform_at(context, Place{3, i}));
    EXPECT_EQ(uniform_at(context, place_in_lane<1, 0>(numbers, 2, 0)),
              uniform_at(context, Place{2, 0}));
    EXPECT_EQ(uniform_at(context, place_in_lane<1, 1>(numbers, 9, 5)),
              uniform_at(context, Place{9, 5}));
    EXPECT_EQ(uniform_at(context, place_in_lane<1, 2>(numbers, 8, 1, 4)),
              uniform_at(context, Place{4, 1}));
}

TEST(StepNumbers, AreThoseOfDrawsMadeAlone) {
    expect_same_numbers<double>({stream_key(5, 0, 0), 3, {}});
    expect_same_numbers<double>({median_key, 3, {}});
    expect_same_numbers<float>({stream_key(5, 0, 0), 3, {}});
    expect_same_numbers<float>({median_key, 3, {}});
}

}  // namespace
}  // namespace rddl
