// Tables say by small ints what becomes of the bools of a loop where one thing moves.
#pragma once

#include <cstdint>

namespace rddl {

// One of `count` bools is true, or is true if a draw is; or none is true; or it is not that simple.
struct MoveCodes {
    std::int64_t count;

    constexpr std::int64_t certain(std::int64_t object) const { return object; }
    constexpr std::int64_t drawn(std::int64_t object) const { return count + object; }
    constexpr std::int64_t none() const { return 2 * count; }
    constexpr std::int64_t other() const { return 2 * count + 1; }
};

}  // namespace rddl
