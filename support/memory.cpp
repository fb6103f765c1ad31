#include "support/memory.hpp"

#include <fmt/format.h>

#include <array>

namespace rddlc {

std::string memory_text(double bytes) {
    if (bytes < 1024) return fmt::format("{:.0f} bytes", bytes);
    constexpr std::array units = {"KiB", "MiB", "GiB", "TiB"};
    std::size_t unit = 0;
    for (bytes /= 1024; bytes >= 1024 && unit + 1 < units.size(); ++unit) bytes /= 1024;
    return fmt::format("{:.3g} {}", bytes, units[unit]);
}

}  // namespace rddlc
