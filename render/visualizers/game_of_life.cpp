// Conway's cells, those that are set by hand, and how likely each is to do what it should not.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

namespace rddl::render::game_of_life {

namespace {

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &alive = snapshot["alive"], &noise = snapshot["NOISE-PROB"];
    const int columns = alive.count(0), rows = alive.count(1);
    const Grid grid(area.above(20), columns, rows);
    for (int x = 0; x < columns; ++x)
        for (int y = 0; y < rows; ++y) {
            const Box cell = grid.cell(x, rows - 1 - y).inset(1);
            canvas.fill(cell, mix(colors::faint, rgb(0xf3d9b8), std::min(noise(x, y) * 4, 1.0)), 3);
            if (alive.is(x, y)) canvas.fill(cell.inset(cell.width * 0.12), colors::blue, 5);
            if (snapshot.acts() && snapshot["set"].is(x, y))
                canvas.outline(cell, colors::vermilion, 3, 3);
        }
    const Entry entries[] = {{"alive", colors::blue},
                             {"set", colors::vermilion},
                             {"noise, stronger where darker", rgb(0xf3d9b8)}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{"game_of_life",
                            "cells that are alive, those that are set, and their noise",
                            {"game_of_life_mdp", "game_of_life_pomdp"},
                            {"alive", "set", "NOISE-PROB"},
                            draw};

}  // namespace rddl::render::game_of_life
