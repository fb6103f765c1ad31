// The puzzle of eight squares, or of fewer: green where a square is at its place.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>

namespace rddl::render::sliding_squares {

namespace {

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &at = snapshot["at"], &target = snapshot["TARGET"];
    const int columns = at.count(1), rows = at.count(2);
    const Grid grid(area.above(20), columns, rows);
    canvas.fill(grid.box.inset(-4), rgb(0x5b6470), 6);
    for (int x = 0; x < columns; ++x)
        for (int y = 0; y < rows; ++y) {
            const Box cell = grid.cell(x, y);
            canvas.fill(cell.inset(1), rgb(0x7b8490), 4);
            for (int s = 0; s < at.count(0); ++s) {
                if (!at.is(s, x, y)) continue;
                const bool home = target.is(s, x, y);
                canvas.fill(cell.inset(3), home ? colors::green : rgb(0xf1ece4), 6);
                canvas.text(cell.center(), at.object(0, s),
                            {.size = std::min(cell.height * 0.4, 40.0),
                             .color = home ? colors::white : colors::ink,
                             .align = Align::Center});
            }
            if (snapshot.acts() && snapshot["activate"].is(x, y))
                canvas.outline(cell.inset(3), colors::vermilion, 4, 6);
        }
    const Entry entries[] = {{"at its place", colors::green},
                             {"elsewhere", rgb(0xf1ece4)},
                             {"pushed", colors::vermilion}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{"sliding_squares",
                            "squares at their places or elsewhere, and which is pushed",
                            {"eight"},
                            {"at", "TARGET", "activate"},
                            draw};

}  // namespace rddl::render::sliding_squares
