// Rovers on their way to minerals; minerals of more value are darker, harvested ones hollow.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace rddl::render::mars_rover {

namespace {

double greatest(const Values& values) {
    double most = 0;
    for (const double value : values.numbers) most = std::max(most, value);
    return most;
}

Point name_place(Point rover) {
    return {rover.x + 13, rover.y + 13};
}

// Below, above, or beside the middle, to which rovers come: where nothing is near.
Point free_place(Point middle, double distance, std::span<const Point> taken) {
    Point best = middle;
    double widest = -1;
    for (const auto& [x, y] : {Point{0, 1}, Point{0, -1}, Point{-1, 0}, Point{1, 0}}) {
        const double wide = std::max(distance - 12, 0.0);  // a text is wider than high
        const Point place{middle.x + x * wide, middle.y + y * distance};
        double nearest = 100;  // farther off, all places are as good
        for (const Point& other : taken)
            nearest = std::min(nearest, std::hypot(place.x - other.x, place.y - other.y));
        if (nearest > widest) best = place, widest = nearest;
    }
    return best;
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &mineral_x = snapshot["MINERAL-POS-X"], &mineral_y = snapshot["MINERAL-POS-Y"];
    const Values &value = snapshot["MINERAL-VALUE"], &harvested = snapshot["mineral-harvested"];
    Extent across, up;
    const double reach = greatest(snapshot["MINERAL-AREA"]);
    for (int i = 0; i < mineral_x.count(0); ++i) {
        across.add(mineral_x(i) - reach), across.add(mineral_x(i) + reach);
        up.add(mineral_y(i) - reach), up.add(mineral_y(i) + reach);
    }
    for (const Step& step : snapshot.steps()) {
        for (const double x : snapshot.values_in(step, *snapshot.world().find("pos-x")).numbers)
            across.add(x);
        for (const double y : snapshot.values_in(step, *snapshot.world().find("pos-y")).numbers)
            up.add(y);
    }
    across = across.rounded();
    up = up.rounded();
    const Box body = area.above(18);
    canvas.fill(body, rgb(0xfbf4ee), 4);
    const Plane plane(body, across.low, up.low, across.high, up.high);
    const Entry entries[] = {{"mineral, with its value", colors::orange},
                             {"rover", colors::blue},
                             {"power", colors::vermilion},
                             {"harvesting", colors::green}};
    legend(canvas, area.lowest(13), entries);
    const Canvas::Saved inside = canvas.clipped(body);
    const Values &x = snapshot["pos-x"], &y = snapshot["pos-y"];
    std::vector<Point> rovers, taken;
    for (int i = 0; i < x.count(0); ++i) {
        rovers.push_back(plane(x(i), y(i)));
        taken.push_back(rovers.back());
        taken.push_back(name_place(rovers.back()));
    }
    const double most = greatest(value);
    for (int i = 0; i < mineral_x.count(0); ++i) {
        const Point place = plane(mineral_x(i), mineral_y(i));
        const double radius = std::max(plane.length(snapshot["MINERAL-AREA"](i)), 4.0);
        const Color ground = mix(rgb(0xfdebc8), colors::orange, most > 0 ? value(i) / most : 0);
        if (!harvested.is(i)) canvas.disc(place, radius, ground);
        canvas.ring(place, radius, harvested.is(i) ? colors::rule : rgb(0xb07a00), 1.5);
        const std::string worth = number_text(std::round(value(i) * 10) / 10);
        canvas.text(free_place(place, std::max(radius - 14, 0.0), taken),
                    harvested.is(i) ? worth + ", done" : worth,
                    {.size = 11,
                     .color = harvested.is(i) ? colors::muted : colors::ink,
                     .align = Align::Center});
    }
    for (int i = 0; i < x.count(0); ++i) {
        const auto g = static_cast<std::size_t>(i);
        std::vector<Point> way;
        for (const Step& step : snapshot.steps())
            way.push_back(
                plane(snapshot.number_in(step, "pos-x", g), snapshot.number_in(step, "pos-y", g)));
        trail(canvas, way, colors::blue);
        const Point place = rovers[g];
        if (snapshot.acts()) {
            const double px = snapshot["power-x"](i), py = snapshot["power-y"](i);
            const double scale = 30 / std::max(snapshot["MAX-POWER"](i), 1e-9);
            arrow(canvas, place, {place.x + px * scale, place.y - py * scale}, colors::vermilion,
                  2);
        }
        canvas.fill({place.x - 8, place.y - 6, 16, 12}, colors::blue, 3);
        for (const double dx : {-6.0, 0.0, 6.0})
            canvas.disc({place.x + dx, place.y + 7}, 3, colors::ink);
        if (snapshot.acts() && snapshot["harvest"].is(i))
            canvas.ring(place, 15, colors::green, 2.5);
        canvas.text(name_place(place), x.object(0, i),
                    {.size = 10, .color = colors::ink, .halo = true});
    }
}

}  // namespace

const Visualizer visualizer{
    "mars_rover",
    "minerals with their values, rovers, and their ways",
    {"mars_rover_science_mission"},
    {"pos-x", "pos-y", "power-x", "power-y", "harvest", "mineral-harvested", "MAX-POWER",
     "MINERAL-POS-X", "MINERAL-POS-Y", "MINERAL-AREA", "MINERAL-VALUE"},
    draw};

}  // namespace rddl::render::mars_rover
