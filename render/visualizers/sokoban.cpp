// A man in a storehouse who pushes boxes to their places.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <string_view>

namespace rddl::render::sokoban {

namespace {

void draw_box(Canvas& canvas, const Box& cell, bool stored) {
    const Box box = cell.inset(cell.width * 0.14);
    canvas.fill(box, stored ? colors::green : colors::orange, 3);
    const Color edge = stored ? rgb(0x005f45) : rgb(0x8f6300);
    canvas.outline(box, edge, 2, 3);
    canvas.line({box.x, box.y}, {box.right(), box.bottom()}, edge, 1.5);
    canvas.line({box.x, box.bottom()}, {box.right(), box.y}, edge, 1.5);
}

void draw_move(Canvas& canvas, const Box& cell, const Snapshot& snapshot) {
    const Values& move = snapshot["move"];
    const std::string_view direction = move.range()->objects[static_cast<int>(move())];
    const double x = direction == "l" ? -1 : direction == "r" ? 1 : 0;
    const double y = direction == "u" ? -1 : direction == "d" ? 1 : 0;
    const Point c = cell.center();
    arrow(canvas, {c.x + x * cell.width * 0.32, c.y + y * cell.height * 0.32},
          {c.x + x * cell.width * 0.75, c.y + y * cell.height * 0.75}, colors::vermilion, 3);
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &wall = snapshot["WALL"], &storage = snapshot["STORAGE"];
    const Values &box = snapshot["box"], &man = snapshot["man"];
    const Grid grid(area.above(20), wall.count(0), wall.count(1));
    // y grows upwards, as the domain's "above" says.
    const auto cell_of = [&](int x, int y) {
        return grid.cell(x, grid.rows - 1 - y);
    };
    for (int x = 0; x < grid.columns; ++x)
        for (int y = 0; y < grid.rows; ++y) {
            const Box cell = cell_of(x, y);
            canvas.fill(cell.inset(0.5), wall.is(x, y) ? rgb(0x5b6470) : rgb(0xf1ece4));
            if (storage.is(x, y)) canvas.ring(cell.center(), cell.width * 0.22, colors::green, 3);
            if (box.is(x, y)) draw_box(canvas, cell, storage.is(x, y));
        }
    for (int x = 0; x < grid.columns; ++x)
        for (int y = 0; y < grid.rows; ++y) {
            if (!man.is(x, y)) continue;
            const Box cell = cell_of(x, y);
            person(canvas, {cell.center().x, cell.bottom() - cell.height * 0.12},
                   cell.height * 0.76, colors::blue);
            if (snapshot.acts()) draw_move(canvas, cell, snapshot);
        }
    const Entry entries[] = {{"box", colors::orange},
                             {"stored, or where to store", colors::green},
                             {"wall", rgb(0x5b6470)}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{"sokoban",
                            "walls, boxes and where they belong, the man and his move",
                            {"sokoban"},
                            {"WALL", "STORAGE", "box", "man", "move"},
                            draw};

}  // namespace rddl::render::sokoban
