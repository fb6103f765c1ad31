#include "formats/number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rddlc::workbench {

std::string number_text(double value) {
    return std::isnan(value) ? "nan" : fmt::format("{:.6g}", value);
}

// Units change where three digits would round to 1000.
std::string rate_text(double per_second) {
    if (per_second >= 999.5e6) return fmt::format("{:.3g} G", per_second / 1e9);
    if (per_second >= 999.5e3) return fmt::format("{:.3g} M", per_second / 1e6);
    if (per_second >= 999.5) return fmt::format("{:.3g} k", per_second / 1e3);
    return fmt::format("{:.3g}", per_second);
}

std::string seconds_text(double seconds) {
    if (seconds < 999.5e-9) return fmt::format("{:.3g} ns", seconds * 1e9);
    if (seconds < 999.5e-6) return fmt::format("{:.3g} us", seconds * 1e6);
    if (seconds < 0.9995) return fmt::format("{:.3g} ms", seconds * 1e3);
    return fmt::format("{:.2f} s", seconds);
}

}  // namespace rddlc::workbench
