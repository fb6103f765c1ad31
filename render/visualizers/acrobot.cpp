// Two links that hang from a bar; a torque at the joint between them has to swing the end above the
// line (R. Sutton, NIPS 1996). Angles count from hanging down, the second from the first.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::acrobot {

namespace {

struct Links {
    Point joint, end;
};

Links links(const Plane& plane, const Snapshot& snapshot, const Step& step) {
    const double first = snapshot.number_or("L1", 1), second = snapshot.number_or("L2", 1);
    const double a = snapshot.number_in(step, "theta1"), b = a + snapshot.number_in(step, "theta2");
    const double x = first * std::sin(a), y = -first * std::cos(a);
    return {plane(x, y), plane(x + second * std::sin(b), y - second * std::cos(b))};
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const double reach = snapshot.number_or("L1", 1) + snapshot.number_or("L2", 1);
    const Plane plane(area, -1.1 * reach, -1.1 * reach, 1.1 * reach, 1.1 * reach);
    const Point bar = plane(0, 0);
    const double goal = plane(0, snapshot.number_or("L1", 1)).y;
    canvas.dashed_line({plane.box.x - 60, goal}, {plane.box.right() + 60, goal}, colors::green, 2,
                       6);
    canvas.text({plane.box.right() + 60, goal - 10}, "goal",
                {.size = 11, .color = colors::green, .align = Align::Right});
    const auto& steps = snapshot.steps();
    std::vector<Point> way;
    for (std::size_t k = std::min<std::size_t>(steps.size(), 30); k-- > 0;)
        way.push_back(links(plane, snapshot, steps[steps.size() - 1 - k]).end);
    canvas.polyline(way, colors::orange.with_alpha(0.4), 2);

    const auto [joint, end] = links(plane, snapshot, snapshot.now());
    canvas.line({bar.x - 40, bar.y}, {bar.x + 40, bar.y}, colors::rule, 4);
    canvas.line(bar, joint, colors::blue, 11);
    canvas.line(joint, end, colors::sky, 9);
    canvas.disc(bar, 6, colors::ink);
    canvas.disc(joint, 5.5, colors::ink);
    canvas.disc(end, 6, colors::orange);
    if (!snapshot.acts()) return;
    const double torque = std::clamp(snapshot.number("torque"), -1.0, 1.0);
    arc_arrow(canvas, joint, 20, M_PI / 2, M_PI / 2 - torque * 2.2, colors::vermilion, 3);
}

}  // namespace

const Visualizer visualizer{"acrobot",
                            "both links, the way of their end, and the line above which it must go",
                            {"acrobot"},
                            {"theta1", "theta2", "torque"},
                            draw};

}  // namespace rddl::render::acrobot
