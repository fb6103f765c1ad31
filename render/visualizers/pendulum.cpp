// A pendulum that is swung up by a small torque; its angle counts from the top.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::pendulum {

namespace {

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Box square = area.square();
    const Point axle = square.center();
    const double length = square.width * 0.4, angle = snapshot.number("theta");
    const auto end = [&](double theta) {
        return Point{axle.x - length * std::sin(theta), axle.y - length * std::cos(theta)};
    };
    canvas.ring(axle, length, colors::faint, 2);
    canvas.dashed_line(axle, {axle.x, axle.y - length - 14}, colors::green, 1.5);
    // Earlier positions are drawn fainter the older they are.
    const auto& steps = snapshot.steps();
    const std::size_t trail = std::min<std::size_t>(steps.size(), 12);
    for (std::size_t k = trail; k-- > 1;) {
        const double theta = snapshot.number_in(steps[steps.size() - 1 - k], "theta");
        const double age = static_cast<double>(k) / 12;
        canvas.disc(end(theta), 9, colors::blue.with_alpha(0.22 * (1 - age)));
    }
    canvas.line(axle, end(angle), colors::blue, 14);
    canvas.disc(end(angle), 13, colors::blue);
    canvas.disc(axle, 6, colors::ink);
    if (snapshot.acts()) {
        const double part =
            std::clamp(snapshot.number("torque") / snapshot.number_or("TORQUE-MAX", 2), -1.0, 1.0);
        // A positive torque turns against the clock.
        arc_arrow(canvas, axle, 30, M_PI / 2, M_PI / 2 - part * 2.2, colors::vermilion, 3.5);
    }
    const double turned = std::remainder(angle, 2 * M_PI) * 180 / M_PI;
    canvas.text({area.x, area.y + 8}, "angle from the top", {.size = 11, .color = colors::muted});
    canvas.text({area.x, area.y + 26}, number_text(std::round(turned)) + "°", {.size = 14});
    if (!snapshot.has("theta-dot")) return;
    canvas.text({area.x, area.y + 52}, "speed", {.size = 11, .color = colors::muted});
    canvas.text({area.x, area.y + 70}, number_text(snapshot.number("theta-dot")), {.size = 14});
}

}  // namespace

const Visualizer visualizer{"pendulum",
                            "the pendulum, its way, and the torque at its axle",
                            {"pendulum"},
                            {"theta", "torque"},
                            draw};

}  // namespace rddl::render::pendulum
