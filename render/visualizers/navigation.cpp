// A point that moves through zones which slow it down, towards a goal.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::navigation {

namespace {

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &goal = snapshot["GOAL"], &center = snapshot["DECELERATION_ZONE_CENTER"];
    const Values &decay = snapshot["DECELERATION_ZONE_DECAY"], &place = snapshot["location"];
    const int second = place.count(0) > 1 ? 1 : 0;
    Extent across, up;
    const auto add = [&](double x, double y) {
        across.add(x), up.add(y);
    };
    for (const Step& step : snapshot.steps())
        add(snapshot.number_in(step, "location", 0),
            snapshot.number_in(step, "location", static_cast<std::size_t>(second)));
    add(goal(0), goal(second));
    for (int z = 0; z < center.count(0); ++z) add(center(z, 0), center(z, second));
    across = across.rounded();
    up = up.rounded();
    const Box body = area.above(20);
    canvas.fill(body, rgb(0xf6f9fc), 4);
    const Entry entries[] = {
        {"slow zone", rgb(0xf4cf8a)}, {"goal", colors::green}, {"asked for", colors::vermilion}};
    legend(canvas, area.lowest(14), entries);
    const Canvas::Saved inside = canvas.clipped(body);
    const Plane plane(body, across.low, up.low, across.high, up.high);
    for (int z = 0; z < center.count(0); ++z) {
        // The factor of the speed is 2 / (1 + exp(-decay * distance)) - 1: rings for three of them.
        for (const double factor : {0.9, 0.6, 0.3}) {
            const double distance =
                std::log((1 + factor) / (1 - factor)) / std::max(decay(z), 1e-9);
            canvas.disc(plane(center(z, 0), center(z, second)), plane.length(distance),
                        colors::orange.with_alpha(0.22));
        }
    }
    const Point target = plane(goal(0), goal(second));
    canvas.ring(target, 10, colors::green, 2.5);
    canvas.disc(target, 4, colors::green);
    std::vector<Point> way;
    for (const Step& step : snapshot.steps())
        way.push_back(
            plane(snapshot.number_in(step, "location", 0),
                  snapshot.number_in(step, "location", static_cast<std::size_t>(second))));
    trail(canvas, way, colors::blue, 2.5);
    const Point now = way.back();
    if (snapshot.acts()) {
        const Values& move = snapshot["move"];
        arrow(canvas, now, {now.x + move(0) * 34, now.y - move(second) * 34}, colors::vermilion,
              2.5);
    }
    canvas.disc(now, 7, colors::blue);
}

}  // namespace

const Visualizer visualizer{
    "navigation",
    "the point with its way, zones that slow it down, the goal",
    {"Navigation"},
    {"location", "move", "GOAL", "DECELERATION_ZONE_CENTER", "DECELERATION_ZONE_DECAY"},
    draw};

}  // namespace rddl::render::navigation
