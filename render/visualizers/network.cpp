// Computers of a network: which run, which are connected, and which is rebooted.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::network {

namespace {

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &running = snapshot["running"], &connected = snapshot["CONNECTED|LINK"];
    const int count = running.count(0);
    const Box body = area.above(20);
    const Point center = body.center();
    const double size = std::clamp(2 * M_PI * (body.height / 2 - 22) / count * 0.36, 5.0, 18.0);
    const double radius = body.height / 2 - size - 18;
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b) {
            if (!connected.is(a, b) || a == b || (a > b && connected.is(b, a))) continue;
            const Point from = on_circle(center, radius, a, count);
            const Point to = on_circle(center, radius, b, count);
            canvas.line(from, to, colors::rule, 1);
        }
    int up = 0;
    for (int c = 0; c < count; ++c) {
        const Point at = on_circle(center, radius, c, count);
        up += running.is(c);
        canvas.disc(at, size, running.is(c) ? colors::green : rgb(0x4b4f56));
        if (!running.is(c)) {
            const double d = size * 0.4;
            canvas.line({at.x - d, at.y - d}, {at.x + d, at.y + d}, colors::white, 2);
            canvas.line({at.x - d, at.y + d}, {at.x + d, at.y - d}, colors::white, 2);
        }
        if (snapshot.acts() && snapshot["reboot"].is(c))
            canvas.ring(at, size + 3.5, colors::orange, 3.5);
        const Point outside = on_circle(center, radius + size + 11, c, count);
        canvas.text(outside, running.object(0, c),
                    {.size = 9, .color = colors::muted, .align = Align::Center});
    }
    canvas.text({area.x, area.y + 8}, "running", {.size = 11, .color = colors::muted});
    canvas.text({area.x, area.y + 26}, std::to_string(up) + " of " + std::to_string(count),
                {.size = 14});
    const Entry entries[] = {
        {"running", colors::green}, {"down", rgb(0x4b4f56)}, {"rebooted", colors::orange}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{"network",
                            "computers that run or are down, their connections, reboots",
                            {"sysadmin_mdp", "sysadmin_pomdp", "sysadmin", "network"},
                            {"running", "CONNECTED|LINK", "reboot"},
                            draw};

}  // namespace rddl::render::network
