// PNG files.
#pragma once

#include "render/picture.hpp"

#include <string>

namespace rddl::render {

// The bytes of a PNG file: with a palette where there are at most 256 colours, which makes them
// smaller by half; without time and other text, so that the same picture gives the same bytes.
std::string png_bytes(const Picture& picture);

// The same with 256 colours at most (palette.hpp), which makes drawings smaller by half.
std::string small_png_bytes(const Picture& picture);

}  // namespace rddl::render
