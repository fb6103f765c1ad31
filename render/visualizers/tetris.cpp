// The board, and the shape that is to be placed, turned and moved as the action says.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

namespace rddl::render::tetris {

namespace {

void draw_block(Canvas& canvas, const Box& cell, Color color) {
    canvas.fill(cell.inset(1), color, 3);
    canvas.fill(cell.inset(1).top(cell.height * 0.18), colors::white.with_alpha(0.3), 3);
}

int current_shape(const Snapshot& snapshot) {
    const Values& current = snapshot["current-shape-type"];
    for (int s = 0; s < current.count(0); ++s)
        if (current.is(s)) return s;
    return -1;
}

void draw_shape(Canvas& canvas, const Box& box, const Snapshot& snapshot, int shape, int turn) {
    const Values& shapes = snapshot["SHAPES"];
    const Grid grid(box, shapes.count(2), shapes.count(3));
    for (int x = 0; x < grid.columns; ++x)
        for (int y = 0; y < grid.rows; ++y)
            if (shapes.is(shape, turn, x, y))
                draw_block(canvas, grid.cell(x, grid.rows - 1 - y), colors::orange);
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values& filled = snapshot["filled"];
    const int columns = filled.count(0), rows = filled.count(1);
    const Box body = area.below(16);
    const Grid board(body.before(190), columns, rows);
    canvas.fill(board.box.inset(-4), rgb(0x2b3440), 4);
    for (int x = 0; x < columns; ++x)
        for (int y = 0; y < rows; ++y) {
            const Box cell = board.cell(x, rows - 1 - y);
            if (filled.is(x, y))
                draw_block(canvas, cell, colors::sky);
            else
                canvas.fill(cell.inset(1), rgb(0x38434f), 2);
        }
    const bool acts = snapshot.acts();
    for (int x = 0; x < columns && acts; ++x) {
        if (!snapshot["place"].is(x)) continue;
        const double middle = board.cell(x, 0).center().x;
        arrow(canvas, {middle, board.box.y - 20}, {middle, board.box.y - 5}, colors::vermilion, 3);
    }
    const Box side = body.rightmost(170);
    const int shape = current_shape(snapshot);
    canvas.text({side.x, side.y + 6}, "next shape", {.size = 11, .color = colors::muted});
    if (shape >= 0) draw_shape(canvas, side.below(20).top(110), snapshot, shape, 0);
    if (shape >= 0 && acts) {
        const auto turn = static_cast<int>(snapshot.number("rotate"));
        canvas.text(
            {side.x, side.y + 150},
            std::string("placed, turned by ") + snapshot["rotate"].range()->objects[turn] + "°",
            {.size = 11, .color = colors::muted});
        draw_shape(canvas, side.below(164).top(110), snapshot, shape, turn);
    }
    if (snapshot.has("game-over") && snapshot["game-over"].is())
        canvas.text(board.box.center(), "game over",
                    {.size = 24, .color = colors::yellow, .align = Align::Center});
}

}  // namespace

const Visualizer visualizer{"tetris",
                            "the board, the next shape, and how it is placed",
                            {"tetris"},
                            {"filled", "current-shape-type", "place", "rotate", "SHAPES"},
                            draw};

}  // namespace rddl::render::tetris
