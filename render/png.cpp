#include "render/png.hpp"

#include "render/palette.hpp"

#include <png.h>

#include <csetjmp>
#include <vector>

namespace rddl::render {

namespace {

// Memory that libpng's error handling, which jumps, cannot leave behind.
struct Work {
    std::string bytes;
    std::vector<png_color> colors;
    std::vector<png_byte> row;
    bool out_of_memory = false;
};

void append(png_structp png, png_bytep data, std::size_t size) {
    auto& work = *static_cast<Work*>(png_get_io_ptr(png));
    try {
        work.bytes.append(reinterpret_cast<const char*>(data), size);
    } catch (...) {
        work.out_of_memory = true;  // nothing is thrown through libpng, which is C
    }
}

void make_row(const Picture& picture, const Palette* palette, int y, std::vector<png_byte>& row) {
    const std::uint32_t* const pixels = picture.row(y);
    row.clear();
    for (int x = 0; x < picture.width; ++x) {
        const std::uint32_t pixel = pixels[x];
        if (palette) {
            row.push_back(palette->index_of(pixel));
            continue;
        }
        row.push_back(static_cast<png_byte>(pixel >> 16));
        row.push_back(static_cast<png_byte>(pixel >> 8));
        row.push_back(static_cast<png_byte>(pixel));
    }
}

// False if libpng refuses.
bool write(png_structp png, png_infop info, const Picture& picture, const Palette* palette,
           Work& work) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_write_fn(png, &work, append, nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width),
                 static_cast<png_uint_32>(picture.height), 8,
                 palette ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (palette) {
        png_set_PLTE(png, info, work.colors.data(), static_cast<int>(work.colors.size()));
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    }
    png_set_compression_level(png, 6);
    png_write_info(png, info);
    for (int y = 0; y < picture.height; ++y) {
        make_row(picture, palette, y, work.row);
        png_write_row(png, work.row.data());
    }
    png_write_end(png, nullptr);
    return true;
}

std::string encode(const Picture& picture, const Palette* palette) {
    Work work;
    if (palette)
        for (const std::uint32_t color : palette->colors())
            work.colors.push_back({static_cast<png_byte>(color >> 16),
                                   static_cast<png_byte>(color >> 8),
                                   static_cast<png_byte>(color)});
    work.row.reserve(static_cast<std::size_t>(picture.width) * 3);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    const bool written = info && write(png, info, picture, palette, work);
    png_destroy_write_struct(&png, &info);
    if (!written || work.out_of_memory) throw Error("libpng cannot write the picture");
    return std::move(work.bytes);
}

}  // namespace

std::string png_bytes(const Picture& picture) {
    const Palette palette(picture.pixels, 256);
    return encode(picture, palette.is_exact() ? &palette : nullptr);
}

std::string small_png_bytes(const Picture& picture) {
    const Palette palette(picture.pixels, 256);
    return encode(picture, &palette);
}

}  // namespace rddl::render
