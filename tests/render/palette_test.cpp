#include <gtest/gtest.h>
#include <render/palette.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace rddl::render {

namespace {

std::uint32_t gray(unsigned level) {
    return level << 16 | level << 8 | level;
}

// A smooth picture of 128 x 128 colours, all different.
std::vector<std::uint32_t> gradient() {
    std::vector<std::uint32_t> pixels;
    for (unsigned y = 0; y < 128; ++y)
        for (unsigned x = 0; x < 128; ++x) pixels.push_back(2 * x << 16 | 2 * y << 8 | 64);
    return pixels;
}

double distance(std::uint32_t a, std::uint32_t b) {
    double sum = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        const double d =
            static_cast<int>((a >> shift) & 0xff) - static_cast<int>((b >> shift) & 0xff);
        sum += d * d;
    }
    return std::sqrt(sum);
}

}  // namespace

TEST(Palette, HoldsEveryColourWhereTheyAreFew) {
    std::vector<std::uint32_t> pixels;
    for (unsigned level = 0; level < 256; ++level)
        pixels.insert(pixels.end(), level + 1, gray(level));
    const Palette palette(pixels, 256);
    EXPECT_TRUE(palette.is_exact());
    EXPECT_EQ(palette.colors().size(), 256u);
    for (const std::uint32_t pixel : pixels)
        EXPECT_EQ(palette.colors()[palette.index_of(pixel)], pixel);
}

TEST(Palette, IsNotExactWithOneColourTooMany) {
    std::vector<std::uint32_t> pixels;
    for (unsigned level = 0; level < 256; ++level) pixels.push_back(gray(level));
    const Palette palette(pixels, 255);
    EXPECT_FALSE(palette.is_exact());
    EXPECT_EQ(palette.colors().size(), 255u);
    // One pair of neighbours shares a colour; all others have their own.
    std::set<int> used;
    for (const std::uint32_t pixel : pixels) {
        used.insert(palette.index_of(pixel));
        EXPECT_LE(distance(palette.colors()[palette.index_of(pixel)], pixel), 2);
    }
    EXPECT_EQ(used.size(), 255u);
}

TEST(Palette, ChoosesColoursThatAreNear) {
    const std::vector<std::uint32_t> pixels = gradient();
    const Palette palette(pixels, 255);
    double worst = 0, sum = 0;
    for (const std::uint32_t pixel : pixels) {
        const double error = distance(palette.colors()[palette.index_of(pixel)], pixel);
        worst = std::max(worst, error);
        sum += error;
    }
    // 256 squares of 16 x 16 levels would have a mean error of about 6.1 and a worst one of 11.3.
    EXPECT_LT(sum / static_cast<double>(pixels.size()), 8);
    EXPECT_LT(worst, 25);
}

TEST(Palette, KeepsRareColoursApart) {
    std::vector<std::uint32_t> pixels = gradient();
    pixels.push_back(0x0000ff);  // one pixel of a colour of its own
    const Palette palette(pixels, 256);
    EXPECT_LT(distance(palette.colors()[palette.index_of(0x0000ff)], 0x0000ff), 60);
}

TEST(Palette, OfNothingIsEmpty) {
    const Palette palette({}, 255);
    EXPECT_TRUE(palette.is_exact());
    EXPECT_TRUE(palette.colors().empty());
}

}  // namespace rddl::render
