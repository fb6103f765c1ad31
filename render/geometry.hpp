// Places on a picture: x grows to the right, y downwards, both in points. A picture of 600 x 400
// pixels is 600 x 400 points; larger ones have larger points (canvas.hpp).
#pragma once

namespace rddl::render {

struct Point {
    double x = 0, y = 0;
};

struct Box {
    double x = 0, y = 0, width = 0, height = 0;

    double right() const { return x + width; }
    double bottom() const { return y + height; }
    Point center() const { return {x + width / 2, y + height / 2}; }

    Box inset(double all) const { return inset(all, all); }
    Box inset(double horizontal, double vertical) const {
        return {x + horizontal, y + vertical, width - 2 * horizontal, height - 2 * vertical};
    }

    // Parts along an edge; the second one is the rest of the box.
    Box top(double amount) const { return {x, y, width, amount}; }
    Box below(double amount) const { return {x, y + amount, width, height - amount}; }
    Box lowest(double amount) const { return {x, bottom() - amount, width, amount}; }
    Box above(double amount) const { return {x, y, width, height - amount}; }
    Box left(double amount) const { return {x, y, amount, height}; }
    Box after(double amount) const { return {x + amount, y, width - amount, height}; }
    Box rightmost(double amount) const { return {right() - amount, y, amount, height}; }
    Box before(double amount) const { return {x, y, width - amount, height}; }

    // The largest box of that width and height, times a factor, in the middle.
    Box fitted(double shape_width, double shape_height) const {
        const double by_width = width / shape_width, by_height = height / shape_height;
        const double factor = by_width < by_height ? by_width : by_height;
        const double w = shape_width * factor, h = shape_height * factor;
        return {x + (width - w) / 2, y + (height - h) / 2, w, h};
    }
    Box square() const { return fitted(1, 1); }
};

}  // namespace rddl::render
