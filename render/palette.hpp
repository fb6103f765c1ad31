// Few colours for many: what GIF and small PNG files need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rddl::render {

// Maps pixels to their place in a palette of at most so many colours.
class Palette {
  public:
    // All colours of `pixels` if there are few enough; otherwise by median cut (P. Heckbert, Color
    // image quantization for frame buffer display, SIGGRAPH 1982): the box with the greatest
    // squared error is cut next, and at last each colour goes to the nearest of the palette's.
    Palette(std::span<const std::uint32_t> pixels, std::size_t most);

    const std::vector<std::uint32_t>& colors() const { return colors_; }
    bool is_exact() const { return is_exact_; }

    // The index of a pixel from which the palette was made.
    std::uint8_t index_of(std::uint32_t pixel) const;

  private:
    struct Slot {
        std::uint32_t pixel = empty;
        std::uint32_t count = 0;  // then the index
    };
    static constexpr std::uint32_t empty = 0xffffffff;  // no pixel: they have 24 bits

    std::size_t place(std::uint32_t pixel) const;
    void count(std::span<const std::uint32_t> pixels);
    void grow();
    void quantise(std::size_t most);

    std::vector<Slot> slots_;  // a hash table of a power of two
    std::size_t used_ = 0;
    std::vector<std::uint32_t> colors_;
    bool is_exact_ = true;
};

}  // namespace rddl::render
