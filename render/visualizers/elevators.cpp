// A building with its elevators: where they are, whether they are open, and which people wait on
// which floor.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::elevators {

namespace {

void triangle(Canvas& canvas, Point center, double size, bool up, Color color) {
    const double s = up ? -size : size;
    const Point shape[] = {{center.x, center.y + s},
                           {center.x - size, center.y - s * 0.7},
                           {center.x + size, center.y - s * 0.7}};
    canvas.polygon(shape, color);
}

// Some persons from the left, and their number where they are too many.
void draw_people(Canvas& canvas, const Box& box, int count, Color color) {
    const double height = std::min(box.height * 0.55, 22.0), width = height * 0.55;
    const int room = static_cast<int>((box.width - 26) / width);
    const int shown = std::clamp(count, 0, std::max(room, 1));
    for (int i = 0; i < shown; ++i)
        person(canvas, {box.x + (i + 0.7) * width, box.bottom() - 3}, height, color);
    if (count > shown || count > 4)
        canvas.text({box.x + (shown + 0.6) * width, box.bottom() - 3 - height / 2},
                    std::to_string(count), {.size = 11});
}

struct Building {
    Box shafts, halls;
    int elevators, floors;
    std::vector<int> height;  // of each floor, 0 at the bottom

    Box shaft(int elevator, int floor) const {
        const double width = shafts.width / elevators, story = shafts.height / floors;
        const int level = height[static_cast<std::size_t>(floor)];
        return {shafts.x + elevator * width, shafts.bottom() - (level + 1) * story, width, story};
    }
    Box hall(int floor) const {
        const Box at = shaft(0, floor);
        return {halls.x, at.y, halls.width, at.height};
    }
};

Building building(const Box& area, const Snapshot& snapshot) {
    const Values& at = snapshot["elevator-at-floor"];
    const double width = std::min(at.count(0) * 90.0, area.width * 0.55);
    return {area.after(40).left(width), area.after(40 + width + 16), at.count(0), at.count(1),
            order_of(snapshot["ADJACENT-UP"])};
}

void draw_floors(Canvas& canvas, const Building& building, const Values& at) {
    for (int f = 0; f < building.floors; ++f) {
        const Box hall = building.hall(f), shaft = building.shaft(0, f);
        canvas.line({building.shafts.x - 36, hall.bottom()}, {hall.right(), hall.bottom()},
                    colors::rule, 1.2);
        canvas.text({building.shafts.x - 34, shaft.center().y}, at.object(1, f),
                    {.size = 11, .color = colors::muted});
    }
    for (int e = 0; e < building.elevators; ++e) {
        const double width = building.shafts.width / building.elevators;
        canvas.fill(
            Box{building.shafts.x + e * width, building.shafts.y, width, building.shafts.height}
                .inset(5, 0),
            colors::faint);
    }
}

// Draws the cabin; returns the place for people inside.
Box draw_cabin(Canvas& canvas, const Box& shaft, const Snapshot& snapshot, int elevator) {
    const Box cabin = shaft.inset(8, std::min(shaft.height * 0.08, 5.0));
    const bool closed = snapshot["elevator-closed"].is(elevator);
    canvas.fill(cabin, closed ? rgb(0xc9dcec) : rgb(0xfdf3cf), 3);
    canvas.outline(cabin, colors::blue, 2, 3);
    if (closed)
        canvas.line({cabin.center().x, cabin.y}, {cabin.center().x, cabin.bottom()}, colors::blue,
                    1);
    triangle(canvas, {cabin.right() - 9, cabin.y + 9}, 5, snapshot["elevator-dir-up"].is(elevator),
             colors::ink);
    return cabin.before(12).inset(2, 0);
}

// The action of an elevator in a word, below its shaft.
std::string action_of(const Snapshot& snapshot, int elevator) {
    if (!snapshot.acts()) return {};
    for (const auto& [fluent, word] :
         {std::pair{"move-current-dir", "move"}, std::pair{"open-door", "open"},
          std::pair{"open-door-going-up", "open up"},
          std::pair{"open-door-going-down", "open down"}, std::pair{"close-door", "close"}})
        if (snapshot.has(fluent) && snapshot[fluent].is(elevator)) return word;
    return "–";
}

using People = void (*)(Canvas&, const Building&, const Snapshot&, int elevator, const Box& cabin);
using Waiting = void (*)(Canvas&, const Building&, const Snapshot&, int floor);

void draw_building(Canvas& canvas, const Box& area, const Snapshot& snapshot, People people,
                   Waiting waiting) {
    const Building house = building(area.above(38), snapshot);
    const Values& at = snapshot["elevator-at-floor"];
    draw_floors(canvas, house, at);
    for (int f = 0; f < house.floors; ++f) waiting(canvas, house, snapshot, f);
    for (int e = 0; e < house.elevators; ++e) {
        for (int f = 0; f < house.floors; ++f) {
            if (!at.is(e, f)) continue;
            const Box cabin = draw_cabin(canvas, house.shaft(e, f), snapshot, e);
            people(canvas, house, snapshot, e, cabin);
        }
        const Box shaft = house.shaft(e, 0);
        const std::string action = action_of(snapshot, e);
        label(canvas, {shaft.x, house.shafts.bottom() + 2, shaft.width, 15},
              action.empty() ? at.object(0, e) : at.object(0, e) + (": " + action),
              {.size = 11, .align = Align::Center});
    }
    const Entry entries[] = {{"closed", rgb(0xc9dcec)}, {"open", rgb(0xfdf3cf)}};
    legend(canvas, area.lowest(14), entries);
}

void draw_counted(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    draw_building(
        canvas, area, snapshot,
        [](Canvas& on, const Building&, const Snapshot& now, int e, const Box& cabin) {
            draw_people(on, cabin, static_cast<int>(now["num-person-in-elevator"](e)), colors::ink);
        },
        [](Canvas& on, const Building& house, const Snapshot& now, int f) {
            draw_people(on, house.hall(f), static_cast<int>(now["num-person-waiting"](f)),
                        colors::orange);
        });
}

// Somebody, with the direction in which he wants to go.
void draw_traveller(Canvas& canvas, const Box& box, double x, bool up, Color color) {
    const double height = std::min(box.height * 0.6, 26.0);
    person(canvas, {x, box.bottom() - 3}, height, color);
    triangle(canvas, {x + height * 0.5, box.bottom() - 3 - height * 0.7}, height * 0.18, up, color);
}

void draw_directed(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    draw_building(
        canvas, area, snapshot,
        [](Canvas& on, const Building&, const Snapshot& now, int e, const Box& cabin) {
            if (now["person-in-elevator-going-up"].is(e))
                draw_traveller(on, cabin, cabin.x + cabin.width * 0.2, true, colors::ink);
            if (now["person-in-elevator-going-down"].is(e))
                draw_traveller(on, cabin, cabin.x + cabin.width * 0.62, false, colors::ink);
        },
        [](Canvas& on, const Building& house, const Snapshot& now, int f) {
            const Box hall = house.hall(f);
            if (now["person-waiting-up"].is(f))
                draw_traveller(on, hall, hall.x + 20, true, colors::orange);
            if (now["person-waiting-down"].is(f))
                draw_traveller(on, hall, hall.x + 70, false, colors::vermilion);
        });
}

}  // namespace

const Visualizer visualizer{
    "elevators",
    "elevators at their floors, and who waits to go up or down",
    {"elevators_mdp", "elevators_pomdp"},
    {"elevator-at-floor", "elevator-closed", "elevator-dir-up", "person-waiting-up",
     "person-waiting-down", "person-in-elevator-going-up", "person-in-elevator-going-down",
     "ADJACENT-UP"},
    draw_directed};

const Visualizer visualizer_of_counts{
    "elevators_counted",
    "elevators at their floors, and how many wait and ride",
    {"elevators_int_mdp"},
    {"elevator-at-floor", "elevator-closed", "elevator-dir-up", "num-person-waiting",
     "num-person-in-elevator", "ADJACENT-UP"},
    draw_counted};

}  // namespace rddl::render::elevators
