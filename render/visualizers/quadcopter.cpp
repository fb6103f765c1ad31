// Drones in space, seen from a corner: their four rotors and where these push, their
// shadows on the ground, their ways and their targets.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rddl::render::quadcopter {

namespace {

using Place = std::array<double, 3>;

// A view in parallel lines onto a box of the world.
struct Camera {
    Place low, high;
    Box box;
    double factor = 1;
    Point middle;

    static constexpr double turn = 0.62, tilt = 0.42;  // radians

    static Point flat(const Place& p) {
        const double x = p[0] * std::cos(turn) - p[1] * std::sin(turn);
        const double depth = p[0] * std::sin(turn) + p[1] * std::cos(turn);
        return {x, -p[2] * std::cos(tilt) - depth * std::sin(tilt)};
    }
    Point operator()(const Place& p) const {
        const Point at = flat(p);
        return {box.center().x + (at.x - middle.x) * factor,
                box.center().y + (at.y - middle.y) * factor};
    }
};

Camera camera_for(const Box& box, const Place& low, const Place& high) {
    Extent x, y;
    for (int corner = 0; corner < 8; ++corner) {
        const Point at = Camera::flat({corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                                       corner & 4 ? high[2] : low[2]});
        x.add(at.x), y.add(at.y);
    }
    Camera camera{low, high, box, 1, {}};
    camera.middle = {(x.low + x.high) / 2, (y.low + y.high) / 2};
    camera.factor = std::min(box.width / (x.high - x.low), box.height / (y.high - y.low));
    return camera;
}

void draw_ground(Canvas& canvas, const Camera& camera) {
    const auto [left, front, floor] = camera.low;
    const auto [right, back, top] = camera.high;
    for (int i = 0; i <= 8; ++i) {
        const double x = left + (right - left) * i / 8, y = front + (back - front) * i / 8;
        canvas.line(camera({x, front, floor}), camera({x, back, floor}), colors::faint);
        canvas.line(camera({left, y, floor}), camera({right, y, floor}), colors::faint);
    }
    for (const Place& corner :
         {Place{left, back, floor}, Place{right, back, floor}, Place{left, front, floor}}) {
        const Place above{corner[0], corner[1], top};
        canvas.line(camera(corner), camera(above), colors::rule, 0.8);
    }
    const auto number = [&](double value, const Place& at, double dx, double dy, Align align,
                            const char* axis = "") {
        const Point place = camera(at);
        canvas.text({place.x + dx, place.y + dy}, axis + number_text(std::round(value * 10) / 10),
                    {.size = 9, .color = colors::muted, .align = align});
    };
    number(top, {left, front, top}, -4, 0, Align::Right, "z ");
    number(floor, {left, front, floor}, -4, -4, Align::Right);
    number(left, {left, front, floor}, 4, 10, Align::Left, "x ");
    number(right, {right, front, floor}, 4, 8, Align::Left, "x ");
    number(front, {left, front, floor}, -4, 10, Align::Right, "y ");
    number(back, {left, back, floor}, -4, 8, Align::Right, "y ");
}

// How a drone stands: where its two arms point, and where its rotors push it.
struct Axes {
    Place x, y, z;
};

// The axes from the angles of the domain's dynamics: the body is turned by phi, leans by theta, and
// is turned by psi (Euler angles z-x-z).
Axes axes_of(double phi, double theta, double psi) {
    const double cph = std::cos(phi), sph = std::sin(phi), cth = std::cos(theta),
                 sth = std::sin(theta), cps = std::cos(psi), sps = std::sin(psi);
    return {{cph * cps - cth * sph * sps, cph * sps + cth * sph * cps, sph * sth},
            {-sph * cps - cth * cph * sps, -sph * sps + cth * cph * cps, cph * sth},
            {sth * sps, -sth * cps, cth}};
}

void draw_drone(Canvas& canvas, const Camera& camera, const Snapshot& snapshot, int i,
                Color color) {
    const Place at{snapshot["x"](i), snapshot["y"](i), snapshot["z"](i)};
    // The quadcopter is drawn far too large; otherwise its tilt would be invisible.
    const double span = 19 / camera.factor;
    const Axes axes = axes_of(snapshot["phi"](i), snapshot["theta"](i), snapshot["psi"](i));
    const auto end = [&](const Place& axis, double distance) {
        return camera(
            {at[0] + axis[0] * distance, at[1] + axis[1] * distance, at[2] + axis[2] * distance});
    };
    for (const Place& arm : {axes.x, axes.y})
        canvas.line(end(arm, -span), end(arm, span), colors::ink, 2.5);
    arrow(canvas, camera(at), end(axes.z, 1.3 * span), color, 2);
    for (const Place& arm : {axes.x, axes.y})
        for (const double side : {-span, span}) {
            canvas.disc(end(arm, side), 6, color.with_alpha(0.55));
            canvas.ring(end(arm, side), 6, color, 1.2);
        }
    canvas.disc(camera(at), 4, colors::ink);
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    std::array<Extent, 3> extents;
    const std::array<std::string_view, 3> names{"x", "y", "z"}, targets{"TX", "TY", "TZ"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double value : snapshot[targets[axis]].numbers) extents[axis].add(value);
        for (const Step& step : snapshot.steps())
            for (const double value :
                 snapshot.values_in(step, *snapshot.world().find(names[axis])).numbers)
                extents[axis].add(value);
    }
    extents[2].add(0);
    Place low, high;
    double widest = 0;
    for (const Extent& extent : extents) widest = std::max(widest, extent.high - extent.low);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Extent extent = extents[axis];
        const double middle = (extent.low + extent.high) / 2;
        extent.add(middle - widest / 2), extent.add(middle + widest / 2);
        if (axis < 2) extent = extent.rounded();
        low[axis] = extent.low;
        high[axis] = extent.high;
    }
    low[2] = extents[2].low;
    high[2] = std::max(extents[2].rounded().high, low[2] + widest);
    const Camera camera = camera_for(area.above(34).below(4).inset(30, 0), low, high);
    draw_ground(canvas, camera);
    const Values& x = snapshot["x"];
    for (int i = 0; i < x.count(0); ++i) {
        const auto g = static_cast<std::size_t>(i);
        const Color color = series_color(g);
        const Point target = camera({snapshot["TX"](i), snapshot["TY"](i), snapshot["TZ"](i)});
        canvas.line({target.x - 7, target.y - 7}, {target.x + 7, target.y + 7}, color, 3);
        canvas.line({target.x - 7, target.y + 7}, {target.x + 7, target.y - 7}, color, 3);
        std::vector<Point> way;
        for (const Step& step : snapshot.steps())
            way.push_back(
                camera({snapshot.number_in(step, "x", g), snapshot.number_in(step, "y", g),
                        snapshot.number_in(step, "z", g)}));
        trail(canvas, way, color);
        const Point shadow = camera({x(i), snapshot["y"](i), low[2]});
        canvas.dashed_line(way.back(), shadow, colors::rule, 1, 3);
        canvas.disc(shadow, 4, colors::rule);
    }
    for (int i = 0; i < x.count(0); ++i)
        draw_drone(canvas, camera, snapshot, i, series_color(static_cast<std::size_t>(i)));
    canvas.text({area.x, area.bottom() - 6},
                "crosses: targets; dots: places on the ground below; arrows: where the rotors push",
                {.size = 11, .color = colors::muted});
}

}  // namespace

const Visualizer visualizer{"quadcopter",
                            "drones in space, how they lean, their ways and targets",
                            {"quadcopter"},
                            {"x", "y", "z", "phi", "theta", "psi", "TX", "TY", "TZ"},
                            draw};

}  // namespace rddl::render::quadcopter
