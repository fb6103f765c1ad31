// Draws the production of power plants, its limits and targets, and the total demand.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::power_gen {

namespace {

double demand(const Snapshot& snapshot) {
    const double from_mild =
        snapshot.number("temperature") - snapshot.number_or("MIN-DEMAND-TEMP", 11.7);
    return snapshot.number_or("MIN-CONSUMPTION", 2) +
           snapshot.number_or("DEMAND-EXP-COEF", 0.01) * from_mild * from_mild;
}

struct Bar {
    std::string name;
    double value, least, most;  // least and most: limits, or not a number
    double wanted;              // a mark, or not a number
    Color color;
    std::string note = {};  // below the number
};

void draw_bar(Canvas& canvas, const Box& box, const Bar& bar, double top) {
    const auto part = [&](double value) {
        return value / top;
    };
    std::vector<Mark> marks;
    if (!std::isnan(bar.least)) marks.push_back({part(bar.least), colors::muted});
    if (!std::isnan(bar.most)) marks.push_back({part(bar.most), colors::muted});
    gauge(canvas, box, part(bar.value), bar.color, marks);
    if (!std::isnan(bar.wanted)) {
        const double y = box.bottom() - box.height * std::clamp(part(bar.wanted), 0.0, 1.0);
        const Point tip[] = {
            {box.right() + 1, y}, {box.right() + 9, y - 5}, {box.right() + 9, y + 5}};
        canvas.polygon(tip, colors::vermilion);
    }
    const Box wide = box.inset(-18, 0);
    label(canvas, {wide.x, box.bottom() + 3, wide.width, 13}, bar.name,
          {.size = 10, .color = colors::muted, .align = Align::Center});
    label(canvas, {wide.x, box.bottom() + 17, wide.width, 13},
          number_text(std::round(bar.value * 100) / 100), {.size = 11, .align = Align::Center});
    label(canvas, {wide.x, box.bottom() + 31, wide.width, 12}, bar.note,
          {.size = 10, .color = colors::muted, .align = Align::Center});
}

std::string cost_note(const Snapshot& snapshot, int plant) {
    if (!snapshot.has("COST-PER-UNIT")) return {};
    return "cost " + number_text(snapshot["COST-PER-UNIT"](plant));
}

void draw_bars(Canvas& canvas, const Box& area, const std::vector<Bar>& bars, double top) {
    const double cell = area.width / static_cast<double>(bars.size());
    const double width = std::clamp(cell * 0.5, 12.0, 56.0);
    for (std::size_t i = 0; i < bars.size(); ++i)
        draw_bar(canvas,
                 {area.x + (static_cast<double>(i) + 0.5) * cell - width / 2, area.y, width,
                  area.height},
                 bars[i], top);
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &made = snapshot["prevProd"], &wanted = snapshot["curProd"];
    const Values &least = snapshot["PROD-UNITS-MIN"], &most = snapshot["PROD-UNITS-MAX"];
    std::vector<Bar> plants;
    double top = 1, total = 0;
    for (int i = 0; i < made.count(0); ++i) {
        plants.push_back({made.object(0, i), made(i), least(i), most(i),
                          snapshot.acts() ? wanted(i) : NAN, colors::blue, cost_note(snapshot, i)});
        top = std::max({top, most(i), made(i)});
        total += made(i);
    }
    const Box body = area.above(20).below(18);
    const Box right = body.rightmost(230).above(46), left = body.before(250).above(46);
    canvas.text({left.x, area.y + 6}, "made by each plant", {.size = 11, .color = colors::muted});
    draw_bars(canvas, left, plants, top * 1.05);

    canvas.text({right.x + 10, area.y + 6}, "together, and the weather",
                {.size = 11, .color = colors::muted});
    const double needed = demand(snapshot), height = std::max({needed, total, top}) * 1.15;
    draw_bars(canvas, right.left(150),
              {{"made", total, NAN, NAN, NAN, colors::blue},
               {"demand", needed, NAN, NAN, NAN, total < needed ? colors::orange : colors::green}},
              height);
    const double low = snapshot.number_or("TEMP-MIN", -30),
                 high = snapshot.number_or("TEMP-MAX", 40);
    const double temperature = snapshot.number("temperature");
    const Box glass{right.right() - 44, right.y, 22, right.height};
    gauge(canvas, glass, (temperature - low) / (high - low), colors::vermilion);
    label(canvas, {glass.x - 24, glass.bottom() + 3, glass.width + 48, 13}, "temperature",
          {.size = 10, .color = colors::muted, .align = Align::Center});
    label(canvas, {glass.x - 24, glass.bottom() + 17, glass.width + 48, 13},
          number_text(std::round(temperature * 10) / 10) + "°",
          {.size = 11, .align = Align::Center});
    const Entry entries[] = {{"made", colors::blue},
                             {"asked for next", colors::vermilion},
                             {"demand that is met", colors::green},
                             {"demand that is not", colors::orange}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{
    "power_gen",
    "production of each plant within its limits, and the demand",
    {"power_gen"},
    {"prevProd", "curProd", "temperature", "PROD-UNITS-MIN", "PROD-UNITS-MAX"},
    draw};

}  // namespace rddl::render::power_gen
