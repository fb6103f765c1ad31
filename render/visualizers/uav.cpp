// Aircraft from above and from the side, their ways, and their goals.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::uav {

namespace {

// Two of the three directions, by the names of their fluents.
struct View {
    std::string_view title, across, up, goal_across, goal_up;
};

Plane plane_of(const Box& box, const Snapshot& snapshot, const View& view) {
    Extent across, up;
    for (const auto& [name, extent] :
         {std::pair{view.goal_across, &across}, std::pair{view.goal_up, &up}})
        for (const double value : snapshot[name].numbers) extent->add(value);
    for (const auto& [name, extent] : {std::pair{view.across, &across}, std::pair{view.up, &up}})
        for (const Step& step : snapshot.steps())
            for (const double value :
                 snapshot.values_in(step, *snapshot.world().find(name)).numbers)
                extent->add(value);
    across = across.rounded();
    up = up.rounded();
    return {box, across.low, up.low, across.high, up.high};
}

void draw_aircraft(Canvas& canvas, Point place, double heading, Color color) {
    const Canvas::Saved saved = canvas.moved(place, heading);
    const Point shape[] = {{11, 0}, {-7, -7}, {-3.5, 0}, {-7, 7}};
    canvas.polygon(shape, color);
}

void draw_view(Canvas& canvas, const Box& box, const Snapshot& snapshot, const View& view) {
    canvas.text({box.x, box.y + 6}, view.title, {.size = 11, .color = colors::muted});
    const Box field = box.below(18).above(room_below).after(room_at_left);
    canvas.fill(field, rgb(0xf6f9fc));
    canvas.outline(field, colors::rule, 0.8);
    const Plane plane = plane_of(field.inset(10), snapshot, view);
    const auto number_at = [&](Point at) {
        return Point{plane.left + (at.x - plane.box.x) / plane.factor,
                     plane.bottom + (plane.box.bottom() - at.y) / plane.factor};
    };
    const Point low = number_at({field.x, field.bottom()});
    const Point high = number_at({field.right(), field.y});
    field_ticks(canvas, field, {low.x, high.x, field.x, field.right()},
                {low.y, high.y, field.bottom(), field.y});
    const Canvas::Saved inside = canvas.clipped(field);
    const Values& x = snapshot[view.across];
    const Values &goal_x = snapshot[view.goal_across], &goal_y = snapshot[view.goal_up];
    for (int i = 0; i < x.count(0); ++i) {
        const bool ours = snapshot["CONTROLLABLE"].is(i);
        const Color color = ours ? series_color(static_cast<std::size_t>(i)) : colors::muted;
        if (ours) {
            const Point goal = plane(goal_x(i), goal_y(i));
            canvas.ring(goal, 8, color, 2);
            canvas.disc(goal, 3, color);
        }
        std::vector<Point> way;
        for (const Step& step : snapshot.steps())
            way.push_back(plane(snapshot.number_in(step, view.across, static_cast<std::size_t>(i)),
                                snapshot.number_in(step, view.up, static_cast<std::size_t>(i))));
        trail(canvas, way, color);
        const Point now = way.back();
        double heading = 0;
        for (std::size_t k = way.size() - 1; k-- > 0;)
            if (std::hypot(now.x - way[k].x, now.y - way[k].y) > 1) {
                heading = std::atan2(now.y - way[k].y, now.x - way[k].x);
                break;
            }
        draw_aircraft(canvas, now, heading, color);
        canvas.text({now.x + 10, now.y - 10}, x.object(0, i),
                    {.size = 10, .color = colors::muted, .halo = true});
    }
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Box body = area.above(20);
    draw_view(canvas, body.left(body.width * 0.56), snapshot,
              {"from above (x, y)", "pos-x", "pos-y", "GOAL-X", "GOAL-Y"});
    draw_view(canvas, body.after(body.width * 0.56 + 14), snapshot,
              {"from the side (x, height)", "pos-x", "pos-z", "GOAL-X", "GOAL-Z"});
    std::vector<Entry> entries;
    const Values& ours = snapshot["CONTROLLABLE"];
    bool others = false;
    for (int i = 0; i < ours.count(0); ++i) {
        if (ours.is(i))
            entries.push_back({std::string(ours.object(0, i)) + " and its goal",
                               series_color(static_cast<std::size_t>(i))});
        else
            others = true;
    }
    if (others) entries.push_back({"others", colors::muted});
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{
    "uav",
    "aircraft from above and from the side, their ways and goals",
    {"kinematic_UAVs_con", "kinematic_UAVs_dis", "kinematic_UAVs_mix"},
    {"pos-x", "pos-y", "pos-z", "GOAL-X", "GOAL-Y", "GOAL-Z", "CONTROLLABLE"},
    draw};

}  // namespace rddl::render::uav
