// The values of a state in words, in as many columns as are needed; what has changed stands out.
#include "render/state_text.hpp"
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>

namespace rddl::render::text {

namespace {

void draw(Canvas& canvas, const Box& area, const Moment& moment) {
    const std::vector<TextLine> lines = state_lines(moment);
    if (lines.empty()) return;
    const bool has_lists = std::any_of(lines.begin(), lines.end(),
                                       [](const TextLine& line) { return line.value.size() > 24; });
    // The largest letters that leave room for all.
    double size = 13;
    std::size_t columns = 1, rows = 1;
    const std::size_t most_columns = has_lists ? 2 : 4;
    for (; size >= 8; size -= 0.5) {
        rows = static_cast<std::size_t>(area.height / (size * 1.5));
        columns = (lines.size() + rows - 1) / rows;
        if (columns <= most_columns) break;
    }
    columns = std::clamp<std::size_t>(columns, 1, most_columns);
    const double width = area.width / static_cast<double>(columns), height = size * 1.5;
    const std::size_t places = columns * rows;
    const std::size_t shown = lines.size() > places ? places - 1 : lines.size();
    for (std::size_t i = 0; i < shown; ++i) {
        const Box box = Box{area.x + static_cast<double>(i / rows) * width,
                            area.y + static_cast<double>(i % rows) * height, width, height}
                            .inset(4, 0);
        if (lines[i].changed) canvas.fill(box.inset(-2, 1), rgb(0xfff3cf), 3);
        const double name_width = std::min(canvas.text_width(lines[i].name, size), box.width * 0.6);
        label(canvas, box.left(name_width + 1), lines[i].name,
              {.size = size, .color = colors::muted});
        label(canvas, box.after(name_width + 10), lines[i].value,
              {.size = size, .align = has_lists ? Align::Left : Align::Right});
    }
    if (shown < lines.size())
        canvas.text({area.right(), area.bottom() - height / 2},
                    "and " + std::to_string(lines.size() - shown) + " more",
                    {.size = size, .color = colors::muted, .align = Align::Right});
}

}  // namespace

const Visualizer visualizer{"text", "the values of a state in words", {}, {}, draw};

}  // namespace rddl::render::text
