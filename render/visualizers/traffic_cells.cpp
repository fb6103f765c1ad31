// Roads of cells that cross at lights. Where roads lie follows from which cells flow into which: a
// road goes from the left to the right if it enters its crossings from the west, else down.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rddl::render::traffic_cells {

namespace {

struct Road {
    std::vector<int> cells;                   // as cars drive
    std::vector<std::pair<int, int>> lights;  // after which cell there is which crossing
    bool is_across = false;                   // from west to east
};

std::optional<int> crossing_after(const Values& enters, int cell) {
    for (int i = 0; i < enters.count(1); ++i)
        if (enters.is(cell, i)) return i;
    return {};
}

std::vector<Road> roads(const Snapshot& snapshot) {
    const Values& flows = snapshot["FLOWS-INTO-CELL"];
    const Values& across = snapshot["FLOWS-INTO-INTERSECTION-EW"];
    const Values& down = snapshot["FLOWS-INTO-INTERSECTION-NS"];
    const int count = flows.count(0);
    const auto next = [&](int cell) {
        for (int b = 0; b < count; ++b)
            if (flows.is(cell, b)) return b;
        return -1;
    };
    std::vector<Road> all;
    for (int first = 0; first < count; ++first) {
        bool begins = true;
        for (int a = 0; a < count; ++a) begins = begins && !flows.is(a, first);
        if (!begins) continue;
        Road road;
        for (int cell = first; cell >= 0 && static_cast<int>(road.cells.size()) < count;
             cell = next(cell)) {
            road.cells.push_back(cell);
            const auto place = static_cast<int>(road.cells.size()) - 1;
            if (const auto light = crossing_after(across, cell)) {
                road.is_across = true;
                road.lights.push_back({place, *light});
            } else if (const auto other = crossing_after(down, cell)) {
                road.lights.push_back({place, *other});
            }
        }
        all.push_back(std::move(road));
    }
    return all;
}

// Crossings stand where roads meet: in the column of the road down, in the row of that across.
// Their order along one road is that of the others.
struct Town {
    std::vector<Road> roads;
    std::vector<Point> crossings;  // in cells
    double width = 1, height = 1;  // cells
};

Town town_of(const Snapshot& snapshot) {
    Town town{roads(snapshot), {}};
    town.crossings.resize(static_cast<std::size_t>(snapshot["light-signal1"].count(0)), {1, 1});
    for (const Road& road : town.roads) {
        // Crossings take the room of a cell.
        for (std::size_t k = 0; k < road.lights.size(); ++k) {
            const auto [place, light] = road.lights[k];
            const double along = place + 1.0 + static_cast<double>(k);
            Point& at = town.crossings[static_cast<std::size_t>(light)];
            (road.is_across ? at.x : at.y) = along;
        }
        const double length = static_cast<double>(road.cells.size() + road.lights.size());
        double& size = road.is_across ? town.width : town.height;
        size = std::max(size, length);
    }
    return town;
}

void draw_cell(Canvas& canvas, const Box& box, bool occupied, bool is_across) {
    canvas.fill(box.inset(0.8), rgb(0xd5dae0), 2);
    if (!occupied) return;
    const Box car = is_across ? box.fitted(1, 1).inset(box.width * 0.16, box.height * 0.26)
                              : box.fitted(1, 1).inset(box.width * 0.26, box.height * 0.16);
    canvas.fill(car, colors::blue, 3);
}

void draw_light(Canvas& canvas, const Box& box, bool across, bool down, bool advances) {
    canvas.fill(box, rgb(0x9aa3ae), 2);
    const Point c = box.center();
    const double r = box.width * 0.4;
    const auto direction = [&](bool open, Point from, Point to) {
        if (open)
            arrow(canvas, from, to, colors::green, box.width * 0.12);
        else
            canvas.line(from, to, colors::vermilion, box.width * 0.08);
    };
    if (!down) direction(across, {c.x - r, c.y}, {c.x + r, c.y});
    if (!across) direction(down, {c.x, c.y - r}, {c.x, c.y + r});
    if (advances) canvas.outline(box.inset(-1.5), colors::orange, 2.5, 3);
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Town town = town_of(snapshot);
    const Grid grid(area.above(20), static_cast<int>(town.width), static_cast<int>(town.height));
    const auto box_at = [&](double x, double y) {
        return grid.cell(static_cast<int>(x), static_cast<int>(y));
    };
    const Values& occupied = snapshot["occupied"];
    double empty_row = 0;
    for (const Road& road : town.roads) {
        // A road without lights has no place of its own.
        const Point line = road.lights.empty()
                               ? Point{empty_row, empty_row}
                               : town.crossings[static_cast<std::size_t>(road.lights[0].second)];
        if (road.lights.empty()) ++empty_row;
        double along = 0;
        std::size_t passed = 0;
        for (std::size_t k = 0; k < road.cells.size(); ++k, ++along) {
            draw_cell(canvas, road.is_across ? box_at(along, line.y) : box_at(line.x, along),
                      occupied.is(road.cells[k]), road.is_across);
            if (passed < road.lights.size() && road.lights[passed].first == static_cast<int>(k)) {
                ++along;
                ++passed;
            }
        }
    }
    const Values &one = snapshot["light-signal1"], &two = snapshot["light-signal2"];
    for (int i = 0; i < one.count(0); ++i) {
        const Point at = town.crossings[static_cast<std::size_t>(i)];
        draw_light(canvas, box_at(at.x, at.y), one.is(i) && !two.is(i), two.is(i) && !one.is(i),
                   snapshot.acts() && snapshot["advance"].is(i));
    }
    const Entry entries[] = {{"car", colors::blue},
                             {"green light", colors::green},
                             {"all red", colors::vermilion},
                             {"light advances", colors::orange}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{
    "traffic_cells",
    "roads of cells with cars, and lights where they cross",
    {"traffic_mdp", "traffic_pomdp"},
    {"occupied", "light-signal1", "light-signal2", "advance", "FLOWS-INTO-CELL",
     "FLOWS-INTO-INTERSECTION-NS", "FLOWS-INTO-INTERSECTION-EW"},
    draw};

}  // namespace rddl::render::traffic_cells
