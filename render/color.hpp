// Colours. Those for things that must be distinguished are Okabe and Ito's, which people with
// colour blindness can distinguish (M. Okabe, K. Ito, Color Universal Design, 2008).
#pragma once

#include <cstddef>

namespace rddl::render {

struct Color {
    double red = 0, green = 0, blue = 0, alpha = 1;  // 0 to 1

    Color with_alpha(double opacity) const { return {red, green, blue, opacity}; }
};

// 0xRRGGBB
constexpr Color rgb(unsigned hex) {
    return {((hex >> 16) & 0xff) / 255.0, ((hex >> 8) & 0xff) / 255.0, (hex & 0xff) / 255.0, 1};
}

// The colour between `a` (0) and `b` (1).
constexpr Color mix(Color a, Color b, double part) {
    return {a.red + (b.red - a.red) * part, a.green + (b.green - a.green) * part,
            a.blue + (b.blue - a.blue) * part, a.alpha + (b.alpha - a.alpha) * part};
}

namespace colors {

inline constexpr Color white = rgb(0xffffff), black = rgb(0x000000);
inline constexpr Color orange = rgb(0xe69f00), sky = rgb(0x56b4e9), green = rgb(0x009e73),
                       yellow = rgb(0xf0e442), blue = rgb(0x0072b2), vermilion = rgb(0xd55e00),
                       purple = rgb(0xcc79a7);

inline constexpr Color ink = rgb(0x222831);    // text and outlines
inline constexpr Color muted = rgb(0x5f6b7a);  // text of less weight
inline constexpr Color rule = rgb(0xc4cbd4);   // lines of grids and axes
inline constexpr Color faint = rgb(0xe9edf1);  // grounds that things stand on
inline constexpr Color paper = white;

}  // namespace colors

// The colours of series that stand side by side: the palette's colours in turn.
Color series_color(std::size_t number);

// A scale of blues from light (0) to dark (1), also readable in grey.
Color sequential_color(double part);
// A scale from blue (-1) over nearly white (0) to vermilion (1).
Color diverging_color(double part);

// Ink or white, whichever reads better on it.
Color text_on(Color ground);

}  // namespace rddl::render
