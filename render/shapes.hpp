// Shapes that another part has computed, such as those of a scene file.
#pragma once

#include "render/canvas.hpp"

#include <span>
#include <string>
#include <vector>

namespace rddl::render {

// A shape in a flat world whose y grows upwards.
struct Shape {
    enum class Kind { Circle, Line, Rectangle, Polygon, Text };

    Kind kind = Kind::Circle;
    // The center of a circle and of a text; both ends of a line; the lower left and upper right
    // corners of a rectangle; the corners of a polygon.
    std::vector<Point> points;
    double radius = 0;            // of a circle, in the world
    double size = 12;             // of a text's letters, in points
    double thickness = 2;         // of lines and outlines, in points
    Align align = Align::Center;  // of a text: which part of it is at its place
    bool outline = false;         // not filled
    Color color = colors::ink;
    std::string text;
};

// Draws the part of the world that is shown, as large as it fits into `box`; shapes that are not
// finite are left out.
void draw_shapes(Canvas& canvas, const Box& box, const Box& world, std::span<const Shape> shapes);

// Reads "blue" or "#0072b2"; false for other words. color_names() lists all names.
std::vector<std::string> color_names();
bool read_color(std::string_view text, Color& color);

}  // namespace rddl::render
