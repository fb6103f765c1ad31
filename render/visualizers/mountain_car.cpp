// A car between two hills, and the flag that it has to reach. The valley is what the instance says:
// its segments, or the sine of Moore's problem (A. Moore, Efficient memory-based learning for robot
// control, Cambridge 1990).
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::mountain_car {

namespace {

std::vector<Point> valley(const Snapshot& snapshot) {
    std::vector<Point> line;
    if (snapshot.has("X-START|LEFT-X")) {
        const Values &x0 = snapshot["X-START|LEFT-X"], &y0 = snapshot["Y-START|LEFT-Y"];
        const Values &x1 = snapshot["X-END|RIGHT-X"], &y1 = snapshot["Y-END|RIGHT-Y"];
        for (int i = 0; i < x0.count(0); ++i) {
            line.push_back({x0(i), y0(i)});
            line.push_back({x1(i), y1(i)});
        }
        std::stable_sort(line.begin(), line.end(), [](Point a, Point b) { return a.x < b.x; });
        return line;
    }
    const double low = snapshot.number("MIN-POS"), high = snapshot.number("MAX-POS");
    const double depth = snapshot.number_or("DEPTH", 0);
    for (int i = 0; i <= 100; ++i) {
        const double x = low + (high - low) * i / 100;
        line.push_back({x, depth * std::sin(3 * x)});
    }
    return line;
}

// The height and the slope at x.
struct Ground {
    double height = 0, slope = 0;
};

Ground ground_at(const std::vector<Point>& line, double x) {
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Point a = line[i - 1], b = line[i];
        if (x > b.x && i + 1 < line.size()) continue;
        if (b.x - a.x < 1e-12) continue;
        const double slope = (b.y - a.y) / (b.x - a.x);
        return {a.y + slope * (x - a.x), slope};
    }
    return {};
}

void draw_flag(Canvas& canvas, Point foot) {
    canvas.line(foot, {foot.x, foot.y - 46}, colors::ink, 2);
    const Point cloth[] = {
        {foot.x, foot.y - 46}, {foot.x + 24, foot.y - 38}, {foot.x, foot.y - 30}};
    canvas.polygon(cloth, colors::orange);
}

void draw_car(Canvas& canvas, Point place, double slope, double push) {
    const Canvas::Saved saved = canvas.moved(place, -std::atan(slope));
    canvas.fill({-20, -19, 40, 11}, colors::blue, 4);
    canvas.fill({-11, -27, 22, 10}, colors::blue, 4);
    canvas.fill({-8, -25, 16, 6}, colors::paper.with_alpha(0.8), 2);
    for (const double wheel : {-12.0, 12.0}) {
        canvas.disc({wheel, -6}, 6, colors::ink);
        canvas.disc({wheel, -6}, 2.4, colors::rule);
    }
    const double side = push > 0 ? 1 : -1;
    if (push != 0)
        arrow(canvas, {side * 24, -14}, {side * (28 + 22 * std::min(std::abs(push), 1.0)), -14},
              colors::vermilion, 3);
}

void draw_velocity(Canvas& canvas, const Box& box, double velocity, double most) {
    label(canvas, box.left(60), "velocity", {.size = 11, .color = colors::muted});
    const Box bar = box.after(62).before(70).inset(0, 4);
    canvas.fill(bar, colors::faint, 3);
    const Scale scale{-most, most, bar.x, bar.right()};
    const double zero = scale(0), now = scale.clamped(velocity);
    canvas.fill({std::min(zero, now), bar.y, std::abs(now - zero), bar.height}, colors::sky);
    canvas.line({zero, bar.y - 2}, {zero, bar.bottom() + 2}, colors::muted);
    label(canvas, box.rightmost(62), number_text(velocity), {.size = 11, .align = Align::Right});
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const std::vector<Point> line = valley(snapshot);
    double lowest = line.front().y, highest = lowest;
    for (const Point point : line) {
        lowest = std::min(lowest, point.y);
        highest = std::max(highest, point.y);
    }
    highest = std::max(highest, lowest + 1e-6);
    const double width = line.back().x - line.front().x;
    const Box view = area.above(24);
    // All of the width, and as much of the height as there is, but hills no steeper than they are.
    const Scale x{line.front().x - 0.03 * width, line.back().x + 0.06 * width, view.x,
                  view.right()};
    const double bottom = lowest - 0.15 * (highest - lowest),
                 top = highest + 0.45 * (highest - lowest);
    const double factor = std::min(view.height / (top - bottom), view.width / (1.09 * width));
    const auto place = [&](double at, double height) {
        return Point{x(at), view.bottom() - (height - bottom) * factor};
    };
    std::vector<Point> earth{{view.x, view.bottom()}, {view.x, place(0, line.front().y).y}};
    for (const Point point : line) earth.push_back(place(point.x, point.y));
    earth.push_back({view.right(), earth.back().y});
    earth.push_back({view.right(), view.bottom()});
    canvas.fill(view, rgb(0xf2f8fd));
    canvas.polygon(earth, rgb(0xd9e3d0));
    canvas.polyline(std::span(earth).subspan(1, line.size() + 2), rgb(0xa9b99c), 1.5);
    canvas.polyline(std::span(earth).subspan(2, line.size()), rgb(0x6f8a5f), 2.5);

    const double goal = snapshot.number("GOAL-MIN|FLAG"),
                 position = snapshot.number("pos|position");
    draw_flag(canvas, place(goal, ground_at(line, goal).height));
    const Ground ground = ground_at(line, position);
    const double push = snapshot.acts() ? snapshot.number("action|throttle") -
                                              snapshot.default_of("action|throttle")
                                        : 0;
    const double drawn_slope = ground.slope * factor * 1.09 * width / view.width;
    draw_car(canvas, place(position, ground.height), drawn_slope, push);
    draw_velocity(canvas, area.lowest(18), snapshot.number("vel|velocity"),
                  snapshot.number_or("MAX-VEL|MAX-SPEED", 0.07));
}

}  // namespace

const Visualizer visualizer{
    "mountain_car",
    "the valley, the car with its push, and the flag at the goal",
    {"mountain_car"},
    {"pos|position", "vel|velocity", "action|throttle", "X-START|LEFT-X|MIN-POS", "GOAL-MIN|FLAG"},
    draw};

}  // namespace rddl::render::mountain_car
