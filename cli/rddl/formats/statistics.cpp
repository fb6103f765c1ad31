#include "formats/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rddlc::cli {

Statistics statistics_of(const std::vector<double>& values) {
    if (values.empty()) return {};
    const auto count = static_cast<double>(values.size());
    Statistics s;
    for (const double value : values) s.mean += value;
    s.mean /= count;
    double squares = 0;
    for (const double value : values) squares += (value - s.mean) * (value - s.mean);
    if (values.size() > 1) s.deviation = std::sqrt(squares / (count - 1));
    s.minimum = *std::min_element(values.begin(), values.end());
    s.maximum = *std::max_element(values.begin(), values.end());
    if (std::isnan(s.mean)) s.minimum = s.maximum = s.mean;
    // Rounding shall not show a spread where there is none.
    if (s.minimum == s.maximum) return {s.minimum, 0, s.minimum, s.maximum};
    return s;
}

std::string number_text(double value) {
    return std::isnan(value) ? "nan" : fmt::format("{:.6g}", value);
}

std::string rate_text(double per_second) {
    if (per_second >= 1e9) return fmt::format("{:.3g} G", per_second / 1e9);
    if (per_second >= 1e6) return fmt::format("{:.3g} M", per_second / 1e6);
    if (per_second >= 1e3) return fmt::format("{:.3g} k", per_second / 1e3);
    return fmt::format("{:.3g}", per_second);
}

std::string seconds_text(double seconds) {
    if (seconds < 1e-6) return fmt::format("{:.3g} ns", seconds * 1e9);
    if (seconds < 1e-3) return fmt::format("{:.3g} us", seconds * 1e6);
    if (seconds < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
    return fmt::format("{:.2f} s", seconds);
}

}  // namespace rddlc::cli
