#include "render/visualizer.hpp"

#include "render/state_text.hpp"
#include "render/widgets.hpp"

#include <algorithm>

namespace rddl::render {

namespace {

constexpr double margin = 12, title_height = 26, footer_height = 26;

void draw_title(Canvas& canvas, const Box& box, const Snapshot& snapshot) {
    const rddl_problem& problem = snapshot.problem();
    const double right = canvas.text_width(problem.domain, 11);
    label(canvas, box.before(right + 12), problem.instance, {.size = 14});
    label(canvas, box, problem.domain, {.size = 11, .color = colors::muted, .align = Align::Right});
    canvas.line({box.x, box.bottom()}, {box.right(), box.bottom()}, colors::rule, 0.8);
}

void draw_footer(Canvas& canvas, const Box& box, const Snapshot& snapshot) {
    const Step& now = snapshot.now();
    canvas.line({box.x, box.y}, {box.right(), box.y}, colors::rule, 0.8);
    const double y = box.y + 15;
    // Columns of their own, so that numbers that change do not move what stands beside them.
    double x = box.x;
    const auto pair = [&](std::string_view name, const std::string& value, double width) {
        canvas.text({x, y}, name, {.size = 11, .color = colors::muted});
        const double after = x + canvas.text_width(name, 11) + 5;
        canvas.text({after, y}, value, {.size = 11});
        x = std::max(x + width, after + canvas.text_width(value, 11) + 12);
    };
    std::string step = std::to_string(now.number);
    if (snapshot.horizon() > 0) step += " / " + std::to_string(snapshot.horizon());
    pair("step", step, 100);
    pair("return", number_text(now.total), 104);
    if (!snapshot.acts()) {
        if (!now.end.empty()) pair("ended", now.end, 0);
        return;
    }
    pair("reward", number_text(now.reward), 104);
    const Box rest = Box{x, y - 8, box.right() - x, 16};
    canvas.text({rest.x, y}, "action", {.size = 11, .color = colors::muted});
    label(canvas, rest.after(canvas.text_width("action", 11) + 5), action_text(snapshot),
          {.size = 11});
}

}  // namespace

void draw_picture(Canvas& canvas, const Visualizer& visualizer, const Snapshot& snapshot) {
    canvas.clear(colors::paper);
    const Box area = canvas.area();
    const Box inner = area.inset(margin, 0);
    draw_title(canvas, inner.top(title_height), snapshot);
    draw_footer(canvas, inner.lowest(footer_height), snapshot);
    const Box body = inner.below(title_height).above(footer_height).inset(0, 8);
    const Canvas::Saved whole = canvas.clipped(inner.below(title_height).above(footer_height));
    visualizer.draw(canvas, body, snapshot);
}

}  // namespace rddl::render
