// Intruders, cameras that have to catch sight of them, and zones where they are dangerous: in the
// plane, and on a grid.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::intruders {

namespace {

const Color danger = rgb(0xfbe3c4);

void draw_key(Canvas& canvas, const Box& box) {
    const Entry entries[] = {{"danger zone", danger},
                             {"intruder", colors::vermilion},
                             {"camera and what it sees", colors::sky}};
    legend(canvas, box, entries);
}

void draw_camera(Canvas& canvas, Point place, double size) {
    canvas.fill({place.x - size, place.y - size * 0.6, size * 1.4, size * 1.2}, colors::blue, 2);
    const Point lens[] = {{place.x + size * 0.4, place.y},
                          {place.x + size, place.y - size * 0.55},
                          {place.x + size, place.y + size * 0.55}};
    canvas.polygon(lens, colors::blue);
}

// Longer where it is faster, and to be seen wherever there is any.
void draw_velocity(Canvas& canvas, Point at, double x, double y, const Plane& plane, Color color) {
    const double speed = std::hypot(x, y);
    if (!(speed > 1e-9)) return;
    const double length = std::clamp(plane.length(speed) * 6, 18.0, 40.0);
    arrow(canvas, at, {at.x + length * x / speed, at.y - length * y / speed}, color, 2);
}

void draw_plane(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    Extent across, up;
    across.add(0), across.add(1), up.add(0), up.add(1);
    const auto grow = [&](Extent& extent, std::string_view fluent) {
        for (const double value : snapshot[fluent].numbers) extent.add(value);
    };
    grow(across, "intruder-x"), grow(across, "camera-x");
    grow(up, "intruder-y"), grow(up, "camera-y");
    const Box body = area.above(20 + room_below).after(room_at_left);
    const Plane plane(body, across.low - 0.05, up.low - 0.05, across.high + 0.05, up.high + 0.05);
    canvas.fill(plane.box, rgb(0xf6f9fc), 4);
    field_ticks(canvas, plane);
    draw_key(canvas, area.lowest(14));
    const Canvas::Saved inside = canvas.clipped(plane.box);
    const Values& left = snapshot["DANGER-L"];
    for (int z = 0; z < left.count(0); ++z) {
        // Top and bottom are the names of the limits; which is greater is not said.
        const double a = snapshot["DANGER-T"](z), b = snapshot["DANGER-B"](z);
        const Point from = plane(left(z), std::max(a, b)),
                    to = plane(snapshot["DANGER-R"](z), std::min(a, b));
        canvas.fill({from.x, from.y, to.x - from.x, to.y - from.y}, danger);
        canvas.outline({from.x, from.y, to.x - from.x, to.y - from.y}, colors::orange, 1.5);
    }
    const Values& radius = snapshot["CAMERA-RADIUS"];
    for (int c = 0; c < radius.count(0); ++c) {
        const Point at = plane(snapshot["camera-x"](c), snapshot["camera-y"](c));
        canvas.disc(at, plane.length(radius(c)), colors::sky.with_alpha(0.35));
        canvas.ring(at, plane.length(radius(c)), colors::sky, 1.5);
        draw_velocity(canvas, at, snapshot["camera-vx"](c), snapshot["camera-vy"](c), plane,
                      colors::blue);
        draw_camera(canvas, at, 7);
    }
    const Values& x = snapshot["intruder-x"];
    for (int i = 0; i < x.count(0); ++i) {
        const Point at = plane(x(i), snapshot["intruder-y"](i));
        draw_velocity(canvas, at, snapshot["intruder-vx"](i), snapshot["intruder-vy"](i), plane,
                      colors::vermilion);
        canvas.disc(at, 6, colors::vermilion);
        canvas.text({at.x + 8, at.y + 10}, x.object(0, i),
                    {.size = 10, .color = colors::muted, .halo = true});
    }
}

// Things in one cell stand side by side.
Point beside(const Box& cell, int number, int count) {
    return {cell.x + cell.width * (number + 1) / (count + 1), cell.center().y};
}

void draw_grid(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values& zone = snapshot["IS-DANGER-ZONE"];
    const Values &intruder = snapshot["intruder-at"], &camera = snapshot["camera-at"];
    const int columns = zone.count(0), rows = zone.count(1);
    const Grid grid(area.above(20), columns, rows);
    for (int x = 0; x < columns; ++x)
        for (int y = 0; y < rows; ++y) {
            const Box cell = grid.cell(x, y);
            canvas.fill(cell.inset(1), zone.is(x, y) ? danger : colors::faint, 3);
            std::vector<int> seen, watching;
            for (int i = 0; i < intruder.count(0); ++i)
                if (intruder.is(i, x, y)) seen.push_back(i);
            for (int c = 0; c < camera.count(0); ++c)
                if (camera.is(c, x, y)) watching.push_back(c);
            if (!watching.empty()) canvas.fill(cell.inset(1), colors::sky.with_alpha(0.35), 3);
            const Box upper = cell.top(cell.height * 0.5), lower = cell.below(cell.height * 0.5);
            for (std::size_t k = 0; k < watching.size(); ++k)
                draw_camera(canvas,
                            beside(upper, static_cast<int>(k), static_cast<int>(watching.size())),
                            cell.height * 0.12);
            for (std::size_t k = 0; k < seen.size(); ++k) {
                const Point at = beside(lower, static_cast<int>(k), static_cast<int>(seen.size()));
                person(canvas, {at.x, lower.bottom() - 5}, cell.height * 0.4, colors::vermilion);
            }
        }
    draw_key(canvas, area.lowest(14));
}

}  // namespace

const Visualizer visualizer{
    "intruders",
    "intruders, cameras and what they see, danger zones",
    {"Intruders_continuous"},
    {"intruder-x", "intruder-y", "intruder-vx", "intruder-vy", "camera-x", "camera-y", "camera-vx",
     "camera-vy", "CAMERA-RADIUS", "DANGER-L", "DANGER-R", "DANGER-T", "DANGER-B"},
    draw_plane};

const Visualizer visualizer_of_grid{"intruders_grid",
                                    "intruders and cameras on a grid with danger zones",
                                    {"Intruders_discrete"},
                                    {"intruder-at", "camera-at", "IS-DANGER-ZONE"},
                                    draw_grid};

}  // namespace rddl::render::intruders
