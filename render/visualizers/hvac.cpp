// Temperatures of zones beside what is comfortable, and the heaters that warm them.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::hvac {

namespace {

struct Thermometer {
    std::string name;
    double temperature;
    double low, high;  // comfortable; not a number for heaters
    std::string note;  // what the action does there
    bool occupied;
};

std::vector<Box> row_of_boxes(const Box& area, std::size_t count) {
    std::vector<Box> boxes;
    const double cell = area.width / static_cast<double>(std::max<std::size_t>(count, 1));
    const double width = std::clamp(cell * 0.5, 14.0, 46.0);
    for (std::size_t i = 0; i < count; ++i)
        boxes.push_back({area.x + (static_cast<double>(i) + 0.5) * cell - width / 2, area.y, width,
                         area.height});
    return boxes;
}

Color warmth(const Thermometer& zone) {
    if (std::isnan(zone.low)) return colors::purple;
    return zone.temperature < zone.low    ? colors::sky
           : zone.temperature > zone.high ? colors::vermilion
                                          : colors::green;
}

void draw_thermometer(Canvas& canvas, const Box& box, const Thermometer& zone, const Scale& scale) {
    const Scale y{scale.low, scale.high, box.bottom(), box.y};
    canvas.fill(box, colors::faint, 3);
    if (!std::isnan(zone.low))
        canvas.fill(
            {box.x, y.clamped(zone.high), box.width, y.clamped(zone.low) - y.clamped(zone.high)},
            rgb(0xbfe3d6));
    const double top = y.clamped(zone.temperature);
    canvas.fill({box.x + 3, top, box.width - 6, box.bottom() - top}, warmth(zone));
    if (!std::isnan(zone.low))
        for (const double limit : {zone.low, zone.high})
            canvas.dashed_line({box.x, y.clamped(limit)}, {box.right(), y.clamped(limit)},
                               colors::ink, 1.5, 3);
    canvas.outline(box, colors::muted, 1, 3);
    const Box wide = box.inset(-22, 0);
    label(canvas, {wide.x, box.bottom() + 2, wide.width, 13}, zone.name,
          {.size = 10, .color = colors::muted, .align = Align::Center});
    label(canvas, {wide.x, box.bottom() + 15, wide.width, 13},
          number_text(std::round(zone.temperature * 10) / 10) + "°",
          {.size = 11, .align = Align::Center});
    label(canvas, {wide.x, box.bottom() + 28, wide.width, 12}, zone.note,
          {.size = 10, .color = colors::vermilion, .align = Align::Center});
    if (zone.occupied) person(canvas, {box.center().x, box.y - 3}, 15, colors::ink);
}

// An arc above two boxes of a row.
void connect(Canvas& canvas, const Box& a, const Box& b, double top) {
    const double from = a.center().x, to = b.center().x;
    std::vector<Point> points;
    for (int k = 0; k <= 16; ++k) {
        const double part = k / 16.0;
        points.push_back({from + (to - from) * part, a.y - 20 - top * std::sin(M_PI * part)});
    }
    canvas.polyline(points, colors::rule, 1.5);
}

void draw_zones(Canvas& canvas, const std::vector<Box>& boxes, const Values& adjacent,
                const std::vector<Thermometer>& zones, const Scale& scale) {
    const int count = adjacent.count(0);
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b) {
            if (!adjacent.is(a, b) || a == b || (a > b && adjacent.is(b, a))) continue;
            connect(canvas, boxes[static_cast<std::size_t>(a)], boxes[static_cast<std::size_t>(b)],
                    std::min(8.0 + 7.0 * (std::abs(a - b) - 1), 34.0));
        }
    for (std::size_t i = 0; i < zones.size(); ++i)
        draw_thermometer(canvas, boxes[i], zones[i], scale);
}

void draw_key(Canvas& canvas, const Box& box) {
    const Entry entries[] = {{"comfortable", colors::green},
                             {"too cold", colors::sky},
                             {"too warm", colors::vermilion},
                             {"heater", colors::purple}};
    legend(canvas, box, entries);
}

std::string action_note(const Snapshot& snapshot, std::string_view fluent, int i) {
    if (!snapshot.acts() || !snapshot.has(fluent)) return {};
    const double value = snapshot[fluent](i);
    return "+" + number_text(std::round(std::abs(value) * 10) / 10);
}

// Temperatures from cold to hot that all thermometers show.
Scale temperatures(const Snapshot& snapshot, std::initializer_list<std::string_view> fluents,
                   double low, double high) {
    Extent extent;
    extent.add(low - 4);
    extent.add(high + 4);
    for (const std::string_view name : fluents)
        for (const Step* const step : {&snapshot.steps().front(), &snapshot.now()})
            for (const double value :
                 snapshot.values_in(*step, *snapshot.world().find(name)).numbers)
                extent.add(value);
    const Extent rounded = extent.rounded();
    return {rounded.low, rounded.high};
}

void draw_with_heaters(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &zone = snapshot["temp-zone"], &heater = snapshot["temp-heater"];
    const double low = snapshot.number("TEMP-ZONE-MIN"), high = snapshot.number("TEMP-ZONE-MAX");
    const Scale scale = temperatures(snapshot, {"temp-zone", "temp-heater"}, low, high);
    std::vector<Thermometer> zones, heaters;
    for (int i = 0; i < zone.count(0); ++i)
        zones.push_back({zone.object(0, i), zone(i), low, high, action_note(snapshot, "fan-in", i),
                         snapshot.has("occupied") && snapshot["occupied"].is(i)});
    for (int i = 0; i < heater.count(0); ++i)
        heaters.push_back({heater.object(0, i), heater(i), NAN, NAN,
                           action_note(snapshot, "heat-input", i), false});
    const Box body = area.above(20);
    const double height = (body.height - 54 - 42 - 42 - 40) / 2;
    const std::vector<Box> above =
        row_of_boxes({body.x, body.y + 54, body.width, height}, zones.size());
    const std::vector<Box> below =
        row_of_boxes({body.x, body.bottom() - 42 - height, body.width, height}, heaters.size());
    const Values& warms = snapshot["ADJ-HEATER"];
    for (int h = 0; h < heater.count(0); ++h)
        for (int z = 0; z < zone.count(0); ++z) {
            if (!warms.is(h, z)) continue;
            const Box &from = below[static_cast<std::size_t>(h)],
                      &to = above[static_cast<std::size_t>(z)];
            canvas.line({from.center().x, from.y}, {to.center().x, to.bottom() + 42}, colors::rule,
                        1.5);
        }
    draw_zones(canvas, above, snapshot["ADJ-ZONES"], zones, scale);
    for (std::size_t i = 0; i < heaters.size(); ++i)
        draw_thermometer(canvas, below[i], heaters[i], scale);
    draw_key(canvas, area.lowest(14));
}

void draw_with_air(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &space = snapshot["temp"], &low = snapshot["TEMP_LOW"],
                 &high = snapshot["TEMP_UP"];
    const Scale scale = temperatures(snapshot, {"temp"}, low.numbers[0], high.numbers[0]);
    std::vector<Thermometer> spaces;
    for (int i = 0; i < space.count(0); ++i) {
        std::string note = action_note(snapshot, "air", i);
        if (!note.empty()) note = "air " + note;
        spaces.push_back({space.object(0, i), space(i), low(i), high(i), note, false});
    }
    const Box body = area.above(20);
    draw_zones(
        canvas,
        row_of_boxes({body.x, body.y + 70, body.width, body.height - 70 - 60}, spaces.size()),
        snapshot["ADJ"], spaces, scale);
    draw_key(canvas, area.lowest(14));
}

}  // namespace

const Visualizer visualizer{
    "hvac",
    "zones and heaters as thermometers, and which lie beside each other",
    {"hvac"},
    {"temp-zone", "temp-heater", "TEMP-ZONE-MIN", "TEMP-ZONE-MAX", "ADJ-HEATER", "ADJ-ZONES"},
    draw_with_heaters};

const Visualizer visualizer_of_air{"hvac_air",
                                   "spaces as thermometers, and which lie beside each other",
                                   {"hvac_vav_fix"},
                                   {"temp", "TEMP_LOW", "TEMP_UP", "ADJ"},
                                   draw_with_air};

}  // namespace rddl::render::hvac
