// Disks on rods; the target rod is green.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>

namespace rddl::render::tower_of_hanoi {

namespace {

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Values &on = snapshot["disk-on-rod"], &order = snapshot["disk-order"];
    const Values &size = snapshot["SIZE"], &target = snapshot["TARGET"];
    const int disks = on.count(0), rods = on.count(1);
    const Box body = area.above(30).below(30);
    const double width = body.width / rods;
    const double thick = std::min(body.height * 0.8 / disks, 34.0);
    const double largest = *std::max_element(size.numbers.begin(), size.numbers.end());
    const double floor = body.bottom();
    canvas.fill({body.x, floor, body.width, 8}, colors::muted, 3);
    for (int r = 0; r < rods; ++r) {
        const double x = body.x + (r + 0.5) * width;
        const Color color = target.is(r) ? colors::green : colors::muted;
        canvas.fill({x - 4, floor - disks * thick - 24, 8, disks * thick + 24}, color, 4);
        canvas.text({x, floor + 20},
                    std::string(on.object(1, r)) + (target.is(r) ? " (target)" : ""),
                    {.size = 11, .color = color, .align = Align::Center});
    }
    for (int d = 0; d < disks; ++d)
        for (int r = 0; r < rods; ++r) {
            if (!on.is(d, r)) continue;
            const double half = width * (0.12 + 0.33 * size(d) / largest);
            const double x = body.x + (r + 0.5) * width;
            const Box disk{x - half, floor - (order(d) + 1) * thick, 2 * half, thick - 2};
            canvas.fill(disk, series_color(static_cast<std::size_t>(d)), thick * 0.3);
            canvas.text(disk.center(), on.object(0, d),
                        {.size = std::min(12.0, thick * 0.6),
                         .color = text_on(series_color(static_cast<std::size_t>(d))),
                         .align = Align::Center});
            for (int to = 0; to < rods && snapshot.acts(); ++to) {
                if (!snapshot["move"].is(d, to)) continue;
                const double y = floor - disks * thick - 38;
                arrow(canvas, {x, y}, {body.x + (to + 0.5) * width, y}, colors::vermilion, 3);
                canvas.outline(disk.inset(-1), colors::vermilion, 3, thick * 0.3);
            }
        }
}

}  // namespace

const Visualizer visualizer{"tower_of_hanoi",
                            "disks on rods, the target, and the move",
                            {"tower_of_hanoi"},
                            {"disk-on-rod", "disk-order", "SIZE", "TARGET", "move"},
                            draw};

}  // namespace rddl::render::tower_of_hanoi
