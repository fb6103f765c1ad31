// The canvas of pictures: antialiased shapes and text, in points.
//
// The scale is chosen so that the canvas is at least 600 points wide and 400 points high, whatever
// its size in pixels: a text of 12 points is always a thirty-third of a picture of usual shape, and
// a visualizer needs to think of one size only.
#pragma once

#include "render/color.hpp"
#include "render/geometry.hpp"
#include "render/picture.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct _cairo;
struct _cairo_surface;

namespace rddl::render {

enum class Align { Left, Center, Right };
enum class VerticalAlign { Top, Middle, Bottom };

struct TextStyle {
    double size = 12;  // of the letters, in points
    Color color = colors::ink;
    Align align = Align::Left;
    VerticalAlign vertical = VerticalAlign::Middle;
    double turn = 0;    // radians, clockwise, about the place
    bool halo = false;  // light around the letters, which are read then whatever they lie on
};

// A canvas skips shapes with a coordinate, an angle or a size that is not a number.
class Canvas {
  public:
    // Pixels, from 16 to 8,192 each; throws Error on others.
    Canvas(int width, int height);
    // A vector graphic of that size in pixels; finish_svg() returns its bytes.
    static Canvas svg(int width, int height);

    Box area() const;  // all of it, in points
    double pixels_per_point() const;

    void clear(Color color);
    void fill(const Box& box, Color color, double corner = 0);
    void outline(const Box& box, Color color, double thickness = 1, double corner = 0);
    void line(Point from, Point to, Color color, double thickness = 1);
    void dashed_line(Point from, Point to, Color color, double thickness = 1, double dash = 4);
    void polyline(std::span<const Point> points, Color color, double thickness = 1);
    void polygon(std::span<const Point> points, Color color);
    void outline_polygon(std::span<const Point> points, Color color, double thickness = 1);
    void disc(Point center, double radius, Color color);
    void ring(Point center, double radius, Color color, double thickness = 1);
    // Angles in radians, clockwise from the right.
    void arc(Point center, double radius, double from, double to, Color color,
             double thickness = 1);
    void sector(Point center, double radius, double from, double to, Color color);

    void text(Point place, std::string_view text, const TextStyle& style = {});
    double text_width(std::string_view text, double size) const;

    // `columns` x `rows` colours (0x00RRGGBB) as rectangles that fill the box.
    void cells(const Box& box, int columns, int rows, std::span<const std::uint32_t> colors);

    // Drawing during the life of this object is moved and turned, or clipped to the box.
    class Saved {
      public:
        explicit Saved(_cairo* saved) : context_(saved) {}  // takes over what is saved already
        ~Saved();
        Saved(const Saved&) = delete;
        Saved& operator=(const Saved&) = delete;

      private:
        _cairo* context_;
    };
    Saved moved(Point origin, double turn = 0, double factor = 1);
    Saved clipped(const Box& box);

    // Copies the pixels.
    void read(Picture& picture) const;
    std::string finish_svg();

  private:
    Canvas(_cairo_surface* surface, int width, int height);
    void path(std::span<const Point> points);
    void path(const Box& box, double corner);
    bool arc_path(Point center, double radius, double from, double to);
    void stroke(Color color, double thickness);
    void source(Color color);

    struct Close {
        void operator()(_cairo* context) const;
        void operator()(_cairo_surface* surface) const;
    };
    int width_, height_;
    double scale_;
    std::unique_ptr<std::string> bytes_;  // of a vector graphic
    std::unique_ptr<_cairo_surface, Close> surface_;
    std::unique_ptr<_cairo, Close> context_;
};

std::uint32_t pixel_of(Color color);

}  // namespace rddl::render
