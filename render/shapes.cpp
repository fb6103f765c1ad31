#include "render/shapes.hpp"

#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rddl::render {

namespace {

constexpr std::pair<std::string_view, Color> named_colors[] = {
    {"black", colors::black}, {"white", colors::white},         {"orange", colors::orange},
    {"sky", colors::sky},     {"green", colors::green},         {"yellow", colors::yellow},
    {"blue", colors::blue},   {"vermilion", colors::vermilion}, {"purple", colors::purple},
    {"gray", colors::muted},  {"light-gray", colors::rule},     {"faint", colors::faint}};

bool is_finite(const Shape& shape) {
    return std::isfinite(shape.radius) && std::isfinite(shape.size) &&
           std::isfinite(shape.thickness) &&
           std::all_of(shape.points.begin(), shape.points.end(), [](Point point) {
               return std::isfinite(point.x) && std::isfinite(point.y);
           });
}

void draw_polygon(Canvas& canvas, std::span<const Point> corners, const Shape& shape) {
    if (shape.outline)
        canvas.outline_polygon(corners, shape.color, shape.thickness);
    else
        canvas.polygon(corners, shape.color);
}

void draw_shape(Canvas& canvas, const Plane& plane, const Shape& shape) {
    std::vector<Point> points;
    for (const Point point : shape.points) points.push_back(plane(point.x, point.y));
    switch (shape.kind) {
        case Shape::Kind::Circle: {
            const double radius = std::max(plane.length(shape.radius), 0.0);
            if (shape.outline)
                canvas.ring(points[0], radius, shape.color, shape.thickness);
            else
                canvas.disc(points[0], radius, shape.color);
            return;
        }
        case Shape::Kind::Line:
            canvas.polyline(points, shape.color, shape.thickness);
            return;
        case Shape::Kind::Rectangle: {
            const Point a = points[0], b = points[1];
            draw_polygon(canvas, std::vector<Point>{a, {b.x, a.y}, b, {a.x, b.y}}, shape);
            return;
        }
        case Shape::Kind::Polygon:
            draw_polygon(canvas, points, shape);
            return;
        case Shape::Kind::Text:
            canvas.text(points[0], shape.text,
                        {.size = std::clamp(shape.size, 1.0, 400.0),
                         .color = shape.color,
                         .align = shape.align});
            return;
    }
}

}  // namespace

void draw_shapes(Canvas& canvas, const Box& box, const Box& world, std::span<const Shape> shapes) {
    const Plane plane(box, world.x, world.y, world.right(), world.bottom());
    const Canvas::Saved inside = canvas.clipped(plane.box);
    for (const Shape& shape : shapes)
        if (is_finite(shape)) draw_shape(canvas, plane, shape);
}

std::vector<std::string> color_names() {
    std::vector<std::string> names;
    for (const auto& [name, color] : named_colors) names.emplace_back(name);
    return names;
}

bool read_color(std::string_view text, Color& color) {
    for (const auto& [name, named] : named_colors)
        if (name == text) {
            color = named;
            return true;
        }
    if (text.size() != 7 || text[0] != '#') return false;
    unsigned hex = 0;
    for (const char c : text.substr(1)) {
        const std::size_t digit = std::string_view("0123456789abcdef").find(c | 0x20);
        if (digit == std::string_view::npos) return false;
        hex = hex * 16 + static_cast<unsigned>(digit);
    }
    color = rgb(hex);
    return true;
}

}  // namespace rddl::render
