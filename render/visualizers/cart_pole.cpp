// A pole that stands on a cart, within the angles and places that it must not leave (A. Barto, R.
// Sutton, C. Anderson, IEEE Transactions on Systems, Man, and Cybernetics 13, 1983).
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::cart_pole {

namespace {

// The push between -1 and 1, to the right if it is positive.
double push(const Snapshot& snapshot) {
    if (!snapshot.acts()) return 0;
    if (snapshot.has("force-side|push-right"))
        return snapshot.number("force-side|push-right") > 0 ? 1 : -1;
    const double most = snapshot.number_or("FORCE-MAX", 10);
    return std::clamp(snapshot.number("force") / most, -1.0, 1.0);
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const double limit = snapshot.number("POS-LIMIT|TRACK-LIMIT");
    const double length = 2 * snapshot.number("POLE-LEN|POLE-LENGTH");
    const Plane plane(area.inset(8, 0), -1.12 * limit, -0.45, 1.12 * limit, length * 2.4);
    const double track = plane(0, 0).y;
    canvas.line({area.x, track}, {area.right(), track}, colors::muted, 1.5);
    for (const double end : {-limit, limit}) {
        const double x = plane(end, 0).x;
        canvas.dashed_line({x, plane.box.y + 30}, {x, track + 14}, colors::vermilion, 1.5);
        canvas.text({x, track + 24}, number_text(end),
                    {.size = 11, .color = colors::muted, .align = Align::Center});
    }
    const double angle = snapshot.number("ang-pos|angle");
    const double most = snapshot.number_or("ANG-LIMIT|ANGLE-LIMIT", 0.2);
    const double half_width = 36, height = 30;
    const Point cart = plane(snapshot.number("pos|position"), 0);
    const Point joint{cart.x, cart.y - height - 8};
    const double pole = plane.length(length) * 1.9;
    canvas.sector(joint, pole + 14, -M_PI / 2 - most, -M_PI / 2 + most, rgb(0xe5f3ee));

    canvas.fill({cart.x - half_width, joint.y, 2 * half_width, height}, colors::blue, 5);
    for (const double wheel : {-20.0, 20.0}) {
        canvas.disc({cart.x + wheel, track - 8}, 8, colors::ink);
        canvas.disc({cart.x + wheel, track - 8}, 3, colors::rule);
    }
    canvas.line(joint, {joint.x + pole * std::sin(angle), joint.y - pole * std::cos(angle)},
                std::abs(angle) > most ? colors::vermilion : colors::orange, 9);
    canvas.disc(joint, 5, colors::ink);
    const double force = push(snapshot), side = force > 0 ? 1 : -1;
    if (force != 0)
        arrow(canvas, {cart.x + side * (half_width + 4), joint.y + height / 2},
              {cart.x + side * (half_width + 10 + 30 * std::abs(force)), joint.y + height / 2},
              colors::vermilion, 3.5);

    const double degrees = angle * 180 / M_PI;
    canvas.text({area.x, area.y + 8}, "angle " + number_text(std::round(degrees * 10) / 10) + "°",
                {.size = 11, .color = colors::muted});
    canvas.text({area.right(), area.y + 8},
                "green: angles up to " + number_text(std::round(most * 1800 / M_PI) / 10) + "°",
                {.size = 11, .color = colors::muted, .align = Align::Right});
}

}  // namespace

const Visualizer visualizer{
    "cart_pole",
    "the cart with its push, the pole, and the limits of both",
    {"cart_pole_discrete", "cart_pole_continuous", "cart_pole"},
    {"pos|position", "ang-pos|angle", "POS-LIMIT|TRACK-LIMIT", "POLE-LEN|POLE-LENGTH"},
    draw};

}  // namespace rddl::render::cart_pole
