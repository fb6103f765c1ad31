#include "render/gif.hpp"

#include "render/palette.hpp"

#include <gif_lib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace rddl::render {

namespace {

constexpr std::size_t most_colors = 256;

int append(GifFileType* file, const GifByteType* data, int size) {
    try {
        static_cast<std::string*>(file->UserData)
            ->append(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
        return size;
    } catch (...) {
        return 0;  // nothing is thrown through giflib, which is C
    }
}

// A map of a power of two of colours, which GIF asks for.
ColorMapObject* color_map(const std::vector<std::uint32_t>& colors, std::size_t count) {
    std::size_t size = 2;
    while (size < count) size *= 2;
    ColorMapObject* const map = GifMakeMapObject(static_cast<int>(size), nullptr);
    if (!map) throw std::bad_alloc();
    for (std::size_t i = 0; i < colors.size(); ++i)
        map->Colors[i] = {static_cast<GifByteType>(colors[i] >> 16),
                          static_cast<GifByteType>(colors[i] >> 8),
                          static_cast<GifByteType>(colors[i])};
    return map;
}

}  // namespace

// The rectangle in which the next frame differs from the last, and its pixels.
struct GifWriter::Changed {
    int left = 0, top = 0, width = 1, height = 1;
    std::vector<std::uint32_t> pixels;  // of the rectangle, row by row
    std::vector<std::uint8_t> differs;  // each of them; empty: all
    std::vector<std::uint32_t> fresh;   // those that differ
};

GifWriter::GifWriter(int width, int height, Sink sink)
    : width_(width), height_(height), sink_(std::move(sink)) {
    int error = 0;
    file_ = EGifOpen(&bytes_, append, &error);
    if (!file_) throw Error(std::string("giflib does not start: ") + GifErrorString(error));
    EGifSetGifVersion(file_, true);  // animations are of version 89a
    check(EGifPutScreenDesc(file_, width, height, 8, 0, nullptr));
    // Netscape's extension: repeat for ever.
    const char repeat[] = {1, 0, 0};
    check(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0"));
    check(EGifPutExtensionBlock(file_, sizeof repeat, repeat));
    check(EGifPutExtensionTrailer(file_));
}

GifWriter::~GifWriter() {
    int error = 0;
    if (file_) EGifCloseFile(file_, &error);
}

void GifWriter::check(int status) const {
    if (status == GIF_ERROR)
        throw Error(std::string("giflib cannot write the movie: ") + GifErrorString(file_->Error));
}

GifWriter::Changed GifWriter::changed_part(const Picture& picture) const {
    Changed part;
    if (last_.pixels.empty()) {
        part.width = picture.width;
        part.height = picture.height;
        part.pixels = part.fresh = picture.pixels;
        return part;
    }
    int top = 0, bottom = picture.height - 1;
    int left = picture.width, right = -1;
    const auto row_bytes = sizeof(std::uint32_t) * static_cast<std::size_t>(picture.width);
    const auto same_row = [&](int y) {
        return std::memcmp(picture.row(y), last_.row(y), row_bytes) == 0;
    };
    while (top <= bottom && same_row(top)) ++top;
    while (bottom > top && same_row(bottom)) --bottom;
    for (int y = top; y <= bottom; ++y) {
        const std::uint32_t *now = picture.row(y), *before = last_.row(y);
        int x = 0;
        while (x < left && now[x] == before[x]) ++x;
        left = std::min(left, x);
        x = picture.width - 1;
        while (x > right && now[x] == before[x]) --x;
        right = std::max(right, x);
    }
    if (right < left) {  // nothing changed: a frame of one pixel all the same
        top = bottom = left = right = 0;
    }
    part.left = left;
    part.top = top;
    part.width = right - left + 1;
    part.height = bottom - top + 1;
    const auto area = static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height);
    part.pixels.reserve(area);
    part.differs.reserve(area);
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            const std::uint32_t pixel = picture.row(y)[x];
            const bool differs = pixel != last_.row(y)[x];
            part.pixels.push_back(pixel);
            part.differs.push_back(differs);
            if (differs) part.fresh.push_back(pixel);
        }
    return part;
}

void GifWriter::write_frame(const Changed& part, int hundredths) {
    const bool transparent = !part.differs.empty();
    const Palette palette(part.fresh, most_colors - (transparent ? 1 : 0));
    const std::size_t clear = palette.colors().size();  // the index of no colour

    GraphicsControlBlock control{};
    control.DisposalMode = DISPOSE_DO_NOT;
    control.DelayTime = hundredths;
    control.TransparentColor = transparent ? static_cast<int>(clear) : NO_TRANSPARENT_COLOR;
    GifByteType extension[4];
    EGifGCBToExtension(&control, extension);
    check(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, sizeof extension, extension));

    ColorMapObject* const map = color_map(palette.colors(), clear + (transparent ? 1 : 0));
    const int described =
        EGifPutImageDesc(file_, part.left, part.top, part.width, part.height, false, map);
    GifFreeMapObject(map);
    check(described);
    std::vector<GifByteType> row(static_cast<std::size_t>(part.width));
    for (int y = 0; y < part.height; ++y) {
        const std::size_t begin = static_cast<std::size_t>(y) * row.size();
        for (std::size_t x = 0; x < row.size(); ++x) {
            const bool drawn = !transparent || part.differs[begin + x];
            row[x] =
                drawn ? palette.index_of(part.pixels[begin + x]) : static_cast<GifByteType>(clear);
        }
        check(EGifPutLine(file_, row.data(), part.width));
    }
}

void GifWriter::add(const Picture& picture, double seconds) {
    if (picture.width != width_ || picture.height != height_)
        throw Error("the frames of a movie have one size");
    debt_ += seconds * 100;
    const int hundredths = static_cast<int>(std::clamp(std::round(debt_), 1.0, 65535.0));
    debt_ -= hundredths;
    write_frame(changed_part(picture), hundredths);
    last_ = picture;
    flush();
}

void GifWriter::finish() {
    int error = 0;
    GifFileType* const file = std::exchange(file_, nullptr);
    if (EGifCloseFile(file, &error) == GIF_ERROR)
        throw Error(std::string("giflib cannot write the movie: ") + GifErrorString(error));
    flush();
}

void GifWriter::flush() {
    sink_(bytes_);
    bytes_.clear();
}

}  // namespace rddl::render
