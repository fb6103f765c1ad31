// A car between walls, its way, and the place that it has to reach.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <cmath>

namespace rddl::render::race_car {

namespace {

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &x1 = snapshot["X1"], &y1 = snapshot["Y1"], &x2 = snapshot["X2"],
                 &y2 = snapshot["Y2"];
    const double goal_x = snapshot.number("GX"), goal_y = snapshot.number("GY");
    const double radius = snapshot.number("RADIUS");
    Extent across, up;
    for (int i = 0; i < x1.count(0); ++i) {
        across.add(x1(i)), across.add(x2(i));
        up.add(y1(i)), up.add(y2(i));
    }
    across.add(goal_x - radius), across.add(goal_x + radius), across.add(snapshot.number("X0"));
    up.add(goal_y - radius), up.add(goal_y + radius), up.add(snapshot.number("Y0"));
    const double margin = 0.04 * std::max(across.high - across.low, up.high - up.low);
    const Plane plane(area.above(18 + room_below).after(room_at_left), across.low - margin,
                      up.low - margin, across.high + margin, up.high + margin);
    canvas.fill(plane.box, rgb(0xf6f7f8), 4);
    field_ticks(canvas, plane);
    const Point goal = plane(goal_x, goal_y);
    canvas.disc(goal, plane.length(radius), rgb(0xbfe3d6));
    canvas.ring(goal, plane.length(radius), colors::green, 1.5);
    for (int i = 0; i < x1.count(0); ++i)
        canvas.line(plane(x1(i), y1(i)), plane(x2(i), y2(i)), colors::ink, 3);

    std::vector<Point> way;
    for (const Step& step : snapshot.steps())
        way.push_back(plane(snapshot.number_in(step, "x"), snapshot.number_in(step, "y")));
    trail(canvas, way, colors::blue);
    const Point car = way.back();
    const double vx = snapshot.number("vx"), vy = snapshot.number("vy");
    const double reach = 60 / std::max({1.0, std::abs(vx), std::abs(vy)});
    if (std::hypot(vx, vy) > 1e-6)
        arrow(canvas, car, {car.x + vx * reach, car.y - vy * reach}, colors::sky, 2.5);
    if (snapshot.acts()) {
        const double most = snapshot.number_or("MAX-F", 1);
        const double fx = snapshot.number("fx") / most, fy = snapshot.number("fy") / most;
        arrow(canvas, car, {car.x + fx * 26, car.y - fy * 26}, colors::vermilion, 2.5);
    }
    canvas.disc(car, 6.5, colors::blue);
    const Entry entries[] = {
        {"goal", colors::green}, {"velocity", colors::sky}, {"force", colors::vermilion}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{
    "race_car",
    "the walls, the goal, the car with its velocity and force, its way",
    {"racecar"},
    {"x", "y", "vx", "vy", "fx", "fy", "X1", "Y1", "X2", "Y2", "GX", "GY", "X0", "Y0", "RADIUS"},
    draw};

}  // namespace rddl::render::race_car
