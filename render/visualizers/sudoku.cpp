// A sudoku: given numbers, those that were filled in, and where they contradict each other.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>

namespace rddl::render::sudoku {

namespace {

bool same_block(const Snapshot& snapshot, int r1, int c1, int r2, int c2) {
    const Values &rows = snapshot["SHARED_R"], &columns = snapshot["SHARED_C"];
    const auto shared = [](const Values& values, int a, int b) {
        return a == b || values.is(a, b) || values.is(b, a);
    };
    return shared(rows, r1, r2) && shared(columns, c1, c2);
}

bool contradicts(const Snapshot& snapshot, int row, int column) {
    const Values& board = snapshot["board"];
    const double number = board(row, column);
    for (int r = 0; r < board.count(0) && number != 0; ++r)
        for (int c = 0; c < board.count(1); ++c) {
            if ((r == row && c == column) || board(r, c) != number) continue;
            if (r == row || c == column || same_block(snapshot, row, column, r, c)) return true;
        }
    return false;
}

// Thick between blocks.
void draw_lines(Canvas& canvas, const Grid& grid, const Snapshot& snapshot) {
    const auto thickness = [](bool thick) {
        return thick ? 3.0 : 0.8;
    };
    for (int r = 0; r <= grid.rows; ++r) {
        const bool edge = r == 0 || r == grid.rows || !same_block(snapshot, r - 1, 0, r, 0);
        const double y = grid.box.y + grid.box.height * r / grid.rows;
        canvas.line({grid.box.x, y}, {grid.box.right(), y}, colors::ink, thickness(edge));
    }
    for (int c = 0; c <= grid.columns; ++c) {
        const bool edge = c == 0 || c == grid.columns || !same_block(snapshot, 0, c - 1, 0, c);
        const double x = grid.box.x + grid.box.width * c / grid.columns;
        canvas.line({x, grid.box.y}, {x, grid.box.bottom()}, colors::ink, thickness(edge));
    }
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &board = snapshot["board"], &fixed = snapshot["FIXED"];
    const Grid grid(area.above(22), board.count(1), board.count(0));
    for (int r = 0; r < grid.rows; ++r)
        for (int c = 0; c < grid.columns; ++c) {
            const Box cell = grid.cell(c, r);
            if (contradicts(snapshot, r, c)) canvas.fill(cell, rgb(0xfad4bd));
            const TextStyle style{.size = cell.height * 0.5,
                                  .color = fixed.is(r, c) ? colors::ink : colors::blue,
                                  .align = Align::Center};
            if (board(r, c) != 0) canvas.text(cell.center(), number_text(board(r, c)), style);
            if (snapshot.acts() && snapshot["fill"](r, c) != 0) {
                canvas.outline(cell.inset(3), colors::orange, 3, 3);
                canvas.text({cell.right() - 9, cell.y + 9}, number_text(snapshot["fill"](r, c)),
                            {.size = std::min(cell.height * 0.3, 14.0),
                             .color = rgb(0x8f6300),
                             .align = Align::Center});
            }
        }
    draw_lines(canvas, grid, snapshot);
    const Entry entries[] = {{"given", colors::ink},
                             {"filled in", colors::blue},
                             {"contradiction", rgb(0xfad4bd)},
                             {"filled next", colors::orange}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{"sudoku",
                            "given numbers, those filled in, contradictions",
                            {"sudoku"},
                            {"board", "FIXED", "fill", "SHARED_R", "SHARED_C"},
                            draw};

}  // namespace rddl::render::sudoku
