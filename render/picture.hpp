// A finished picture, and where bytes of files go.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace rddl::render {

struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint32_t> pixels;  // 0x00RRGGBB, row by row from the top

    const std::uint32_t* row(int y) const {
        return pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    }
};

// Takes the next bytes of a file. May throw.
using Sink = std::function<void(std::string_view bytes)>;

// A failure to draw or write; what() is a sentence.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace rddl::render
