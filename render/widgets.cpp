#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render {

double Scale::operator()(double number) const {
    const double part = high > low ? (number - low) / (high - low) : 0.5;
    return begin + (end - begin) * part;
}

double Scale::clamped(double number) const {
    return std::clamp((*this)(number), std::min(begin, end), std::max(begin, end));
}

std::vector<double> ticks(double low, double high, int wanted) {
    std::vector<double> numbers;
    if (!(high > low) || !std::isfinite(high - low)) return numbers;
    const double raw = (high - low) / std::max(wanted, 1);
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    const double rest = raw / power;
    const double step = power * (rest <= 1 ? 1 : rest <= 2 ? 2 : rest <= 5 ? 5 : 10);
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
        numbers.push_back(k * step);
        if (numbers.size() > 50) break;
    }
    constexpr int enough = 8;  // a single number shows no scale
    if (numbers.size() < 2 && wanted < enough) return ticks(low, high, 2 * std::max(wanted, 1));
    return numbers;
}

Scale scale_around(double low, double high, double begin, double end, double margin) {
    if (!(low <= high)) low = 0, high = 1;  // no number at all
    double spread = (high - low) * margin;
    if (high - low <= 1e-12 * std::max(std::abs(low), std::abs(high)) || high == low)
        spread = std::max(std::abs(low) * 0.1, 0.5);
    return {low - spread, high + spread, begin, end};
}

Plane::Plane(const Box& outer, double l, double b, double r, double t)
    : box(outer.fitted(std::max(r - l, 1e-9), std::max(t - b, 1e-9))),
      left(l),
      bottom(b),
      factor(box.width / std::max(r - l, 1e-9)) {}

Point Plane::operator()(double x, double y) const {
    return {box.x + (x - left) * factor, box.bottom() - (y - bottom) * factor};
}

void field_ticks(Canvas& canvas, const Box& field, const Scale& across, const Scale& up) {
    TextStyle style{.size = 9, .color = colors::muted, .align = Align::Center};
    for (const double tick : ticks(across.low, across.high, static_cast<int>(field.width / 50))) {
        const double x = across(tick);
        canvas.line({x, field.bottom()}, {x, field.bottom() + 3}, colors::rule);
        canvas.text({x, field.bottom() + 9}, number_text(tick), style);
    }
    style.align = Align::Right;
    for (const double tick : ticks(up.low, up.high, static_cast<int>(field.height / 40))) {
        const double y = up(tick);
        canvas.line({field.x - 3, y}, {field.x, y}, colors::rule);
        canvas.text({field.x - 6, y}, number_text(tick), style);
    }
}

void field_ticks(Canvas& canvas, const Plane& plane) {
    const Box& box = plane.box;
    const double right = plane.left + box.width / plane.factor;
    const double top = plane.bottom + box.height / plane.factor;
    field_ticks(canvas, box, {plane.left, right, box.x, box.right()},
                {plane.bottom, top, box.bottom(), box.y});
}

std::string shortened(const Canvas& canvas, std::string_view text, double size, double width) {
    if (canvas.text_width(text, size) <= width) return std::string(text);
    // Halves the interval, since texts may be long.
    std::size_t fits = 0, too_long = text.size();
    const auto with_dots = [&](std::size_t length) {
        while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0) == 0x80) --length;
        return std::string(text.substr(0, length)) + "…";
    };
    while (fits + 1 < too_long) {
        const std::size_t middle = (fits + too_long) / 2;
        (canvas.text_width(with_dots(middle), size) <= width ? fits : too_long) = middle;
    }
    return fits == 0 ? "" : with_dots(fits);
}

std::string shortened_name(const Canvas& canvas, std::string_view name, double size, double width) {
    if (canvas.text_width(name, size) <= width) return std::string(name);
    const auto continues = [&](std::size_t at) {  // a letter that begins before
        return at < name.size() && (static_cast<unsigned char>(name[at]) & 0xc0) == 0x80;
    };
    const auto with_dots = [&](std::size_t kept) {
        std::size_t head = kept / 2, tail = name.size() - (kept - kept / 2);
        while (continues(head)) --head;
        while (continues(tail)) ++tail;
        return std::string(name.substr(0, head)) + "…" + std::string(name.substr(tail));
    };
    std::size_t fits = 0, too_long = name.size();
    while (fits + 1 < too_long) {
        const std::size_t middle = (fits + too_long) / 2;
        (canvas.text_width(with_dots(middle), size) <= width ? fits : too_long) = middle;
    }
    return fits == 0 ? "" : with_dots(fits);
}

void label(Canvas& canvas, const Box& box, std::string_view text, TextStyle style) {
    const Point middle = box.center();
    const double x = style.align == Align::Left    ? box.x
                     : style.align == Align::Right ? box.right()
                                                   : middle.x;
    canvas.text({x, middle.y}, shortened(canvas, text, style.size, box.width), style);
}

void arrow(Canvas& canvas, Point from, Point to, Color color, double thickness) {
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double length = std::hypot(dx, dy);
    if (!(length > 0.5)) return;
    const double ux = dx / length, uy = dy / length;
    const double head = std::min(3.5 * thickness + 2, length);
    const Point neck{to.x - ux * head, to.y - uy * head};
    canvas.line(from, {neck.x + ux * 0.5, neck.y + uy * 0.5}, color, thickness);
    const Point tip[] = {to,
                         {neck.x - uy * head * 0.5, neck.y + ux * head * 0.5},
                         {neck.x + uy * head * 0.5, neck.y - ux * head * 0.5}};
    canvas.polygon(tip, color);
}

void gauge(Canvas& canvas, const Box& box, double part, Color color, std::span<const Mark> marks) {
    canvas.fill(box, colors::faint);
    const double full = std::isnan(part) ? 0 : std::clamp(part, 0.0, 1.0);
    canvas.fill(box.lowest(box.height * full), color);
    for (const Mark& mark : marks) {
        if (!(mark.part >= 0 && mark.part <= 1)) continue;
        const double y = box.bottom() - box.height * mark.part;
        canvas.line({box.x, y}, {box.right(), y}, mark.color, 1.5);
    }
    canvas.outline(box, colors::muted, 1);
}

namespace {

// The spaces of legends with letters of that size.
struct Spaces {
    explicit Spaces(double size)
        : swatch(size * 10 / 11), before_name(size * 5 / 11), between(size * 14 / 11) {}
    double swatch, before_name, between;
};

double legend_width(const Canvas& canvas, std::span<const Entry> entries, double size) {
    const Spaces spaces(size);
    double width = -spaces.between;
    for (const Entry& entry : entries)
        width += spaces.swatch + spaces.before_name + canvas.text_width(entry.name, size) +
                 spaces.between;
    return std::max(width, 0.0);
}

}  // namespace

void legend(Canvas& canvas, const Box& box, std::span<const Entry> entries, double size) {
    const Spaces spaces(size);
    const double y = box.center().y, swatch = spaces.swatch;
    const TextStyle style{.size = size, .color = colors::muted};
    const bool all = legend_width(canvas, entries, size) <= box.width + 0.5;
    const double right = all ? box.right() + 1 : box.right() - 2 * size;  // room for "+12"
    double x = box.x;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double width = swatch + spaces.before_name + canvas.text_width(entries[i].name, size);
        if (x + width > right) {
            const std::string more = "+" + std::to_string(entries.size() - i);
            canvas.text({std::min(x, box.right() - canvas.text_width(more, size)), y}, more, style);
            return;
        }
        const Box square{x, y - swatch / 2, swatch, swatch};
        canvas.fill(square, entries[i].color, 2);
        canvas.outline(square, colors::muted, 0.5, 2);
        canvas.text({x + swatch + spaces.before_name, y}, entries[i].name, style);
        x += width + spaces.between;
    }
}

bool whole_legend_at_right(Canvas& canvas, const Box& box, std::span<const Entry> entries) {
    for (const double size : {11.0, 9.0}) {
        const double width = legend_width(canvas, entries, size);
        if (width > box.width) continue;
        legend(canvas, box.rightmost(width), entries, size);
        return true;
    }
    return false;
}

void legend_at_right(Canvas& canvas, const Box& box, std::vector<Entry> entries) {
    if (whole_legend_at_right(canvas, box, entries)) return;
    // Each name has as much room as the others, if that is enough to read it.
    constexpr double size = 9, least = 28;
    if (box.width < 2 * size) return;  // not even for "+2"
    const Spaces spaces(size);
    const double room = (box.width + spaces.between) / static_cast<double>(entries.size()) -
                        spaces.swatch - spaces.before_name - spaces.between;
    for (Entry& entry : entries)
        entry.name = shortened_name(canvas, entry.name, size, std::max(room, least));
    const double width = legend_width(canvas, entries, size);
    legend(canvas, box.rightmost(std::min(width, box.width)), entries, size);
}

Grid::Grid(const Box& outer, int wanted_columns, int wanted_rows, bool square)
    : box(square ? outer.fitted(wanted_columns, wanted_rows) : outer),
      columns(wanted_columns),
      rows(wanted_rows) {}

Box Grid::cell(int column, int row) const {
    const double width = box.width / columns, height = box.height / rows;
    return {box.x + column * width, box.y + row * height, width, height};
}

void Extent::add(double number) {
    if (!std::isfinite(number)) return;
    low = empty ? number : std::min(low, number);
    high = empty ? number : std::max(high, number);
    empty = false;
}

Extent Extent::rounded() const {
    if (empty) return {0, 1, false};
    const double span = std::max({high - low, 1e-9, 1e-6 * std::abs(high)});
    const double step = std::pow(2.0, std::ceil(std::log2(span))) / 8;
    return {(std::floor(low / step) - 0.5) * step, (std::ceil(high / step) + 0.5) * step, false};
}

void arc_arrow(Canvas& canvas, Point center, double radius, double from, double to, Color color,
               double thickness) {
    if (std::abs(to - from) < 0.02) return;
    canvas.arc(center, radius, std::min(from, to), std::max(from, to), color, thickness);
    const double side = to > from ? 1 : -1, size = 3.5 * thickness;
    const Point end{center.x + radius * std::cos(to), center.y + radius * std::sin(to)};
    const double ux = -std::sin(to) * side, uy = std::cos(to) * side;  // on along the arc
    const Point tip[] = {{end.x + ux * size, end.y + uy * size},
                         {end.x - uy * size * 0.6, end.y + ux * size * 0.6},
                         {end.x + uy * size * 0.6, end.y - ux * size * 0.6}};
    canvas.polygon(tip, color);
}

void person(Canvas& canvas, Point feet, double height, Color color) {
    const double head = height * 0.17;
    canvas.disc({feet.x, feet.y - height + head}, head, color);
    canvas.fill({feet.x - height * 0.2, feet.y - height * 0.62, height * 0.4, height * 0.62}, color,
                height * 0.15);
}

std::vector<int> order_of(const Values& follows) {
    const int count = follows.count(0);
    std::vector<int> rank(static_cast<std::size_t>(count), 0);
    const auto at = [&](int i) -> int& {
        return rank[static_cast<std::size_t>(i)];
    };
    bool told = false;
    for (int round = 0; round < count; ++round)  // a circle also ends there
        for (int a = 0; a < count; ++a)
            for (int b = 0; b < count; ++b)
                if (a != b && follows.is(a, b)) {
                    at(b) = std::min(std::max(at(b), at(a) + 1), count - 1);
                    told = true;
                }
    for (int i = 0; i < count && !told; ++i) at(i) = i;
    return rank;
}

void trail(Canvas& canvas, std::span<const Point> points, Color color, double thickness) {
    // A trail consists of a few pieces of one strength each, so that long ones cost little.
    constexpr std::size_t pieces = 8;
    const std::size_t length = std::max<std::size_t>(points.size() / pieces, 1);
    for (std::size_t begin = 0; begin + 1 < points.size(); begin += length) {
        const std::size_t end = std::min(begin + length + 1, points.size());
        const double part = static_cast<double>(end) / static_cast<double>(points.size());
        canvas.polyline(points.subspan(begin, end - begin), color.with_alpha(0.1 + 0.5 * part),
                        thickness);
    }
}

Point on_circle(Point center, double radius, int number, int count) {
    const double angle = 2 * M_PI * number / std::max(count, 1) - M_PI / 2;
    return {center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)};
}

}  // namespace rddl::render
