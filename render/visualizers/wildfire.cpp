// A forest of cells that burn, have burnt or may burn, those worth most, and what is done there.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>

namespace rddl::render::wildfire {

namespace {

void draw_flame(Canvas& canvas, const Box& cell) {
    const Point c = cell.center();
    const double r = cell.height * 0.34;
    const Point flame[] = {{c.x, c.y - r * 1.25},
                           {c.x + r * 0.55, c.y - r * 0.1},
                           {c.x + r * 0.85, c.y - r * 0.35},
                           {c.x + r * 0.7, c.y + r * 0.9},
                           {c.x - r * 0.7, c.y + r * 0.9},
                           {c.x - r * 0.85, c.y - r * 0.1},
                           {c.x - r * 0.3, c.y + r * 0.05}};
    canvas.polygon(flame, colors::vermilion);
    const Point core[] = {
        {c.x, c.y - r * 0.2}, {c.x + r * 0.35, c.y + r * 0.8}, {c.x - r * 0.35, c.y + r * 0.8}};
    canvas.polygon(core, colors::yellow);
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &burning = snapshot["burning"], &empty = snapshot["out-of-fuel"];
    const Values& target = snapshot["TARGET"];
    const int columns = burning.count(0), rows = burning.count(1);
    const Grid grid(area.above(34).after(30), columns, rows);
    const double narrowest = std::min(grid.cell(0, 0).width, grid.cell(0, 0).height);
    for (int x = 0; x < columns && narrowest >= 14; ++x)
        label(canvas, Box{grid.cell(x, 0).x, grid.box.bottom() + 2, grid.cell(x, 0).width, 12},
              burning.object(0, x), {.size = 9, .color = colors::muted, .align = Align::Center});
    for (int y = 0; y < rows && narrowest >= 14; ++y)
        label(canvas,
              Box{grid.box.x - 34, grid.cell(0, rows - 1 - y).y, 30, grid.cell(0, 0).height},
              burning.object(1, y), {.size = 9, .color = colors::muted, .align = Align::Right});
    for (int x = 0; x < columns; ++x)
        for (int y = 0; y < rows; ++y) {
            const Box cell = grid.cell(x, rows - 1 - y).inset(1);
            canvas.fill(cell, empty.is(x, y) ? rgb(0xb9b4ae) : rgb(0xbfe3d6), 3);
            if (burning.is(x, y)) draw_flame(canvas, cell);
            if (target.is(x, y)) canvas.outline(cell.inset(1.5), colors::blue, 3, 3);
            if (!snapshot.acts()) continue;
            const double d = cell.width * 0.36;
            const Point c = cell.center();
            if (snapshot["put-out"].is(x, y)) canvas.ring(c, d * 1.2, colors::sky, 3);
            if (snapshot["cut-out"].is(x, y)) {
                canvas.line({c.x - d, c.y - d}, {c.x + d, c.y + d}, colors::ink, 3);
                canvas.line({c.x - d, c.y + d}, {c.x + d, c.y - d}, colors::ink, 3);
            }
        }
    const Entry entries[] = {{"forest", rgb(0xbfe3d6)},  {"burning", colors::vermilion},
                             {"no fuel", rgb(0xb9b4ae)}, {"target", colors::blue},
                             {"put out", colors::sky},   {"cut out", colors::ink}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{"wildfire",
                            "cells that burn or may burn, targets, and what is done",
                            {"wildfire_mdp", "wildfire_pomdp"},
                            {"burning", "out-of-fuel", "TARGET", "put-out", "cut-out"},
                            draw};

}  // namespace rddl::render::wildfire
