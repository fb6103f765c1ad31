// An arm of several segments on a table, seen from above, and the target for its tip.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rddl::render::reacher {

namespace {

// Segments from the base outwards.
std::vector<int> outwards(const Values& position) {
    std::vector<int> order(static_cast<std::size_t>(position.count(0)));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return position(a) < position(b); });
    return order;
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &length = snapshot["LENGTH"], &x = snapshot["tip-x"], &y = snapshot["tip-y"];
    const double reach = 1.08 * std::accumulate(length.numbers.begin(), length.numbers.end(), 0.0);
    const Plane plane(area, -reach, -reach, reach, reach);
    const Point base = plane(0, 0);
    canvas.disc(base, plane.length(reach / 1.08), rgb(0xf6f9fc));
    const Point target = plane(snapshot.number("TARGET-X"), snapshot.number("TARGET-Y"));
    canvas.disc(target, 11, rgb(0xbfe3d6));
    canvas.ring(target, 11, colors::green, 2);
    canvas.disc(target, 3, colors::green);
    const std::vector<int> order = outwards(snapshot["POS"]);
    std::vector<Point> way;
    const auto tip = static_cast<std::size_t>(order.back());
    for (const Step& step : snapshot.steps())
        way.push_back(
            plane(snapshot.number_in(step, "tip-x", tip), snapshot.number_in(step, "tip-y", tip)));
    trail(canvas, way, colors::orange);
    Point joint = base;
    double thickness = 14;
    for (const int segment : order) {
        const Point end = plane(x(segment), y(segment));
        canvas.line(joint, end, series_color(static_cast<std::size_t>(segment)), thickness);
        joint = end;
        thickness = std::max(thickness - 2, 6.0);
    }
    joint = base;
    const double most = snapshot.number_or("TORQUE-MAX", 0.1);
    for (const int segment : order) {
        canvas.disc(joint, 5, colors::ink);
        if (snapshot.acts()) {
            const double part = std::clamp(snapshot["torque"](segment) / most, -1.0, 1.0);
            arc_arrow(canvas, joint, 18, M_PI / 2, M_PI / 2 - part * 2.2, colors::ink, 2);
        }
        joint = plane(x(segment), y(segment));
    }
    canvas.disc(joint, 6, colors::orange);
    const double distance = std::hypot(x(order.back()) - snapshot.number("TARGET-X"),
                                       y(order.back()) - snapshot.number("TARGET-Y"));
    canvas.text({area.x, area.y + 8}, "distance to the target",
                {.size = 11, .color = colors::muted});
    canvas.text({area.x, area.y + 26}, number_text(distance), {.size = 14});
}

}  // namespace

const Visualizer visualizer{"reacher",
                            "the arm, the torques at its joints, the target",
                            {"reacher"},
                            {"tip-x", "tip-y", "torque", "LENGTH", "POS", "TARGET-X", "TARGET-Y"},
                            draw};

}  // namespace rddl::render::reacher
