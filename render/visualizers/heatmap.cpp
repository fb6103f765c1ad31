// The values of a state as cells: columns are objects of the last parameter, rows those of the
// others; many objects of a single parameter stand in several rows. Unlike the chart it shows one
// state, so that neighbours of a grid are neighbours.
#include "render/panels.hpp"
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::heatmap {

namespace {

constexpr double names_size = 9;

struct Shape {
    int rows, columns;
    bool wrapped = false;  // objects of one parameter continue in the next row
};

Shape shape_of(const Values& values, const Box& box) {
    const rddl_fluent& fluent = *values.fluent;
    const auto count = static_cast<int>(fluent.count);
    constexpr double narrowest = 12;
    if (fluent.rank == 0) return {1, 1};
    if (fluent.rank > 1)
        return {count / values.count(fluent.rank - 1), values.count(fluent.rank - 1)};
    if (box.width / count >= narrowest || box.height < 2 * narrowest) return {1, count};
    // Nearly squares, and rows of tens, which are easy to count in.
    const double wide = std::sqrt(count * box.width / box.height);
    const int columns = std::min(static_cast<int>(std::ceil(wide / 10)) * 10, count);
    return {(count + columns - 1) / columns, columns, true};
}

std::string row_name(const Snapshot& snapshot, const Values& values, const Shape& shape, int row) {
    const std::string name = objects_of(snapshot, *values.fluent, row * shape.columns);
    return shape.wrapped ? name : name.substr(0, name.rfind(", "));
}

bool has_row_names(const Values& values, const Shape& shape) {
    return values.fluent->rank > 1 || shape.wrapped;
}

// The room for the names of rows.
double row_names_width(const Canvas& canvas, const Snapshot& snapshot, const Values& values,
                       const Shape& shape) {
    if (!has_row_names(values, shape)) return 0;
    double widest = 0;
    const int every = std::max(shape.rows / 30, 1);
    for (int r = 0; r < shape.rows; r += every)
        widest =
            std::max(widest, canvas.text_width(row_name(snapshot, values, shape, r), names_size));
    return std::clamp(widest + 8, 12.0, 72.0);
}

void draw_row_names(Canvas& canvas, const Grid& grid, const Snapshot& snapshot,
                    const Values& values, const Shape& shape) {
    const int every = static_cast<int>(std::ceil(10 / grid.cell(0, 0).height));
    for (int r = 0; r < grid.rows; r += every)
        canvas.text({grid.box.x - 4, grid.cell(0, r).center().y},
                    shortened_name(canvas, row_name(snapshot, values, shape, r), names_size, 64),
                    {.size = names_size, .color = colors::muted, .align = Align::Right});
}

// Draws as many names as fit beside each other.
void draw_column_names(Canvas& canvas, const Grid& grid, const Values& values) {
    const double column = grid.cell(0, 0).width;
    const auto name = [&](int c) {
        return values.object(values.fluent->rank - 1, c);
    };
    double widest = 0;
    for (int c = 0; c < grid.columns; c += std::max(grid.columns / 30, 1))
        widest = std::max(widest, canvas.text_width(name(c), names_size));
    const double room = std::clamp(widest + 6, 20.0, 70.0);
    const int every = static_cast<int>(std::ceil(room / column));
    for (int c = 0; c < grid.columns; c += every) {
        const std::string text = shortened_name(canvas, name(c), names_size, every * column - 2);
        const double half = canvas.text_width(text, names_size) / 2;
        const double x = std::max(grid.cell(c, 0).center().x, grid.box.x + half);
        canvas.text({x, grid.box.bottom() + 8}, text,
                    {.size = names_size, .color = colors::muted, .align = Align::Center});
    }
}

void draw_cells(Canvas& canvas, const Grid& grid, const Values& values, const Range& range) {
    std::vector<std::uint32_t> cells;
    for (const double value : values.numbers)
        cells.push_back(pixel_of(value_color(values, value, range)));
    // The last row may have fewer.
    cells.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                 pixel_of(colors::paper));
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
    for (std::size_t g = 0; g < values.numbers.size(); ++g) {
        const auto place = static_cast<int>(g);
        label(canvas, grid.cell(place % grid.columns, place / grid.columns), value_text(values, g),
              {.size = 10,
               .color = text_on(value_color(values, values.numbers[g], range)),
               .align = Align::Center});
    }
}

void draw_grid(Canvas& canvas, const Box& box, const Snapshot& snapshot,
               const rddl_fluent& fluent) {
    const Values& values = snapshot.values(fluent);
    const Range range = range_of(snapshot, fluent);
    // A key stands at its right.
    const double room = fluent.rank > 0 ? box.width * 0.75 : box.width;
    const std::string title = shortened(canvas, fluent.name, 12, room);
    canvas.text({box.x, box.y + 8}, title);
    if (fluent.scalar == RDDL_BOOL && fluent.rank == 0) {
        canvas.text({box.x, box.y + 26}, value_text(values, 0), {.color = colors::blue});
        return;
    }
    const Box inside = box.below(20).above(16);
    const Shape shape = shape_of(values, inside);
    if (fluent.rank > 0)
        draw_key(canvas, box.top(16).after(canvas.text_width(title, 12) + 12), values, range,
                 shape.wrapped ? box.lowest(14) : Box{});
    const Box cells = inside.after(row_names_width(canvas, snapshot, values, shape));
    const Box used = shape.rows == 1 ? cells.top(std::min(cells.height, 40.0)) : cells;
    // Squares look like places, unless they are too small to see.
    constexpr double smallest = 6;
    const bool square =
        fluent.rank >= 2 && Grid(used, shape.columns, shape.rows).cell(0, 0).width >= smallest;
    const Grid grid(used, shape.columns, shape.rows, square);
    draw_cells(canvas, grid, values, range);
    if (has_row_names(values, shape)) draw_row_names(canvas, grid, snapshot, values, shape);
    if (fluent.rank > 0 && !shape.wrapped) draw_column_names(canvas, grid, values);
}

void draw(Canvas& canvas, const Box& whole, const Snapshot& snapshot) {
    // Grids get the room; fluents with fewer parameters stand below them.
    std::vector<const rddl_fluent*> grids, strips;
    for (const rddl_fluent* const fluent : state_fluents(snapshot.problem()))
        (fluent->rank >= 2 ? grids : strips).push_back(fluent);
    constexpr std::size_t most_grids = 24, most_strips = 12;
    const std::size_t all = grids.size() + strips.size();
    grids.resize(std::min(grids.size(), most_grids));
    strips.resize(std::min(strips.size(), most_strips));
    const std::size_t left_out = all - grids.size() - strips.size();
    const Box area = left_out > 0 ? whole.above(8) : whole;
    const std::size_t columns = std::min<std::size_t>(strips.size(), strips.size() > 4 ? 4 : 2);
    const std::size_t rows = columns == 0 ? 0 : (strips.size() + columns - 1) / columns;
    const double strips_height =
        grids.empty() ? area.height : std::min(static_cast<double>(rows) * 66, area.height * 0.5);
    const std::vector<Box> grid_boxes =
        panel_boxes(area.above(strips_height), grids.size(), 1.2, 14);
    for (std::size_t i = 0; i < grids.size(); ++i)
        draw_grid(canvas, grid_boxes[i], snapshot, *grids[i]);
    const double shape = rows == 0 ? 1
                                   : (area.width / static_cast<double>(columns)) /
                                         (strips_height / static_cast<double>(rows));
    const std::vector<Box> strip_boxes =
        panel_boxes(area.lowest(strips_height), strips.size(), shape, 10);
    for (std::size_t i = 0; i < strips.size(); ++i)
        draw_grid(canvas, strip_boxes[i], snapshot, *strips[i]);
    if (left_out > 0)
        canvas.text({whole.right(), whole.bottom() + 1},
                    "and " + std::to_string(left_out) + " more fluents",
                    {.size = 9, .color = colors::muted, .align = Align::Right});
}

}  // namespace

const Visualizer visualizer{"heatmap", "the values of a state as a grid of cells", {}, {}, draw};

}  // namespace rddl::render::heatmap
