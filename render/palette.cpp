#include "render/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rddl::render {

namespace {

using Channels = std::array<double, 3>;

struct Weighted {
    std::uint32_t pixel;
    std::uint32_t count;
};

double channel(std::uint32_t pixel, std::size_t which) {
    return (pixel >> (8 * which)) & 0xff;
}

std::uint32_t pixel_of(const Channels& mean) {
    std::uint32_t pixel = 0;
    for (std::size_t c = 0; c < 3; ++c)
        pixel |= static_cast<std::uint32_t>(std::lround(mean[c])) << (8 * c);
    return pixel;
}

// Some of the colours: [begin, end), their mean and squared error in each channel.
struct Cut {
    std::size_t begin, end;
    double weight = 0;
    Channels mean{}, error{};

    Cut(const std::vector<Weighted>& colors, std::size_t first, std::size_t last)
        : begin(first), end(last) {
        Channels squares{};
        for (std::size_t i = begin; i < end; ++i) {
            weight += colors[i].count;
            for (std::size_t c = 0; c < 3; ++c) {
                const double value = channel(colors[i].pixel, c);
                mean[c] += colors[i].count * value;
                squares[c] += colors[i].count * value * value;
            }
        }
        for (std::size_t c = 0; c < 3; ++c) {
            mean[c] /= weight;
            error[c] = end - begin > 1 ? squares[c] - weight * mean[c] * mean[c] : 0;
        }
    }

    std::size_t widest() const {
        return static_cast<std::size_t>(std::max_element(error.begin(), error.end()) -
                                        error.begin());
    }
    double worst() const { return error[widest()]; }
};

// Splits the box at the mean of the widest channel; there are colours on either side of it.
std::array<Cut, 2> halves(std::vector<Weighted>& colors, const Cut& cut) {
    const std::size_t c = cut.widest();
    const auto at = [&](std::size_t i) {
        return colors.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const auto middle = std::partition(at(cut.begin), at(cut.end), [&](const Weighted& color) {
        return channel(color.pixel, c) <= cut.mean[c];
    });
    const auto split = static_cast<std::size_t>(middle - colors.begin());
    return {Cut(colors, cut.begin, split), Cut(colors, split, cut.end)};
}

std::size_t nearest(const std::vector<std::uint32_t>& palette, std::uint32_t pixel) {
    std::size_t best = 0;
    int least = std::numeric_limits<int>::max();
    const auto part = [](std::uint32_t color, int shift) {
        return static_cast<int>((color >> shift) & 0xff);
    };
    for (std::size_t i = 0; i < palette.size(); ++i) {
        const int r = part(palette[i], 16) - part(pixel, 16);
        const int g = part(palette[i], 8) - part(pixel, 8);
        const int b = part(palette[i], 0) - part(pixel, 0);
        const int distance = r * r + g * g + b * b;
        if (distance < least) {
            least = distance;
            best = i;
        }
    }
    return best;
}

}  // namespace

Palette::Palette(std::span<const std::uint32_t> pixels, std::size_t most) : slots_(1024) {
    count(pixels);
    if (used_ > most) {
        quantise(most);
        return;
    }
    for (Slot& slot : slots_) {
        if (slot.pixel == empty) continue;
        colors_.push_back(slot.pixel);
        slot.count = static_cast<std::uint32_t>(colors_.size() - 1);
    }
}

std::size_t Palette::place(std::uint32_t pixel) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (pixel * std::uint64_t{0x9e3779b97f4a7c15} >> 40) & mask;
    while (slots_[i].pixel != pixel && slots_[i].pixel != empty) i = (i + 1) & mask;
    return i;
}

void Palette::count(std::span<const std::uint32_t> pixels) {
    // Neighbours are alike more often than not.
    std::uint32_t last = empty;
    std::size_t at = 0;
    for (const std::uint32_t pixel : pixels) {
        if (pixel != last) {
            at = place(pixel);
            last = pixel;
        }
        if (slots_[at].pixel == empty) {
            slots_[at].pixel = pixel;
            if (++used_ * 2 > slots_.size()) {
                grow();
                at = place(pixel);
            }
        }
        ++slots_[at].count;
    }
}

void Palette::grow() {
    std::vector<Slot> old(slots_.size() * 2);
    old.swap(slots_);
    for (const Slot& slot : old)
        if (slot.pixel != empty) slots_[place(slot.pixel)] = slot;
}

void Palette::quantise(std::size_t most) {
    is_exact_ = false;
    std::vector<Weighted> colors;
    for (const Slot& slot : slots_)
        if (slot.pixel != empty) colors.push_back({slot.pixel, slot.count});
    const auto better = [](const Cut& a, const Cut& b) {
        return a.worst() < b.worst();
    };
    std::vector<Cut> heap{Cut(colors, 0, colors.size())};
    while (heap.size() < most) {
        std::pop_heap(heap.begin(), heap.end(), better);
        const Cut worst = heap.back();
        heap.pop_back();
        for (const Cut& half : halves(colors, worst)) {
            heap.push_back(half);
            std::push_heap(heap.begin(), heap.end(), better);
        }
    }
    for (const Cut& cut : heap) colors_.push_back(pixel_of(cut.mean));
    for (Slot& slot : slots_)
        if (slot.pixel != empty)
            slot.count = static_cast<std::uint32_t>(nearest(colors_, slot.pixel));
}

std::uint8_t Palette::index_of(std::uint32_t pixel) const {
    return static_cast<std::uint8_t>(slots_[place(pixel)].count);
}

}  // namespace rddl::render
