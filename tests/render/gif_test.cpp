// Movies, read back by giflib's decoder and put together as a player does.
#include <gif_lib.h>
#include <gtest/gtest.h>
#include <png.h>
#include <render/canvas.hpp>
#include <render/gif.hpp>
#include <render/png.hpp>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace rddl::render {

namespace {

struct Movie {
    std::vector<Picture> frames;
    std::vector<int> hundredths;
    std::vector<std::size_t> stored;  // pixels of each frame's rectangle
};

struct Bytes {
    std::string_view text;
    std::size_t place = 0;
};

int read_bytes(GifFileType* file, GifByteType* to, int size) {
    auto& bytes = *static_cast<Bytes*>(file->UserData);
    const std::size_t count =
        std::min(static_cast<std::size_t>(size), bytes.text.size() - bytes.place);
    std::memcpy(to, bytes.text.data() + bytes.place, count);
    bytes.place += count;
    return static_cast<int>(count);
}

Movie decode(std::string_view text) {
    Movie movie;
    Bytes bytes{text};
    int error = 0;
    GifFileType* const file = DGifOpen(&bytes, read_bytes, &error);
    EXPECT_TRUE(file) << GifErrorString(error);
    EXPECT_EQ(DGifSlurp(file), GIF_OK);
    Picture canvas{file->SWidth, file->SHeight, {}};
    canvas.pixels.resize(static_cast<std::size_t>(canvas.width * canvas.height));
    for (int k = 0; k < file->ImageCount; ++k) {
        const SavedImage& image = file->SavedImages[k];
        GraphicsControlBlock control;
        EXPECT_EQ(DGifSavedExtensionToGCB(file, k, &control), GIF_OK);
        const GifImageDesc& box = image.ImageDesc;
        for (int y = 0; y < box.Height; ++y)
            for (int x = 0; x < box.Width; ++x) {
                const int index = image.RasterBits[y * box.Width + x];
                if (index == control.TransparentColor) continue;
                const GifColorType color = box.ColorMap->Colors[index];
                canvas
                    .pixels[static_cast<std::size_t>((box.Top + y) * canvas.width + box.Left + x)] =
                    static_cast<std::uint32_t>(color.Red << 16 | color.Green << 8 | color.Blue);
            }
        movie.frames.push_back(canvas);
        movie.hundredths.push_back(control.DelayTime);
        movie.stored.push_back(static_cast<std::size_t>(box.Width * box.Height));
    }
    DGifCloseFile(file, &error);
    return movie;
}

std::string movie_of(const std::vector<Picture>& frames, double seconds) {
    std::string bytes;
    GifWriter writer(frames[0].width, frames[0].height,
                     [&](std::string_view more) { bytes += more; });
    for (const Picture& frame : frames) writer.add(frame, seconds);
    writer.finish();
    return bytes;
}

// A disc on its way over white.
std::vector<Picture> moving_disc(int count) {
    std::vector<Picture> frames(static_cast<std::size_t>(count));
    Canvas canvas(120, 80);
    for (int k = 0; k < count; ++k) {
        canvas.clear(colors::white);
        canvas.disc({60.0 + 25 * k, 200}, 50, colors::blue);
        canvas.read(frames[static_cast<std::size_t>(k)]);
    }
    return frames;
}

}  // namespace

TEST(Gif, GivesBackEveryPixelOfFewColours) {
    const std::vector<Picture> frames = moving_disc(8);
    const Movie movie = decode(movie_of(frames, 0.1));
    ASSERT_EQ(movie.frames.size(), 8u);
    for (std::size_t k = 0; k < frames.size(); ++k)
        EXPECT_EQ(movie.frames[k].pixels, frames[k].pixels) << "frame " << k;
}

TEST(Gif, StoresOnlyWhatChanges) {
    const Movie movie = decode(movie_of(moving_disc(8), 0.1));
    EXPECT_EQ(movie.stored[0], 120u * 80u);
    for (std::size_t k = 1; k < movie.stored.size(); ++k)
        EXPECT_LT(movie.stored[k], 120u * 80u / 4);
}

TEST(Gif, KeepsFramesThatAreAlike) {
    const std::vector<Picture> frames(3, moving_disc(1)[0]);
    const Movie movie = decode(movie_of(frames, 0.1));
    ASSERT_EQ(movie.frames.size(), 3u);
    EXPECT_EQ(movie.stored[2], 1u);
    EXPECT_EQ(movie.frames[2].pixels, frames[2].pixels);
}

TEST(Gif, MakesGoodForRoundedTimes) {
    const Movie movie = decode(movie_of(std::vector<Picture>(30, moving_disc(1)[0]), 1.0 / 30));
    int sum = 0;
    for (const int hundredths : movie.hundredths) {
        EXPECT_GE(hundredths, 3);
        EXPECT_LE(hundredths, 4);
        sum += hundredths;
    }
    EXPECT_EQ(sum, 100);
}

TEST(Gif, ComesNearToManyColours) {
    Picture picture{128, 128, {}};
    for (unsigned y = 0; y < 128; ++y)
        for (unsigned x = 0; x < 128; ++x) picture.pixels.push_back(2 * x << 16 | 2 * y << 8);
    const Movie movie = decode(movie_of({picture}, 0.1));
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        for (int shift = 0; shift < 24; shift += 8) {
            const int wanted = static_cast<int>((picture.pixels[i] >> shift) & 0xff);
            const int found = static_cast<int>((movie.frames[0].pixels[i] >> shift) & 0xff);
            ASSERT_LE(std::abs(wanted - found), 24);
        }
}

TEST(Gif, PassesOnWhatTheSinkThrows) {
    GifWriter writer(120, 80, [](std::string_view) { throw Error("no room"); });
    EXPECT_THROW(writer.add(moving_disc(1)[0], 0.1), Error);
}

TEST(Gif, RefusesFramesOfAnotherSize) {
    GifWriter writer(100, 80, [](std::string_view) {});
    EXPECT_THROW(writer.add(moving_disc(1)[0], 0.1), Error);
}

namespace {

Picture decode_png(const std::string& bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
    image.format = PNG_FORMAT_RGB;
    std::vector<png_byte> rows(PNG_IMAGE_SIZE(image));
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, rows.data(), 0, nullptr)) << image.message;
    Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
    for (std::size_t i = 0; i + 2 < rows.size(); i += 3)
        picture.pixels.push_back(
            static_cast<std::uint32_t>(rows[i] << 16 | rows[i + 1] << 8 | rows[i + 2]));
    return picture;
}

}  // namespace

TEST(Png, GivesBackEveryPixelWithAndWithoutAPalette) {
    const Picture few = moving_disc(1)[0];
    EXPECT_EQ(decode_png(png_bytes(few)).pixels, few.pixels);
    Picture many{64, 32, {}};
    for (unsigned i = 0; i < 64 * 32; ++i) many.pixels.push_back(i * 7919 & 0xffffff);
    EXPECT_EQ(decode_png(png_bytes(many)).pixels, many.pixels);
}

}  // namespace rddl::render
