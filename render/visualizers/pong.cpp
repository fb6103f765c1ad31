// Balls and the paddle that has to meet them.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

namespace rddl::render::pong {

namespace {

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Plane plane(area, -0.02, -0.02, 1.04, 1.02);
    const Point top = plane(0, 1), bottom = plane(1, 0);
    canvas.fill({top.x, top.y, bottom.x - top.x, bottom.y - top.y}, rgb(0x22303c), 4);
    canvas.dashed_line(plane(0.5, 0), plane(0.5, 1), colors::muted, 1.5, 6);
    const Values &x = snapshot["ball-x"], &y = snapshot["ball-y"];
    for (int i = 0; i < x.count(0); ++i) {
        const auto g = static_cast<std::size_t>(i);
        std::vector<Point> way;
        const auto& steps = snapshot.steps();
        for (std::size_t k = steps.size() > 12 ? steps.size() - 12 : 0; k < steps.size(); ++k)
            way.push_back(plane(snapshot.number_in(steps[k], "ball-x", g),
                                snapshot.number_in(steps[k], "ball-y", g)));
        trail(canvas, way, colors::sky, 3);
        canvas.disc(plane(x(i), y(i)), 7, colors::orange);
    }
    const double low = snapshot.number("paddle-y"), height = snapshot.number_or("PADDLE-H", 0.2);
    const Point a = plane(1, low + height), b = plane(1, low);
    canvas.fill({a.x - 4, a.y, 9, b.y - a.y}, colors::sky, 4);
    const double move = snapshot.acts() ? snapshot.number("move") - snapshot.default_of("move") : 0;
    const Point middle{a.x + 16, (a.y + b.y) / 2};
    if (move != 0)
        arrow(canvas, middle, {middle.x, middle.y - (move > 0 ? 26 : -26)}, colors::vermilion, 3);
}

}  // namespace

const Visualizer visualizer{"pong",
                            "balls with their ways, and the paddle",
                            {"pong_mdp"},
                            {"ball-x", "ball-y", "paddle-y", "move"},
                            draw};

}  // namespace rddl::render::pong
