// Which rows of bools packs have in narrow lanes (narrow_bits.hpp).
#pragma once

#include <cstdint>

namespace rddl {

// How many bits a lane of 16 or 32 has besides its sign, whichever holds a row of so many bools; 0
// if neither does.
constexpr int narrow_width(std::int64_t bools) {
    if (bools > 31) return 0;
    return bools > 15 ? 31 : 15;
}

}  // namespace rddl
