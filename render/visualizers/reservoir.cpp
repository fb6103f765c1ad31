// Reservoirs from the springs at the left to the sea at the right: how full they are, the levels
// between which they should be, and how much is released.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::reservoir {

namespace {

// How many reservoirs water passes before each, at most.
std::vector<int> depths(const Values& connected) {
    const int count = connected.count(0);
    std::vector<int> depth(static_cast<std::size_t>(count), 0);
    for (int round = 0; round < count; ++round)  // a circle also ends there
        for (int a = 0; a < count; ++a)
            for (int b = 0; b < count; ++b)
                if (a != b && connected.is(a, b)) {
                    int& at = depth[static_cast<std::size_t>(b)];
                    at = std::min(std::max(at, depth[static_cast<std::size_t>(a)] + 1), count - 1);
                }
    return depth;
}

std::vector<Box> places(const Box& area, const std::vector<int>& depth) {
    const int columns = 1 + *std::max_element(depth.begin(), depth.end());
    std::vector<Box> boxes(depth.size());
    const double width = area.width / columns;
    for (int c = 0; c < columns; ++c) {
        const auto rows = std::count(depth.begin(), depth.end(), c);
        const double height = area.height / static_cast<double>(std::max<std::ptrdiff_t>(rows, 1));
        int row = 0;
        for (std::size_t i = 0; i < depth.size(); ++i) {
            if (depth[i] != c) continue;
            const Box cell{area.x + c * width, area.y + row++ * height, width, height};
            const double w = std::clamp(width * 0.58, 24.0, 120.0);
            const double h = std::min(cell.height - 44, 170.0);
            boxes[i] = {cell.center().x - w / 2, cell.center().y - h / 2 + 2, w, h};
        }
    }
    return boxes;
}

// The released part of the water, from 0 to 1.
double released_part(const Snapshot& snapshot, int i) {
    if (!snapshot.acts() || !snapshot.has("release")) return 0;
    const Values& release = snapshot["release"];
    if (release.fluent->scalar == RDDL_BOOL) return release(i);
    return std::clamp(release(i) / std::max(snapshot["rlevel|water"](i), 1e-9), 0.0, 1.0);
}

// Without that fluent, reservoirs whose water flows to no other one flow to the sea.
bool flows_to_sea(const Snapshot& snapshot, const Values& connected, int i) {
    if (snapshot.has("CONNECTED_TO_SEA")) return snapshot["CONNECTED_TO_SEA"].is(i);
    for (int to = 0; to < connected.count(1); ++to)
        if (connected.is(i, to)) return false;
    return true;
}

// Thinner where there are many.
void draw_flow(Canvas& canvas, Point from, Point to, double part, bool many) {
    canvas.line(from, to, colors::rule, many ? 0.8 : 1.5);
    if (part > 0.01) arrow(canvas, from, to, colors::blue, many ? 0.7 + part : 1.5 + 3 * part);
}

// Drops beside the name, more where more rain falls.
void draw_rain(Canvas& canvas, const Box& box, const Snapshot& snapshot, int i) {
    constexpr double room = 80;  // for the name and the drops
    if (!snapshot.has("RAIN_VAR") || box.width < room) return;
    const Values& variance = snapshot["RAIN_VAR"];
    const double most = *std::max_element(variance.numbers.begin(), variance.numbers.end());
    if (!(most > 0) || !(variance(i) > 0)) return;
    const int drops = std::max(static_cast<int>(std::lround(5 * std::sqrt(variance(i) / most))), 1);
    for (int d = 0; d < drops; ++d) {
        const double x = box.right() - 4 - 5 * d;
        canvas.line({x + 1.5, box.y - 13}, {x - 1.5, box.y - 6}, colors::sky, 2);
    }
}

void draw_tank(Canvas& canvas, const Box& box, const Snapshot& snapshot, int i) {
    const Values& levels = snapshot["rlevel|water"];
    const double top = std::max(snapshot["TOP_RES|CAPACITY"](i), 1e-9), level = levels(i);
    const double low = snapshot["MIN_LEVEL|SAFE-LOW"](i), high = snapshot["MAX_LEVEL|SAFE-HIGH"](i);
    const bool fine = level >= low && level <= high;
    const auto y = [&](double value) {
        return box.bottom() - box.height * std::clamp(value / top, 0.0, 1.0);
    };
    canvas.fill(box, colors::paper);
    canvas.fill({box.x, y(high), box.width, y(low) - y(high)}, rgb(0xe5f3ee));
    canvas.fill({box.x, y(level), box.width, box.bottom() - y(level)},
                fine ? colors::sky : colors::orange);
    for (const double mark : {low, high})
        canvas.dashed_line({box.x, y(mark)}, {box.right(), y(mark)}, colors::green, 1.5, 3);
    const Point walls[] = {
        {box.x, box.y}, {box.x, box.bottom()}, {box.right(), box.bottom()}, {box.right(), box.y}};
    canvas.polyline(walls, colors::ink, 2);
    const Box wide = box.inset(-16, 0);
    canvas.fill({box.x, box.y - 16, box.width, 14}, colors::paper.with_alpha(0.8));
    canvas.fill({box.x, box.bottom() + 3, box.width, 14}, colors::paper.with_alpha(0.8));
    label(canvas, {wide.x, box.y - 16, wide.width, 14}, levels.object(0, i),
          {.size = 11, .color = colors::muted, .align = Align::Center});
    label(canvas, {wide.x, box.bottom() + 3, wide.width, 14},
          number_text(std::round(level * 10) / 10), {.size = 11, .align = Align::Center});
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values& connected = snapshot["RES_CONNECT|FLOWS-TO"];
    const Box body = area.above(20);
    const Box sea = body.rightmost(40);
    canvas.fill(sea, rgb(0xcfe8f7), 4);
    canvas.text(sea.center(), "sea", {.color = colors::blue, .align = Align::Center});
    const std::vector<Box> tanks = places(body.before(58), depths(connected));
    const int count = connected.count(0);
    const bool many = std::count(connected.numbers.begin(), connected.numbers.end(), 1.0) > 12;
    for (int a = 0; a < count; ++a) {
        const Box& from = tanks[static_cast<std::size_t>(a)];
        const Point mouth{from.right(), from.bottom() - 6};
        const double part = released_part(snapshot, a);
        for (int b = 0; b < count; ++b) {
            const Box& to = tanks[static_cast<std::size_t>(b)];
            if (a != b && connected.is(a, b))
                draw_flow(canvas, mouth, {to.x, to.y + 8}, part, many);
        }
        if (flows_to_sea(snapshot, connected, a))
            draw_flow(canvas, mouth, {sea.x, mouth.y}, part, many);
    }
    for (int i = 0; i < count; ++i) {
        draw_tank(canvas, tanks[static_cast<std::size_t>(i)], snapshot, i);
        draw_rain(canvas, tanks[static_cast<std::size_t>(i)], snapshot, i);
    }
    const Entry entries[] = {{"wanted level", rgb(0xe5f3ee)},
                             {"water", colors::sky},
                             {"water, too high or too low", colors::orange},
                             {"released", colors::blue}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{"reservoir",
                            "levels and their limits, rain, and what flows down to the sea",
                            {"reservoir_control_cont", "reservoir_control_dis", "reservoir"},
                            {"rlevel|water", "TOP_RES|CAPACITY", "MIN_LEVEL|SAFE-LOW",
                             "MAX_LEVEL|SAFE-HIGH", "RES_CONNECT|FLOWS-TO"},
                            draw};

}  // namespace rddl::render::reservoir
