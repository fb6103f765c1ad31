// A network of streets: how dense cars flow, how many wait for each turn, and which turns have
// green light.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::traffic {

namespace {

struct Street {
    Point from, to;                                         // in the world
    bool leaves_crossing = false, enters_crossing = false;  // else it begins or ends at the edge
};

std::vector<Street> streets(const Snapshot& snapshot) {
    const Values &enters = snapshot["LINK-TO"], &leaves = snapshot["LINK-FROM"];
    const Values &x = snapshot["X"], &y = snapshot["Y"];
    std::vector<Street> all;
    for (int link = 0; link < enters.count(0); ++link) {
        Street street{{snapshot["SOURCE-X"](link), snapshot["SOURCE-Y"](link)},
                      {snapshot["SINK-X"](link), snapshot["SINK-Y"](link)}};
        for (int i = 0; i < x.count(0); ++i) {
            if (enters.is(link, i)) street.to = {x(i), y(i)}, street.enters_crossing = true;
            if (leaves.is(i, link)) street.from = {x(i), y(i)}, street.leaves_crossing = true;
        }
        all.push_back(street);
    }
    return all;
}

// A lane on the picture, beside the middle of the road: people drive on the right.
struct Lane {
    Point begin, end;
    double ux, uy;  // along it

    Point at(double part) const {
        return {begin.x + (end.x - begin.x) * part, begin.y + (end.y - begin.y) * part};
    }
};

Lane lane_of(const Plane& plane, const Street& street, double offset, double gap) {
    const Point a = plane(street.from.x, street.from.y), b = plane(street.to.x, street.to.y);
    const double length = std::max(std::hypot(b.x - a.x, b.y - a.y), 1e-9);
    const double ux = (b.x - a.x) / length, uy = (b.y - a.y) / length;
    // Crossings need room.
    const double cut = std::min(gap, length / 3);
    const double first = street.leaves_crossing ? cut : 0, last = street.enters_crossing ? cut : 0;
    const Point shift{-uy * offset, ux * offset};
    return {{a.x + ux * first + shift.x, a.y + uy * first + shift.y},
            {b.x - ux * last + shift.x, b.y - uy * last + shift.y},
            ux,
            uy};
}

// Draws the way from the end of a lane to the beginning of another, as cars go.
void draw_turn(Canvas& canvas, const Lane& from, const Lane& to, double gap, double thickness) {
    const Point a = from.end, d = to.begin;
    const double reach = std::min(0.7 * gap, 0.7 * std::hypot(d.x - a.x, d.y - a.y));
    const Point b{a.x + from.ux * reach, a.y + from.uy * reach};
    const Point c{d.x - to.ux * reach, d.y - to.uy * reach};
    std::vector<Point> way;
    constexpr int pieces = 12;
    for (int k = 0; k < pieces; ++k) {
        const double t = static_cast<double>(k) / pieces, s = 1 - t;
        const double pa = s * s * s, pb = 3 * s * s * t, pc = 3 * s * t * t, pd = t * t * t;
        way.push_back(
            {pa * a.x + pb * b.x + pc * c.x + pd * d.x, pa * a.y + pb * b.y + pc * c.y + pd * d.y});
    }
    canvas.polyline(way, colors::green, thickness);
    arrow(canvas, {d.x - to.ux * 8, d.y - to.uy * 8}, d, colors::green, thickness);
}

// Whether a turn has green light in the phase that is shown at an intersection.
bool is_green(const Snapshot& snapshot, int intersection, int from, int to) {
    const Values &green = snapshot["GREEN"], &signal = snapshot["signal"];
    if (snapshot.has("all-red") && snapshot["all-red"](intersection) > 0) return false;
    const double shown = signal(intersection);
    for (int phase = 0; phase < green.count(2); ++phase) {
        const double number = snapshot.has("PHASE-INDEX") ? snapshot["PHASE-INDEX"](phase) : phase;
        if (number == shown && green.is(from, to, phase)) return true;
    }
    return false;
}

void draw_flow(Canvas& canvas, const Lane& lane, const Snapshot& snapshot, int link, double width) {
    canvas.line(lane.begin, lane.end, rgb(0xd5dae0), width + 2);
    const Values& flow = snapshot["flow-on-link"];
    // The first time is that nearest to the end of the link.
    const int pieces = flow.count(1);
    const double most = 0.6;  // cars a second that fill a lane
    for (int k = 0; k < pieces; ++k) {
        const double part = std::clamp(flow(link, k) / most, 0.0, 1.0);
        if (part < 0.02) continue;
        const double begin = 1 - (k + 1.0) / pieces, end = 1 - static_cast<double>(k) / pieces;
        canvas.line(lane.at(begin), lane.at(end), sequential_color(0.25 + 0.7 * part), width * 0.8);
    }
}

struct Queue {
    double cars = 0;
    double part = 0;  // of the lane; a car takes four points
};

Queue queue_of(const Lane& lane, const Snapshot& snapshot, int link) {
    const Values& waiting = snapshot["q"];
    Queue queue;
    for (int to = 0; to < waiting.count(1); ++to) queue.cars += waiting(link, to);
    const double length = std::hypot(lane.end.x - lane.begin.x, lane.end.y - lane.begin.y);
    queue.part = std::clamp(queue.cars * 4 / std::max(length, 1.0), 0.0, 1.0);
    return queue;
}

void draw_queue(Canvas& canvas, const Lane& lane, const Queue& queue, double width) {
    canvas.line(lane.at(1 - queue.part), lane.end, colors::vermilion, width * 0.8);
}

// The number stands at the side of the road, where no turn goes.
void tell_queue(Canvas& canvas, const Lane& lane, const Queue& queue, double width) {
    const double length = std::hypot(lane.end.x - lane.begin.x, lane.end.y - lane.begin.y);
    const double back = std::max(queue.part, std::min(20 / std::max(length, 1.0), 1.0));
    const Point at = lane.at(1 - back);
    canvas.text({at.x - lane.uy * (width + 6), at.y + lane.ux * (width + 6)},
                number_text(std::round(queue.cars * 10) / 10),
                {.size = 10, .color = colors::vermilion, .align = Align::Center, .halo = true});
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const std::vector<Street> all = streets(snapshot);
    Extent across, up;
    for (const Street& street : all)
        for (const Point point : {street.from, street.to}) {
            across.add(point.x), up.add(point.y);
        }
    const Plane plane(area.above(20).inset(24, 16), across.low, up.low, across.high, up.high);
    const Values &turns = snapshot["TURN"], &enters = snapshot["LINK-TO"];
    const bool many = all.size() > 30;
    const double width = many ? 5 : 14, gap = many ? 14 : 48;
    std::vector<Lane> lanes;
    std::vector<Queue> queues;
    for (const Street& street : all) lanes.push_back(lane_of(plane, street, width * 0.75, gap));
    for (std::size_t link = 0; link < lanes.size(); ++link) {
        draw_flow(canvas, lanes[link], snapshot, static_cast<int>(link), width);
        queues.push_back(queue_of(lanes[link], snapshot, static_cast<int>(link)));
        if (queues[link].cars >= 0.05) draw_queue(canvas, lanes[link], queues[link], width);
    }
    for (int from = 0; from < turns.count(0); ++from)
        for (int to = 0; to < turns.count(1); ++to) {
            if (!turns.is(from, to)) continue;
            for (int i = 0; i < enters.count(1); ++i)
                if (enters.is(from, i) && is_green(snapshot, i, from, to))
                    draw_turn(canvas, lanes[static_cast<std::size_t>(from)],
                              lanes[static_cast<std::size_t>(to)], gap, many ? 1.2 : 2);
        }
    for (std::size_t link = 0; link < lanes.size(); ++link)
        if (queues[link].cars >= 0.05) tell_queue(canvas, lanes[link], queues[link], width);
    const Entry entries[] = {{"flow, darker where denser", colors::sky},
                             {"waiting cars", colors::vermilion},
                             {"green turns", colors::green}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{"traffic",
                            "streets with their flows and queues, and the turns with green light",
                            {"BLX_model"},
                            {"flow-on-link", "q", "signal", "LINK-TO", "LINK-FROM", "TURN", "GREEN",
                             "X", "Y", "SOURCE-X", "SOURCE-Y", "SINK-X", "SINK-Y"},
                            draw};

}  // namespace rddl::render::traffic
