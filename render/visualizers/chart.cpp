// State-fluents over time, a panel each: lines for a few numbers, steps for a few objects, and rows
// of coloured cells for bools and for what would be too many lines.
#include "render/panels.hpp"
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rddl::render::chart {

namespace {

constexpr std::int64_t most_lines = 7;  // as many as the palette has colours
constexpr std::size_t most_panels = 24;
constexpr std::size_t many_panels = 7;  // these share their axis and what colours mean
constexpr double names_size = 9;

// Other fluents are drawn as rows of cells.
bool has_lines(const rddl_fluent& fluent) {
    return fluent.scalar != RDDL_BOOL && fluent.count <= most_lines;
}

// The steps that the axis shows.
struct Axis {
    std::int64_t first, last;

    std::int64_t count() const { return last - first + 1; }
};

Axis axis_of(const Snapshot& snapshot) {
    const std::int64_t first = snapshot.steps().front().number, now = snapshot.now().number;
    const auto most = static_cast<std::int64_t>(most_steps_remembered);
    const bool whole = first == 0 && snapshot.horizon() > 0 && snapshot.horizon() <= most;
    return {first, whole ? std::max(snapshot.horizon(), now) : std::max(now, first + 49)};
}

// The elements of a panel beside its plot.
struct Look {
    double names;  // room at the left
    bool has_axis, has_axis_title;
    bool is_small;    // its title has little room
    bool shares_key;  // which stands below all panels
};

struct Panel {
    const Snapshot& snapshot;
    const rddl_fluent& fluent;
    std::vector<Values> past;  // one a step
    Range range;
    Axis axis;
    Look look;
    Box plot;

    Scale time() const {
        return {static_cast<double>(axis.first), static_cast<double>(axis.last), plot.x,
                plot.right()};
    }
    std::string objects(std::int64_t grounding) const {
        return objects_of(snapshot, fluent, grounding);
    }
    const rddl_type* objects_of_range() const { return past.front().range(); }
    // The place of a label at the left for a height of the plot; it stays out of the title.
    Point label_place(double y) const { return {plot.x - 4, std::max(y, plot.y + 4)}; }
};

void draw_time_axis(Canvas& canvas, const Panel& panel, bool with_title) {
    const Box& plot = panel.plot;
    const Scale time = panel.time();
    canvas.line({plot.x, plot.bottom()}, {plot.right(), plot.bottom()}, colors::muted);
    for (const double tick : ticks(time.low, time.high, static_cast<int>(plot.width / 70))) {
        if (tick != std::round(tick)) continue;
        const double x = time(tick);
        canvas.line({x, plot.bottom()}, {x, plot.bottom() + 3}, colors::muted);
        canvas.text({x, plot.bottom() + 10}, number_text(tick),
                    {.size = 9, .color = colors::muted, .align = Align::Center});
    }
    if (with_title)
        canvas.text({plot.right(), plot.bottom() + 20}, "step",
                    {.size = 9, .color = colors::muted, .align = Align::Right});
}

// Draws a line for each grounding. An object keeps its value for the whole step.
void draw_lines(Canvas& canvas, const Panel& panel) {
    const Box& plot = panel.plot;
    const bool steps = panel.objects_of_range() != nullptr;
    const Scale time = panel.time();
    const Scale height = scale_around(panel.range.low, panel.range.high, plot.bottom(), plot.y);
    if (steps) {
        const rddl_type& type = *panel.objects_of_range();
        const double room = plot.height / static_cast<double>(type.object_count);
        for (std::int64_t i = 0; i < type.object_count; ++i) {
            const double y = height(static_cast<double>(i));
            canvas.line({plot.x, y}, {plot.right(), y}, colors::faint);
            // The ends at least.
            if (room >= 9 || i == 0 || i + 1 == type.object_count)
                canvas.text(panel.label_place(y),
                            shortened_name(canvas, type.objects[i], names_size, 64),
                            {.size = 9, .color = colors::muted, .align = Align::Right});
        }
    } else {
        double last = INFINITY;
        for (const double tick :
             ticks(height.low, height.high, static_cast<int>(plot.height / 24))) {
            const double y = height(tick);
            canvas.line({plot.x, y}, {plot.right(), y}, colors::faint);
            if (last - y < 9) continue;  // it would lie on the number below
            last = y;
            canvas.text(panel.label_place(y), number_text(tick),
                        {.size = 9, .color = colors::muted, .align = Align::Right});
        }
    }
    std::vector<Point> points;
    for (std::size_t g = 0; g < static_cast<std::size_t>(panel.fluent.count); ++g) {
        const Color color = series_color(g);
        const auto finish = [&] {
            if (points.size() > 1) canvas.polyline(points, color, 1.6);
            points.clear();
        };
        for (std::size_t i = 0; i < panel.past.size(); ++i) {
            const double value = panel.past[i].numbers[g];
            if (!std::isfinite(value)) {
                finish();
                continue;
            }
            const double x = time(static_cast<double>(panel.snapshot.steps()[i].number));
            if (steps && !points.empty()) points.push_back({x, points.back().y});
            points.push_back({x, height(value)});
        }
        const bool has_end = !points.empty();
        const Point end = has_end ? points.back() : Point{};
        finish();
        if (has_end) canvas.disc(end, 2.6, color);
    }
}

// A row of cells for each grounding.
void draw_rows(Canvas& canvas, const Panel& panel) {
    const Box& plot = panel.plot;
    const auto rows = static_cast<int>(panel.fluent.count);
    // One a step, unless steps are left out of the trace by the thousand.
    constexpr std::int64_t most_columns = 4 * most_steps_remembered;
    const auto columns = static_cast<int>(std::min(panel.axis.count(), most_columns));
    std::vector<std::uint32_t> cells(
        static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns),
        pixel_of(colors::paper));
    for (std::size_t i = 0; i < panel.past.size(); ++i) {
        const Values& values = panel.past[i];
        const double part =
            static_cast<double>(panel.snapshot.steps()[i].number - panel.axis.first) /
            static_cast<double>(panel.axis.count());
        const auto column =
            static_cast<std::size_t>(std::min(std::floor(part * columns + 1e-6), columns - 1.0));
        for (std::size_t g = 0; g < values.numbers.size(); ++g)
            cells[g * static_cast<std::size_t>(columns) + column] =
                pixel_of(value_color(values, values.numbers[g], panel.range));
    }
    canvas.cells(plot, columns, rows, cells);
    const double row = plot.height / rows;
    if (row >= 6) {
        for (int g = 1; g < rows; ++g)
            canvas.line({plot.x, plot.y + g * row}, {plot.right(), plot.y + g * row},
                        colors::paper);
    }
    // Names of all rows, or of as many as can be read.
    double last = -INFINITY;
    for (int g = 0; g < rows && panel.fluent.rank > 0; ++g) {
        const Point place = panel.label_place(plot.y + (g + 0.5) * row);
        if (place.y - last < 9.5) continue;
        last = place.y;
        canvas.text(place, shortened_name(canvas, panel.objects(g), names_size, 64),
                    {.size = 9, .color = colors::muted, .align = Align::Right});
    }
    canvas.outline(plot, colors::rule, 0.8);
}

std::vector<std::string> names_of_lines(const Snapshot& snapshot, const rddl_fluent& fluent) {
    std::vector<std::string> names;
    for (std::int64_t g = 0; g < fluent.count; ++g)
        names.push_back(objects_of(snapshot, fluent, g));
    return names;
}

void draw_key_of_lines(Canvas& canvas, const Box& box, const std::vector<std::string>& names) {
    std::vector<Entry> entries;
    for (const std::string& name : names) entries.push_back({name, series_color(entries.size())});
    legend_at_right(canvas, box, std::move(entries));
}

// Draws the key of the colours at the right of the title.
void draw_panel_key(Canvas& canvas, const Box& box, const Panel& panel) {
    const Values& values = panel.past.back();
    if (panel.look.shares_key) return;
    if (!has_lines(panel.fluent)) {
        draw_key(canvas, box, values, panel.range);
        return;
    }
    if (panel.fluent.rank == 0) {
        canvas.text({box.right(), box.center().y}, value_text(values, 0),
                    {.size = 11, .color = series_color(0), .align = Align::Right});
        return;
    }
    draw_key_of_lines(canvas, box, names_of_lines(panel.snapshot, panel.fluent));
}

// The width of a row that is left for the title, whose right end has the key, or a number.
double room_for_title(const Canvas& canvas, double row, const Panel& panel) {
    const rddl_fluent& fluent = panel.fluent;
    if (panel.look.shares_key) return row;
    if (fluent.rank == 0 && has_lines(fluent))
        return row - canvas.text_width(value_text(panel.past.back(), 0), 11) - 16;
    // A long one has the row, for there would be no room for the key. Lines need theirs.
    const bool is_long = canvas.text_width(fluent.name, 12) > row / 2;
    if (!panel.look.is_small || !is_long) return row * 0.7;
    return has_lines(fluent) ? row * 0.45 : row;
}

// The room for what stands at the left of a panel: numbers, or names of objects.
double names_width(const Canvas& canvas, const Snapshot& snapshot, const rddl_fluent& fluent) {
    double widest = 0;
    const auto add = [&](std::string_view name) {
        widest = std::max(widest, canvas.text_width(name, names_size));
    };
    if (has_lines(fluent)) {
        const rddl_type* const type = snapshot.values(fluent).range();
        if (!type) return 44;
        for (std::int64_t i = 0; i < type->object_count; ++i) add(type->objects[i]);
    } else if (fluent.rank > 0) {
        const std::int64_t every = std::max<std::int64_t>(fluent.count / 30, 1);
        for (std::int64_t g = 0; g < fluent.count; g += every) add(objects_of(snapshot, fluent, g));
        add(objects_of(snapshot, fluent, fluent.count - 1));
    }
    return std::clamp(widest + 8, 12.0, 72.0);
}

void draw_panel(Canvas& canvas, const Box& box, const Snapshot& snapshot, const rddl_fluent& fluent,
                const Axis& axis, const Look& look) {
    Panel panel{snapshot, fluent, {}, range_of(snapshot, fluent), axis, look, {}};
    for (const Step& step : snapshot.steps())
        panel.past.push_back(snapshot.values_in(step, fluent));
    const double below = look.is_small ? 4 : look.has_axis_title ? 25 : 15;
    panel.plot = box.below(18).above(below).after(look.names).before(14);
    const double room = room_for_title(canvas, box.width, panel);
    double size = 12;
    while (look.is_small && size > names_size && canvas.text_width(fluent.name, size) > room)
        size -= 0.5;
    const std::string title = shortened_name(canvas, fluent.name, size, room);
    canvas.text({box.x, box.y + 8}, title, {.size = size});
    const double used = canvas.text_width(title, size) + (look.is_small ? 6 : 12);
    draw_panel_key(canvas, box.top(16).after(used).before(4), panel);
    has_lines(fluent) ? draw_lines(canvas, panel) : draw_rows(canvas, panel);
    if (look.has_axis) draw_time_axis(canvas, panel, look.has_axis_title);
}

// Nothing stands below it in its column.
bool is_lowest(const std::vector<Box>& boxes, std::size_t panel) {
    return std::none_of(boxes.begin(), boxes.end(), [&](const Box& other) {
        return other.x == boxes[panel].x && other.y > boxes[panel].y;
    });
}

// The key that many panels share, once below them.
struct SharedKey {
    bool of_bools = false;
    std::vector<std::string> lines;  // their names, in panels that have the same ones

    bool has(const Snapshot& snapshot, const rddl_fluent& fluent) const {
        if (fluent.scalar == RDDL_BOOL) return of_bools;
        return !lines.empty() && has_lines(fluent) && names_of_lines(snapshot, fluent) == lines;
    }
};

// The names that most panels have, if several have them.
SharedKey shared_key_of(const Snapshot& snapshot, const std::vector<const rddl_fluent*>& fluents) {
    SharedKey key;
    std::map<std::vector<std::string>, int> panels;
    int most = 1;
    for (const rddl_fluent* const fluent : fluents) {
        if (fluent->scalar == RDDL_BOOL) key.of_bools = true;
        if (fluent->scalar == RDDL_BOOL || !has_lines(*fluent) || fluent->rank == 0) continue;
        std::vector<std::string> names = names_of_lines(snapshot, *fluent);
        const int count = ++panels[names];
        if (count <= most) continue;
        most = count;
        key.lines = std::move(names);
    }
    return key;
}

void draw_shared_key(Canvas& canvas, const Box& row, const SharedKey& key) {
    const std::string axis = "from left to right: steps";
    canvas.text({row.x, row.center().y}, axis, {.size = names_size, .color = colors::muted});
    Box rest = row.after(canvas.text_width(axis, names_size) + 14);
    if (key.of_bools) {
        constexpr double width = 84;
        legend(canvas, rest, std::vector<Entry>{{"true", colors::blue}, {"false", colors::faint}},
               names_size);
        rest = rest.after(width);
    }
    if (!key.lines.empty()) draw_key_of_lines(canvas, rest, key.lines);
}

void draw(Canvas& canvas, const Box& whole, const Snapshot& snapshot) {
    std::vector<const rddl_fluent*> fluents = state_fluents(snapshot.problem());
    const std::size_t left_out = fluents.size() > most_panels ? fluents.size() - most_panels : 0;
    fluents.resize(fluents.size() - left_out);
    const bool are_many = fluents.size() >= many_panels;
    // Below stand the numbers of the axis, and a row for all panels.
    const Box area = are_many ? whole.above(28) : whole;
    const std::vector<Box> boxes = panel_boxes(area, fluents.size(), 3, 10);
    const Axis axis = axis_of(snapshot);
    const SharedKey key = are_many ? shared_key_of(snapshot, fluents) : SharedKey{};
    double names = 0;  // the same in all panels, so that steps stand below steps
    for (const rddl_fluent* const fluent : fluents)
        names = std::max(names, names_width(canvas, snapshot, *fluent));
    for (std::size_t i = 0; i < fluents.size(); ++i)
        draw_panel(canvas, boxes[i], snapshot, *fluents[i], axis,
                   {names, !are_many || is_lowest(boxes, i), !are_many && boxes[i].height > 70,
                    are_many, key.has(snapshot, *fluents[i])});
    Box below = whole.lowest(12);
    if (left_out > 0) {
        const std::string more = "and " + std::to_string(left_out) + " more fluents";
        canvas.text({whole.right(), below.center().y}, more,
                    {.size = names_size, .color = colors::muted, .align = Align::Right});
        below = below.before(canvas.text_width(more, names_size) + 14);
    }
    if (are_many) draw_shared_key(canvas, below, key);
}

}  // namespace

const Visualizer visualizer{"chart", "each state-fluent over time", {}, {}, draw};

}  // namespace rddl::render::chart
