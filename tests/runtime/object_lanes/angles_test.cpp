// Sines and cosines that are computed together have the bits of those computed alone. Also built
// for other instruction sets (CMakeLists.txt).
#include <rddl/object_lanes/angles.hpp>
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace rddl {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Each angle has a sine and a cosine.
template <std::size_t count, class R = double>
void expect_those_computed_alone(const std::array<R, count>& angles) {
    std::array<R, 2 * count> values;
    [&]<std::size_t... k>(std::index_sequence<k...>) {
        evaluate_together(values, sine_of(angles[k])..., cosine_of(angles[k])...);
    }
    (std::make_index_sequence<count>());
    for (std::size_t k = 0; k < count; ++k) {
        EXPECT_EQ(bits_of(values[k]), bits_of(sin(angles[k]))) << angles[k];
        EXPECT_EQ(bits_of(values[count + k]), bits_of(cos(angles[k]))) << angles[k];
    }
}

TEST(Angles, HaveTheBitsOfThoseComputedAlone) {
    expect_those_computed_alone<1>({0.3});
    expect_those_computed_alone<4>({0.0, -0.0, 0x1p-28, -0x1p-30});
    expect_those_computed_alone<5>({0x1p-27, 1.5707963267948966, 3.1, -4.7, 0x1p20});
    expect_those_computed_alone<3>({0.5, infinity, 1.0});
    expect_those_computed_alone<6>({1e-300, -1e300, 0x1.000002p20, 12.0, -77.5, 2.0});
    expect_those_computed_alone<4>({0x1p24, 3.0, -0x1.8p22, -0x1p24});
    expect_those_computed_alone<3>({0x1.000002p24, 3.0, 0.1});
    std::array<double, 8> angles;
    for (int first = 0; first < 200; ++first) {
        for (std::size_t k = 0; k < angles.size(); ++k)
            angles[k] = -60.0 + 0.6180339887 * static_cast<double>(first) + static_cast<double>(k);
        expect_those_computed_alone(angles);
    }
}

TEST(Angles, HaveTheBitsOfFloatsComputedAlone) {
    expect_those_computed_alone<4, float>({0.0f, -0.0f, 0x1p-13f, -0x1p-12f});
    expect_those_computed_alone<5, float>({1.57079633f, 3.1f, -4.7f, 0x1p13f, -8000.0f});
    expect_those_computed_alone<3, float>({0.5f, 0x1.02p13f, 1.0f});
    expect_those_computed_alone<4, float>({0x1p24f, 3.0f, -1e6f, 0x1p-20f});
    expect_those_computed_alone<3, float>({0x1.000002p24f, 3.0f, 1e4f});
    std::array<float, 8> angles;
    for (int first = 0; first < 200; ++first) {
        for (std::size_t k = 0; k < angles.size(); ++k)
            angles[k] = -60.0f + 0.618034f * static_cast<float>(first) + static_cast<float>(k);
        expect_those_computed_alone(angles);
    }
}

TEST(Angles, MayBeNoNumbers) {
    std::array<double, 3> values;
    evaluate_together(values, sine_of(infinity - infinity), cosine_of(0.0), sine_of(1.0));
    EXPECT_NE(values[0], values[0]);
    EXPECT_EQ(values[1], 1);
    EXPECT_EQ(values[2], sin(1.0));
}

TEST(Angles, AreThoseOfEachEnvironmentInPacks) {
    Lanes<double, 8> angle;
    for (int lane = 0; lane < 8; ++lane) angle.set(lane, 0.7 * lane);
    std::array<Lanes<double, 8>, 2> values;
    evaluate_together(values, sine_of(angle), cosine_of(angle));
    std::array<float, 2> floats;
    evaluate_together(floats, sine_of(0.5f), cosine_of(0.5f));
    for (int lane = 0; lane < 8; ++lane) {
        EXPECT_EQ(values[0][lane], sin(angle[lane]));
        EXPECT_EQ(values[1][lane], cos(angle[lane]));
    }
    EXPECT_EQ(floats[0], sin(0.5f));
    EXPECT_EQ(floats[1], cos(0.5f));
}

}  // namespace
}  // namespace rddl
