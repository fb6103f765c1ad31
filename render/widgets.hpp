// Shared elements of visualizers: axes, arrows, gauges, labels.
#pragma once

#include "render/canvas.hpp"
#include "render/snapshot.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rddl::render {

// Maps a range of numbers to points, and to marks with round numbers.
struct Scale {
    double low = 0, high = 1;   // numbers
    double begin = 0, end = 1;  // points

    double operator()(double number) const;
    double clamped(double number) const;  // not beyond begin and end
};

// Round numbers between low and high, about `wanted` of them, and two if there are so many.
std::vector<double> ticks(double low, double high, int wanted);
// A range that holds a little more than the numbers, and has some width.
Scale scale_around(double low, double high, double begin, double end, double margin = 0.05);

// A flat world of x and y (upwards) with equal scales in the middle of a box.
struct Plane {
    Plane(const Box& box, double left, double bottom, double right, double top);

    Point operator()(double x, double y) const;
    double length(double distance) const { return factor * distance; }

    Box box;  // that is used
    double left, bottom, factor;
};

// Round numbers below a field and at its left, in the room that is left for them.
inline constexpr double room_below = 14, room_at_left = 26;
void field_ticks(Canvas& canvas, const Box& field, const Scale& across, const Scale& up);
void field_ticks(Canvas& canvas, const Plane& plane);

// A label that fits: shortened with "…" where it does not, or nothing.
std::string shortened(const Canvas& canvas, std::string_view text, double size, double width);
// The same for an object or a value, whose end distinguishes it from others: "reservoi…217".
std::string shortened_name(const Canvas& canvas, std::string_view name, double size, double width);
void label(Canvas& canvas, const Box& box, std::string_view text, TextStyle style = {});

void arrow(Canvas& canvas, Point from, Point to, Color color, double thickness = 2);

// A bar from the bottom of the box, with marks at some heights. Parts are from 0 to 1.
struct Mark {
    double part;
    Color color;
};
void gauge(Canvas& canvas, const Box& box, double part, Color color,
           std::span<const Mark> marks = {});

// Swatches with names, in a row from the left, with letters of that size. "+3" says how many do not
// fit.
struct Entry {
    std::string name;
    Color color;
};
void legend(Canvas& canvas, const Box& box, std::span<const Entry> entries, double size = 11);
// The same at the right of the box; smaller letters and shorter names if there is little room.
void legend_at_right(Canvas& canvas, const Box& box, std::vector<Entry> entries);
// The same for numbers and the like, which cannot be shortened. Returns false, and draws nothing,
// if they do not fit.
bool whole_legend_at_right(Canvas& canvas, const Box& box, std::span<const Entry> entries);

// A grid of cells in a box: square where that is sensible.
struct Grid {
    Grid(const Box& box, int columns, int rows, bool square = true);

    Box cell(int column, int row) const;  // row 0 is at the top
    Box box;
    int columns, rows;
};

// A range that holds the numbers and ends at round ones, so that it seldom moves as they grow.
struct Extent {
    double low = 0, high = 0;
    bool empty = true;

    void add(double number);
    Extent rounded() const;
};

// An arrow along an arc, clockwise where `to` is greater; angles as in Canvas::arc.
void arc_arrow(Canvas& canvas, Point center, double radius, double from, double to, Color color,
               double thickness = 2);

// A person, standing with its feet at the place.
void person(Canvas& canvas, Point feet, double height, Color color);

// The place of each object in the order that a fluent of two of them defines: if it holds of a and
// b, b comes after a. Without such an order, the declaration order.
std::vector<int> order_of(const Values& follows);

// Draws the path of something in the last steps, from long ago to now, fading.
void trail(Canvas& canvas, std::span<const Point> points, Color color, double thickness = 2);

// The place of thing `number` of `count` things on a circle, from the top, clockwise.
Point on_circle(Point center, double radius, int number, int count);

}  // namespace rddl::render
