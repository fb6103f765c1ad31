#include <rddl/object_lanes/objects.hpp>
#include <rddl/object_lanes/step_normals.hpp>

#include <gtest/gtest.h>

#include <array>

namespace rddl {
namespace {

// Odd and even counts, one of a register and some, and all together in an odd number of registers.
constexpr std::array loops = {LoopOfNormals{3, 5}, LoopOfNormals{7, 40}, LoopOfNormals{1, 2}};
constexpr std::array few = {LoopOfNormals{3, 3}, LoopOfNormals{0, 2}};

template <class R, const auto& loops, std::size_t loop>
void expect_normals_of_loop(Context<ScalarOf<R>>& context,
                            const StepNormals<ScalarOf<R>, loops>& normals) {
    constexpr LoopOfNormals drawn = loops[loop];
    for_each_object<drawn.count>(context, [&]<int n>(auto& several, const SomeObjects<n>& objects) {
        const auto made = standard_at<StandardNormal>(
            several,
            place_of_normals<loop>(normals, PlaceAmong<drawn.count>{9, objects, drawn.series}));
        for (int i = 0; i < objects.count; ++i)
            EXPECT_EQ(made[i], StandardNormal::of(uniform_at(
                                   context, LonePlace{9, objects.first + i, drawn.series})));
    });
}
template <class R>
void expect_same_normals(Context<ScalarOf<R>> context) {
    const StepNormals<ScalarOf<R>, loops> normals(context);
    expect_normals_of_loop<R, loops, 0>(context, normals);
    expect_normals_of_loop<R, loops, 1>(context, normals);
    expect_normals_of_loop<R, loops, 2>(context, normals);
    const StepNormals<ScalarOf<R>, few> normals_of_few(context);
    expect_normals_of_loop<R, few, 0>(context, normals_of_few);
    expect_normals_of_loop<R, few, 1>(context, normals_of_few);
}

TEST(StepNormals, AreThoseOfDrawsMadeAlone) {
    for (std::uint32_t step = 0; step < 20; ++step) {
        expect_same_normals<double>({stream_key(5, 0, 0), step, {}});
        expect_same_normals<float>({stream_key(5, 0, 0), step, {}});
    }
    expect_same_normals<double>({median_key, 3, {}});
    expect_same_normals<float>({median_key, 3, {}});
}

}  // namespace
}  // namespace rddl
