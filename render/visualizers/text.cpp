// The values of a state in words, in as many columns as are needed; changes are marked.
#include "render/state_text.hpp"
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace rddl::render::text {

namespace {

constexpr double largest_size = 13, smallest_size = 8;  // of letters
constexpr double line_height = 1.5;                     // of their size
constexpr std::size_t most_columns = 8;

// A line on the picture: a long list of objects continues in lines without a name.
struct Row {
    std::string_view name;
    std::string value;
    bool changed, is_list;
};

// A word and its width with letters of size 1.
struct Word {
    std::string_view text;
    double width;
};

// "(x1, y1)" is one word.
std::vector<Word> words_of(const Canvas& canvas, std::string_view text) {
    std::vector<Word> words;
    std::size_t begin = 0;
    int depth = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size()) depth += (text[i] == '(') - (text[i] == ')');
        if (i < text.size() && (text[i] != ' ' || depth > 0)) continue;
        const std::string_view word = text.substr(begin, i - begin);
        words.push_back({word, canvas.text_width(word, 12) / 12});
        begin = i + 1;
    }
    return words;
}

struct Line {
    const TextLine& text;
    double name_width, value_width;  // with letters of size 1
    std::vector<Word> words;         // of a list

    bool is_list() const { return words.size() > 1; }
};

std::vector<Line> measured(const Canvas& canvas, const std::vector<TextLine>& texts) {
    std::vector<Line> lines;
    for (const TextLine& text : texts) {
        Line line{text, canvas.text_width(text.name, 12) / 12, 0, words_of(canvas, text.value)};
        for (const Word& word : line.words) line.value_width += word.width;
        lines.push_back(std::move(line));
    }
    return lines;
}

double room_for_name(const Line& line, double size, double width) {
    return std::min(line.name_width * size + 10, width * 0.6);
}

std::vector<Row> rows_of(const std::vector<Line>& lines, double size, double width) {
    std::vector<Row> rows;
    constexpr double space = 0.32;
    for (const Line& line : lines) {
        if (!line.is_list()) {
            rows.push_back({line.text.name, line.text.value, line.text.changed, false});
            continue;
        }
        const double room = (width - 8 - room_for_name(line, size, width)) / size;
        double used = 0;
        rows.push_back({line.text.name, "", line.text.changed, true});
        for (const Word& word : line.words) {
            if (used > 0 && used + space + word.width > room) {
                rows.push_back({"", "", line.text.changed, true});
                used = 0;
            }
            std::string& value = rows.back().value;
            value += (value.empty() ? "" : " ") + std::string(word.text);
            used += (used > 0 ? space : 0) + word.width;
        }
    }
    return rows;
}

// The text that fits with letters of a size, in columns of one width.
struct Layout {
    double size;
    std::size_t columns, rows;  // a column has so many rows
};

Layout layout_for(const std::vector<Line>& lines, const Box& area) {
    double widest = 0;  // of a column with letters of size 1; lists are broken
    for (const Line& line : lines)
        widest = std::max(widest, line.name_width + (line.is_list() ? 8 : line.value_width));
    Layout layout{};
    for (double size = largest_size; size >= smallest_size; size -= 0.5) {
        const auto rows = static_cast<std::size_t>(area.height / (size * line_height));
        // Names are shortened where there would be a single column, or two.
        const auto most = std::clamp(static_cast<std::size_t>(area.width / (widest * size + 24)),
                                     std::size_t{3}, most_columns);
        for (std::size_t columns = 1; columns <= most; ++columns) {
            layout = {size, columns, rows};
            if (lines.size() > columns * rows) continue;
            const double width = area.width / static_cast<double>(columns);
            if (rows_of(lines, size, width).size() <= columns * rows) return layout;
        }
    }
    return layout;
}

void draw_row(Canvas& canvas, const Box& box, const Row& row, double size) {
    if (row.changed) canvas.fill(box.inset(-2, 1), rgb(0xfff3cf), 3);
    const double room = std::min(canvas.text_width(row.name, size), box.width * 0.6);
    canvas.text({box.x, box.center().y}, shortened_name(canvas, row.name, size, room + 1),
                {.size = size, .color = colors::muted});
    label(canvas, box.after(row.name.empty() ? 10 : room + 10), row.value,
          {.size = size, .align = row.is_list ? Align::Left : Align::Right});
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const std::vector<TextLine> texts = state_lines(snapshot);
    if (texts.empty()) return;
    const std::vector<Line> lines = measured(canvas, texts);
    const auto [size, columns, rows] = layout_for(lines, area);
    const double width = area.width / static_cast<double>(columns), height = size * line_height;
    const std::vector<Row> all = rows_of(lines, size, width);
    const std::size_t places = columns * rows;
    const std::size_t shown = all.size() > places ? places - 1 : all.size();
    for (std::size_t i = 0; i < shown; ++i)
        draw_row(canvas,
                 Box{area.x + static_cast<double>(i / rows) * width,
                     area.y + static_cast<double>(i % rows) * height, width, height}
                     .inset(4, 0),
                 all[i], size);
    if (shown < all.size())
        canvas.text({area.right(), area.y + (static_cast<double>(rows) - 0.5) * height},
                    "and " + std::to_string(all.size() - shown) + " more",
                    {.size = size, .color = colors::muted, .align = Align::Right});
}

}  // namespace

const Visualizer visualizer{"text", "the values of a state in words", {}, {}, draw};

}  // namespace rddl::render::text
