#include <gtest/gtest.h>
#include <render/widgets.hpp>

#include <cmath>

namespace rddl::render {

TEST(Ticks, AreRoundAndWithinTheRange) {
    EXPECT_EQ(ticks(0, 200, 8), (std::vector<double>{0, 50, 100, 150, 200}));
    const std::vector<double> small = ticks(-1.2, 0.6, 4);
    ASSERT_FALSE(small.empty());
    for (const double tick : small) {
        EXPECT_GE(tick, -1.2);
        EXPECT_LE(tick, 0.6);
    }
    for (double high = 1.01; high < 10; high += 0.37)
        EXPECT_GE(ticks(-0.02 * high, high, 1).size(), 2u) << high;
    EXPECT_TRUE(ticks(1, 1, 5).empty());
    EXPECT_TRUE(ticks(0, INFINITY, 5).empty());
    EXPECT_TRUE(ticks(NAN, 1, 5).empty());
}

TEST(Scale, HasWidthEvenForOneNumber) {
    const Scale scale = scale_around(5, 5, 0, 100);
    EXPECT_LT(scale.low, 5);
    EXPECT_GT(scale.high, 5);
    EXPECT_NEAR(scale(5), 50, 1e-9);
    const Scale none = scale_around(1, -1, 0, 100);
    EXPECT_LT(none.low, none.high);
}

TEST(Extent, MovesSeldomAsItGrows) {
    Extent extent;
    int moves = 0;
    double last = NAN;
    for (int k = 0; k <= 1000; ++k) {
        extent.add(k);
        const Extent rounded = extent.rounded();
        EXPECT_LE(rounded.low, extent.low);
        EXPECT_GE(rounded.high, extent.high);
        moves += k > 0 && rounded.high != last;
        last = rounded.high;
    }
    EXPECT_LT(moves, 80);
    EXPECT_EQ(Extent{}.rounded().high, 1);
}

TEST(Shortened, FitsAndKeepsWholeCharacters) {
    const Canvas canvas(600, 400);
    EXPECT_EQ(shortened(canvas, "level", 12, 100), "level");
    const std::string text = shortened(canvas, "ääääääääääääääääääää", 12, 60);
    EXPECT_LE(canvas.text_width(text, 12), 60);
    EXPECT_TRUE(text.ends_with("…"));
    EXPECT_EQ((text.size() - 3) % 2, 0u);
    EXPECT_EQ(shortened(canvas, "level", 12, 1), "");
}

TEST(Shortened, KeepsTheEndsOfNames) {
    const Canvas canvas(600, 400);
    EXPECT_EQ(shortened_name(canvas, "c1", 9, 64), "c1");
    const std::string a = shortened_name(canvas, "reservoir_in_the_north_117", 9, 64);
    const std::string b = shortened_name(canvas, "reservoir_in_the_north_118", 9, 64);
    EXPECT_LE(canvas.text_width(a, 9), 64);
    EXPECT_TRUE(a.starts_with("res") && a.ends_with("117")) << a;
    EXPECT_NE(a, b);
    for (double width = 0; width < 100; width += 3) {  // whole characters
        const std::string text = shortened_name(canvas, "ääääääääääääääääääää", 12, width);
        EXPECT_TRUE(text.empty() || (text.size() - 3) % 2 == 0) << text;
    }
    EXPECT_EQ(shortened_name(canvas, "level", 12, 1), "");
}

TEST(Plane, HasOneScaleInBothDirections) {
    const Plane plane({0, 0, 400, 100}, -1, -1, 1, 1);
    const Point origin = plane(0, 0), x = plane(0.5, 0), y = plane(0, 0.5);
    EXPECT_DOUBLE_EQ(origin.x, 200);
    EXPECT_DOUBLE_EQ(origin.y, 50);
    EXPECT_DOUBLE_EQ(x.x - origin.x, origin.y - y.y);
}

}  // namespace rddl::render
