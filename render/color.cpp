#include "render/color.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rddl::render {

Color series_color(std::size_t number) {
    using namespace colors;
    static constexpr std::array palette{blue, vermilion, green, purple, orange, sky, ink};
    return palette[number % palette.size()];
}

Color sequential_color(double part) {
    static constexpr std::array stops{rgb(0xf7fbff), rgb(0xc6dbef), rgb(0x6baed6), rgb(0x2171b5),
                                      rgb(0x08306b)};
    if (std::isnan(part)) return colors::rule;
    const double place = std::clamp(part, 0.0, 1.0) * (stops.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    return mix(stops[below], stops[below + 1], place - static_cast<double>(below));
}

Color diverging_color(double part) {
    if (std::isnan(part)) return colors::rule;
    const double strength = std::clamp(std::abs(part), 0.0, 1.0);
    return mix(rgb(0xf7f7f7), part < 0 ? colors::blue : colors::vermilion, strength);
}

Color text_on(Color ground) {
    // Relative luminance, roughly: the eye takes green for brightest.
    const double light = 0.30 * ground.red + 0.59 * ground.green + 0.11 * ground.blue;
    return light > 0.55 ? colors::ink : colors::white;
}

}  // namespace rddl::render
