#include "render/panels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rddl::render {

std::vector<const rddl_fluent*> state_fluents(const rddl_problem& problem) {
    std::vector<const rddl_fluent*> fluents;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent* const fluent = rddl_fluent_at(&problem, f);
        if (fluent->role == RDDL_STATE && fluent->count > 0) fluents.push_back(fluent);
    }
    return fluents;
}

Range range_of(const Snapshot& snapshot, const rddl_fluent& fluent) {
    if (fluent.scalar == RDDL_BOOL) return {0, 1};
    if (fluent.range_type >= 0) {
        const auto objects = rddl_type_at(&snapshot.problem(), fluent.range_type)->object_count;
        return {0, static_cast<double>(std::max<std::int64_t>(objects - 1, 1))};
    }
    if (fluent.lower && fluent.upper && std::isfinite(fluent.lower[0]) &&
        std::isfinite(fluent.upper[0]) && fluent.count == 1)
        return {fluent.lower[0], fluent.upper[0]};
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Step& step : snapshot.steps())
        for (const double value : snapshot.values_in(step, fluent).numbers) {
            if (!std::isfinite(value)) continue;
            low = std::min(low, value);
            high = std::max(high, value);
        }
    if (low > high) return {0, 1};
    return {low, high};
}

Color value_color(const Values& values, double value, const Range& range) {
    if (values.fluent->scalar == RDDL_BOOL) return value != 0 ? colors::blue : colors::faint;
    if (!values.range()) return sequential_color(range.part(value));
    const auto index = static_cast<std::size_t>(std::max(value, 0.0));
    return mix(series_color(index), colors::white, 0.15 * static_cast<double>(index / 7));
}

namespace {

std::string short_text(double value) {
    return rounded_text(value, 2);
}

}  // namespace

void draw_key(Canvas& canvas, const Box& box, const Values& values, const Range& range,
              const Box& other) {
    if (values.fluent->scalar == RDDL_BOOL) {
        whole_legend_at_right(canvas, box,
                              std::vector<Entry>{{"true", colors::blue}, {"false", colors::faint}});
        return;
    }
    if (const rddl_type* const type = values.range()) {
        std::vector<Entry> entries;
        for (std::int64_t i = 0; i < type->object_count; ++i)
            entries.push_back(
                {type->objects[i], value_color(values, static_cast<double>(i), range)});
        if (whole_legend_at_right(canvas, box, entries)) return;
        legend_at_right(canvas, other.width > box.width ? other : box, entries);
        return;
    }
    const Color low = sequential_color(0), high = sequential_color(1);
    for (const auto text_of : {number_text, short_text})
        if (whole_legend_at_right(
                canvas, box,
                std::vector<Entry>{{text_of(range.low), low}, {text_of(range.high), high}}))
            return;
}

std::string objects_of(const Snapshot& snapshot, const rddl_fluent& fluent,
                       std::int64_t grounding) {
    const std::string name = snapshot.world().name_of(fluent, grounding);
    const std::size_t open = name.find('(');
    return open == std::string::npos ? name : name.substr(open + 1, name.size() - open - 2);
}

std::vector<Box> panel_boxes(const Box& area, std::size_t count, double wanted_shape, double gap) {
    std::vector<Box> boxes;
    if (count == 0) return boxes;
    // Chooses the columns that bring panels nearest to the wanted width over height.
    std::size_t columns = 1;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t c = 1; c <= count; ++c) {
        const std::size_t rows = (count + c - 1) / c;
        const double shape =
            (area.width / static_cast<double>(c)) / (area.height / static_cast<double>(rows));
        const double unused = static_cast<double>(c * rows - count) / static_cast<double>(count);
        const double distance = std::abs(std::log(shape / wanted_shape)) + unused;
        if (distance < best) {
            best = distance;
            columns = c;
        }
    }
    const std::size_t rows = (count + columns - 1) / columns;
    const double width =
        (area.width - gap * static_cast<double>(columns - 1)) / static_cast<double>(columns);
    const double height =
        (area.height - gap * static_cast<double>(rows - 1)) / static_cast<double>(rows);
    for (std::size_t i = 0; i < count; ++i)
        boxes.push_back({area.x + static_cast<double>(i % columns) * (width + gap),
                         area.y + static_cast<double>(i / columns) * (height + gap), width,
                         height});
    return boxes;
}

}  // namespace rddl::render
