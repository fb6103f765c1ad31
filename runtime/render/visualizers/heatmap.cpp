// The values of a state as cells: columns are objects of the last parameter, rows those of the
// others. Unlike the chart it shows one state, so that neighbours of a grid are neighbours.
#include "render/panels.hpp"
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::heatmap {

namespace {

struct Shape {
    int rows, columns;
};

Shape shape_of(const Values& values) {
    const rddl_fluent& fluent = *values.fluent;
    const int columns = fluent.rank == 0 ? 1 : values.count(fluent.rank - 1);
    return {static_cast<int>(fluent.count) / columns, columns};
}

// The objects of all parameters but the last: "r1, c2".
std::string row_name(const Moment& moment, const Values& values, const Grid& grid, int row) {
    const std::string name = moment.world().name_of(*values.fluent, row * grid.columns);
    const std::size_t begin = name.find('(') + 1;
    return name.substr(begin, name.rfind(", ") - begin);
}

void draw_names(Canvas& canvas, const Grid& grid, const Moment& moment, const Values& values) {
    const TextStyle style{.size = 9, .color = colors::muted};
    const double row = grid.cell(0, 0).height, column = grid.cell(0, 0).width;
    const int every_row = static_cast<int>(std::ceil(10 / row));
    const int every_column = static_cast<int>(std::ceil(24 / column));
    for (int r = 0; r < grid.rows && values.fluent->rank > 1; r += every_row) {
        TextStyle right = style;
        right.align = Align::Right;
        canvas.text({grid.box.x - 4, grid.cell(0, r).center().y},
                    shortened(canvas, row_name(moment, values, grid, r), 9, 46), right);
    }
    for (int c = 0; c < grid.columns && values.fluent->rank > 0; c += every_column) {
        TextStyle center = style;
        center.align = Align::Center;
        canvas.text({grid.cell(c, 0).center().x, grid.box.bottom() + 8},
                    shortened(canvas, values.object(values.fluent->rank - 1, c), 9,
                              every_column * column - 2),
                    center);
    }
}

void draw_cells(Canvas& canvas, const Grid& grid, const Values& values, const Range& range) {
    std::vector<std::uint32_t> cells;
    for (const double value : values.numbers)
        cells.push_back(pixel_of(value_color(values, value, range)));
    canvas.cells(grid.box, grid.columns, grid.rows, cells);
    const Box first = grid.cell(0, 0);
    if (first.width >= 5 && first.height >= 5) {
        for (int c = 1; c < grid.columns; ++c)
            canvas.line({grid.cell(c, 0).x, grid.box.y}, {grid.cell(c, 0).x, grid.box.bottom()},
                        colors::paper);
        for (int r = 1; r < grid.rows; ++r)
            canvas.line({grid.box.x, grid.cell(0, r).y}, {grid.box.right(), grid.cell(0, r).y},
                        colors::paper);
    }
    canvas.outline(grid.box, colors::rule, 0.8);
    if (values.fluent->scalar == RDDL_BOOL || first.width < 26 || first.height < 12) return;
    for (int r = 0; r < grid.rows; ++r)
        for (int c = 0; c < grid.columns; ++c) {
            const auto g = static_cast<std::size_t>(r * grid.columns + c);
            label(canvas, grid.cell(c, r), value_text(values, g),
                  {.size = 10,
                   .color = text_on(value_color(values, values.numbers[g], range)),
                   .align = Align::Center});
        }
}

void draw_grid(Canvas& canvas, const Box& box, const Moment& moment, const rddl_fluent& fluent) {
    const Values& values = moment.values(fluent);
    const Range range = range_of(moment, fluent);
    canvas.text({box.x, box.y + 8}, shortened(canvas, fluent.name, 12, box.width * 0.75));
    if (fluent.scalar == RDDL_BOOL && fluent.rank == 0) {
        canvas.text({box.x, box.y + 26}, value_text(values, 0), {.color = colors::blue});
        return;
    }
    const Shape shape = shape_of(values);
    const Box inside = box.below(20).above(16).after(fluent.rank > 1 ? 50 : 0);
    const bool square = fluent.rank >= 2;
    const Box used = shape.rows == 1 ? inside.top(std::min(inside.height, 40.0)) : inside;
    const Grid grid(used, shape.columns, shape.rows, square);
    draw_cells(canvas, grid, values, range);
    draw_names(canvas, grid, moment, values);
}

void draw(Canvas& canvas, const Box& area, const Moment& moment) {
    // Grids get the room; fluents with fewer parameters stand below them.
    std::vector<const rddl_fluent*> grids, strips;
    for (const rddl_fluent* const fluent : state_fluents(moment.problem()))
        (fluent->rank >= 2 ? grids : strips).push_back(fluent);
    constexpr std::size_t most_strips = 12;
    if (strips.size() > most_strips) strips.resize(most_strips);
    const std::size_t columns = std::min<std::size_t>(strips.size(), strips.size() > 4 ? 4 : 2);
    const std::size_t rows = columns == 0 ? 0 : (strips.size() + columns - 1) / columns;
    const double strips_height =
        grids.empty() ? area.height : std::min(static_cast<double>(rows) * 66, area.height * 0.5);
    const std::vector<Box> grid_boxes =
        panel_boxes(area.above(strips_height), grids.size(), 1.2, 14);
    for (std::size_t i = 0; i < grids.size(); ++i)
        draw_grid(canvas, grid_boxes[i], moment, *grids[i]);
    const double shape = rows == 0 ? 1
                                   : (area.width / static_cast<double>(columns)) /
                                         (strips_height / static_cast<double>(rows));
    const std::vector<Box> strip_boxes =
        panel_boxes(area.lowest(strips_height), strips.size(), shape, 10);
    for (std::size_t i = 0; i < strips.size(); ++i)
        draw_grid(canvas, strip_boxes[i], moment, *strips[i]);
}

}  // namespace

const Visualizer visualizer{"heatmap", "the values of a state as a grid of cells", {}, {}, draw};

}  // namespace rddl::render::heatmap
