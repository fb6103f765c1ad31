#include <gtest/gtest.h>
#include <render/canvas.hpp>

#include <cmath>
#include <vector>

namespace rddl::render {

namespace {

std::uint32_t at(const Picture& picture, int x, int y) {
    return picture.row(y)[x];
}

}  // namespace

TEST(Canvas, HasAtLeast600By400PointsWhateverItsPixels) {
    const Box usual = Canvas(600, 400).area(), small = Canvas(300, 200).area();
    EXPECT_EQ(usual.width, 600);
    EXPECT_EQ(usual.height, 400);
    EXPECT_EQ(small.width, 600);
    const Box wide = Canvas(1600, 400).area(), high = Canvas(600, 900).area();
    EXPECT_EQ(wide.width, 1600);
    EXPECT_EQ(wide.height, 400);
    EXPECT_EQ(high.height, 900);
}

TEST(Canvas, RefusesSizesThatNobodyMeans) {
    EXPECT_THROW(Canvas(15, 400), Error);
    EXPECT_THROW(Canvas(600, 8193), Error);
    EXPECT_THROW(Canvas(-1, -1), Error);
    EXPECT_THROW(Canvas::svg(0, 10), Error);
}

TEST(Canvas, FillsWhatItIsAskedTo) {
    Canvas canvas(600, 400);
    canvas.clear(colors::white);
    canvas.fill({100, 100, 50, 30}, colors::vermilion);
    Picture picture;
    canvas.read(picture);
    EXPECT_EQ(at(picture, 99, 110), 0xffffffu);
    EXPECT_EQ(at(picture, 100, 100), 0xd55e00u);
    EXPECT_EQ(at(picture, 149, 129), 0xd55e00u);
    EXPECT_EQ(at(picture, 150, 110), 0xffffffu);
}

TEST(Canvas, DrawsCellsWithoutBlurringThem) {
    Canvas canvas(600, 400);
    canvas.clear(colors::white);
    const std::uint32_t cells[] = {0xff0000, 0x00ff00, 0x0000ff, 0x123456};
    canvas.cells({100, 100, 40, 20}, 2, 2, cells);
    Picture picture;
    canvas.read(picture);
    EXPECT_EQ(at(picture, 119, 109), 0xff0000u);
    EXPECT_EQ(at(picture, 120, 109), 0x00ff00u);
    EXPECT_EQ(at(picture, 119, 110), 0x0000ffu);
    EXPECT_EQ(at(picture, 139, 119), 0x123456u);
}

TEST(Canvas, AveragesCellsOfWhichThereAreMoreThanPixels) {
    Canvas canvas(600, 400);
    canvas.clear(colors::white);
    // Four rows in two pixels: red and blue, then green twice. The columns stay as sharp as ever.
    const std::uint32_t cells[] = {0xff0000, 0, 0x0000ff, 0, 0x00ff00, 0, 0x00ff00, 0};
    canvas.cells({100, 100, 40, 2}, 2, 4, cells);
    Picture picture;
    canvas.read(picture);
    EXPECT_EQ(at(picture, 119, 100), 0x800080u);
    EXPECT_EQ(at(picture, 120, 100), 0x000000u);
    EXPECT_EQ(at(picture, 119, 101), 0x00ff00u);
    // The same with many columns: 3,000 cells of which each third is white.
    std::vector<std::uint32_t> many(3000);
    for (std::size_t i = 0; i < many.size(); i += 3) many[i] = 0xffffff;
    canvas.cells({0, 200, 500, 1}, 3000, 1, many);
    canvas.read(picture);
    for (int x = 0; x < 500; ++x) EXPECT_EQ(at(picture, x, 200), 0x555555u) << x;
}

TEST(Canvas, GoesOnAfterWhatIsNoNumberAndWhatIsFarOff) {
    Canvas canvas(600, 400);
    for (const double odd : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300, -1e300, 0.0}) {
        canvas.clear(colors::white);
        {
            const Canvas::Saved saved = canvas.moved({odd, 0}, odd, odd);
            canvas.fill({0, 0, 10, 10}, colors::ink);
        }
        canvas.ring({0, 0}, odd, colors::ink, odd);
        canvas.disc({odd, odd}, odd, colors::ink);
        canvas.arc({300, 200}, 10, 0, odd, colors::ink);
        canvas.line({odd, 0}, {0, odd}, colors::ink, odd);
        canvas.outline({odd, odd, odd, odd}, colors::ink, 1, odd);
        canvas.text({odd, odd}, "a", {.size = odd, .turn = odd});
        const std::uint32_t cell = 0;
        canvas.cells({odd, 0, odd, odd}, 1, 1, {&cell, 1});
        { const Canvas::Saved saved = canvas.clipped({odd, odd, odd, odd}); }
        canvas.fill({100, 100, 50, 30}, colors::vermilion);
        Picture picture;
        canvas.read(picture);
        EXPECT_EQ(at(picture, 120, 110), 0xd55e00u) << odd;
    }
    // A line with an end that is nan is not drawn, and changes nothing on the canvas.
    canvas.clear(colors::white);
    canvas.line({100, 100}, {std::nan(""), 100}, colors::ink, 9);
    canvas.disc({100, std::nan("")}, 50, colors::ink);
    Picture picture;
    canvas.read(picture);
    for (const std::uint32_t pixel : picture.pixels) ASSERT_EQ(pixel, 0xffffffu);
}

TEST(Canvas, WritesTextInTheFontThatIsBuiltIn) {
    Canvas canvas(600, 400);
    // DejaVu Sans: the advance of "m" is 1995 of 2048 units, that of "i" 569.
    EXPECT_NEAR(canvas.text_width("m", 100), 97.4, 0.3);
    EXPECT_NEAR(canvas.text_width("i", 100), 27.8, 0.3);
    canvas.clear(colors::white);
    canvas.text({300, 200}, "MMM", {.size = 40, .color = colors::black, .align = Align::Center});
    Picture picture;
    canvas.read(picture);
    int left = 600, right = 0, top = 400, bottom = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 600; ++x)
            if (at(picture, x, y) < 0x808080) {
                left = std::min(left, x), right = std::max(right, x);
                top = std::min(top, y), bottom = std::max(bottom, y);
            }
    EXPECT_NEAR((left + right) / 2.0, 300, 1.5);
    EXPECT_NEAR((top + bottom) / 2.0, 200, 1.5);
    EXPECT_NEAR(bottom - top, 0.73 * 40, 1.5);
}

TEST(Canvas, GivesTheSamePixelsAgain) {
    const auto draw = [] {
        Canvas canvas(300, 200);
        canvas.clear(colors::white);
        canvas.text({40, 40}, "reservoir", {.size = 20});
        canvas.disc({200, 200}, 33.3, colors::sky);
        Picture picture;
        canvas.read(picture);
        return picture.pixels;
    };
    EXPECT_EQ(draw(), draw());
}

TEST(Canvas, KeepsWhatIsMovedWithinItsBlock) {
    Canvas canvas(600, 400);
    canvas.clear(colors::white);
    {
        const Canvas::Saved moved = canvas.moved({300, 200}, 0, 2);
        canvas.fill({0, 0, 10, 10}, colors::black);
    }
    canvas.fill({0, 0, 10, 10}, colors::blue);
    Picture picture;
    canvas.read(picture);
    EXPECT_EQ(at(picture, 319, 219), 0u);
    EXPECT_EQ(at(picture, 320, 219), 0xffffffu);
    EXPECT_EQ(at(picture, 5, 5), 0x0072b2u);
}

TEST(Canvas, MakesVectorGraphics) {
    Canvas canvas = Canvas::svg(600, 400);
    canvas.clear(colors::white);
    canvas.text({40, 40}, "level");
    const std::string text = canvas.finish_svg();
    EXPECT_TRUE(text.starts_with("<?xml"));
    EXPECT_NE(text.find("<svg"), std::string::npos);
    EXPECT_TRUE(text.ends_with("</svg>\n"));
    // Letters are outlines, so that no reader needs the font.
    EXPECT_EQ(text.find("font-family"), std::string::npos);
}

TEST(Color, TextIsReadableOnEveryGround) {
    EXPECT_EQ(pixel_of(text_on(colors::white)), pixel_of(colors::ink));
    EXPECT_EQ(pixel_of(text_on(colors::yellow)), pixel_of(colors::ink));
    EXPECT_EQ(pixel_of(text_on(colors::blue)), pixel_of(colors::white));
    EXPECT_EQ(pixel_of(text_on(sequential_color(1))), pixel_of(colors::white));
}

TEST(Color, ScalesGetDarkerAllTheWay) {
    const auto light = [](Color c) {
        return 0.3 * c.red + 0.59 * c.green + 0.11 * c.blue;
    };
    for (int k = 0; k < 20; ++k)
        EXPECT_GT(light(sequential_color(k / 20.0)), light(sequential_color((k + 1) / 20.0)));
    EXPECT_EQ(pixel_of(sequential_color(0.0 / 0.0)), pixel_of(colors::rule));
}

}  // namespace rddl::render
