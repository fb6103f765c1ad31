// A robot on a grid, on its way to a goal: past cells in which it may vanish (Navigation), or past
// obstacles that drive by (Crossing Traffic).
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::robot_grid {

namespace {

void draw_robot(Canvas& canvas, const Box& cell) {
    const Box body = cell.square().inset(cell.square().width * 0.2);
    canvas.fill(body, colors::blue, body.width * 0.2);
    for (const double side : {0.3, 0.7})
        canvas.disc({body.x + body.width * side, body.y + body.height * 0.38}, body.width * 0.1,
                    colors::white);
    canvas.line({body.x + body.width * 0.3, body.y + body.height * 0.7},
                {body.x + body.width * 0.7, body.y + body.height * 0.7}, colors::white,
                body.width * 0.07);
}

void draw_move(Canvas& canvas, const Box& cell, const Snapshot& snapshot) {
    struct Direction {
        const char* fluent;
        double x, y;
    };
    const Point c = cell.center();
    for (const auto& [fluent, x, y] :
         {Direction{"move-north", 0, -1}, Direction{"move-south", 0, 1},
          Direction{"move-east", 1, 0}, Direction{"move-west", -1, 0}})
        if (snapshot.has(fluent) && snapshot[fluent].is())
            arrow(canvas, {c.x + x * cell.width * 0.3, c.y + y * cell.height * 0.3},
                  {c.x + x * cell.width * 0.72, c.y + y * cell.height * 0.72}, colors::vermilion,
                  3);
}

struct Map {
    std::vector<int> column, row;  // of each x and y; row 0 is at the top, the north
    Grid grid;

    Box cell(int x, int y) const {
        return grid.cell(column[static_cast<std::size_t>(x)], row[static_cast<std::size_t>(y)]);
    }
};

Map map_of(const Box& area, const Snapshot& snapshot) {
    const std::vector<int> column = order_of(snapshot["EAST"]);
    std::vector<int> row = order_of(snapshot["NORTH"]);
    const int rows = static_cast<int>(row.size());
    for (int& r : row) r = rows - 1 - r;
    return {column, row, Grid(area, static_cast<int>(column.size()), rows)};
}

void draw_goal(Canvas& canvas, const Box& cell) {
    canvas.outline(cell.inset(3), colors::green, 3, 3);
    canvas.text({cell.center().x, cell.bottom() - 10}, "goal",
                {.size = std::min(11.0, cell.height * 0.3),
                 .color = colors::green,
                 .align = Align::Center});
}

// The robot where it is, and `ground` for each cell.
void draw_world(Canvas& canvas, const Box& area, const Snapshot& snapshot, auto ground) {
    const Map map = map_of(area, snapshot);
    const Values &robot = snapshot["robot-at"], &goal = snapshot["GOAL"];
    for (int x = 0; x < robot.count(0); ++x)
        for (int y = 0; y < robot.count(1); ++y) {
            const Box cell = map.cell(x, y);
            ground(cell.inset(1), x, y);
            if (goal.is(x, y)) draw_goal(canvas, cell);
        }
    bool is_there = false;
    for (int x = 0; x < robot.count(0); ++x)
        for (int y = 0; y < robot.count(1); ++y) {
            if (!robot.is(x, y)) continue;
            is_there = true;
            draw_robot(canvas, map.cell(x, y));
            if (snapshot.acts()) draw_move(canvas, map.cell(x, y), snapshot);
        }
    if (!is_there)
        canvas.text({area.right(), area.y + 8}, "the robot is gone",
                    {.size = 12, .color = colors::vermilion, .align = Align::Right});
}

void draw_navigation(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values& danger = snapshot["P"];
    draw_world(canvas, area.above(20), snapshot, [&](const Box& cell, int x, int y) {
        const Color color = mix(rgb(0xf3f5f7), rgb(0x8a5a2b), danger(x, y));
        canvas.fill(cell, color, 3);
        if (danger(x, y) > 0.005 && cell.width > 30)
            canvas.text({cell.x + 4, cell.y + 9}, number_text(std::round(danger(x, y) * 100)) + "%",
                        {.size = 9, .color = text_on(color)});
    });
    const Entry entries[] = {{"likely to vanish there: never", rgb(0xf3f5f7)},
                             {"always", rgb(0x8a5a2b)},
                             {"move", colors::vermilion}};
    legend(canvas, area.lowest(14), entries);
}

void draw_crossing(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values& obstacle = snapshot["obstacle-at"];
    draw_world(canvas, area.above(20), snapshot, [&](const Box& cell, int x, int y) {
        const bool is_road = !snapshot["MIN-YPOS"].is(y) && !snapshot["MAX-YPOS"].is(y);
        canvas.fill(cell, is_road ? rgb(0xdfe3e8) : rgb(0xe3efdc), 3);
        if (!obstacle.is(x, y)) return;
        const Box car = cell.inset(cell.width * 0.12, cell.height * 0.26);
        canvas.fill(car, colors::orange, 4);
        for (const double side : {0.25, 0.75})
            canvas.disc({car.x + car.width * side, car.bottom()}, car.height * 0.2, colors::ink);
    });
    const Entry entries[] = {
        {"robot", colors::blue}, {"obstacle", colors::orange}, {"move", colors::vermilion}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{"navigation_grid",
                            "the robot, the goal, and how likely it vanishes in each cell",
                            {"navigation_mdp", "navigation_pomdp"},
                            {"robot-at", "GOAL", "P", "NORTH", "EAST"},
                            draw_navigation};

const Visualizer visualizer_of_crossing{
    "crossing_traffic",
    "the robot, the goal, and obstacles that drive by",
    {"crossing_traffic_mdp", "crossing_traffic_pomdp"},
    {"robot-at", "obstacle-at", "GOAL", "NORTH", "EAST", "MIN-YPOS", "MAX-YPOS"},
    draw_crossing};

}  // namespace rddl::render::robot_grid
