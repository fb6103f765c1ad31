#include "render/canvas.hpp"

#include "render/font.hpp"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <new>
#include <utility>
#include <vector>

namespace rddl::render {

namespace {

constexpr int least_size = 16, most_size = 8192;
constexpr double least_width = 600, least_height = 400;  // points

void require_size(int width, int height) {
    if (std::min(width, height) < least_size || std::max(width, height) > most_size)
        throw Error("a picture has from 16 to 8192 pixels in each direction, not " +
                    std::to_string(width) + " x " + std::to_string(height));
}

cairo_surface_t* image_surface(int width, int height) {
    require_size(width, height);
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
}

cairo_status_t append(void* text, const unsigned char* data, unsigned length) {
    try {
        static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
        return CAIRO_STATUS_SUCCESS;
    } catch (...) {
        return CAIRO_STATUS_NO_MEMORY;  // nothing is thrown through cairo, which is C
    }
}

// Coordinates in points: what lies farther off lies outside any picture, and is more than cairo's
// numbers hold.
constexpr double farthest = 1e5;

bool are_finite(std::initializer_list<double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

bool is_finite(const Box& box) {
    return are_finite({box.x, box.y, box.width, box.height});
}

double near(double coordinate) {
    return std::clamp(coordinate, -farthest, farthest);
}

Box near(const Box& box) {
    const double x = near(box.x), y = near(box.y);
    return {x, y, near(box.right()) - x, near(box.bottom()) - y};
}

unsigned byte_of(double part) {
    return std::isnan(part) ? 0
                            : static_cast<unsigned>(std::lround(std::clamp(part, 0.0, 1.0) * 255));
}

}  // namespace

std::uint32_t pixel_of(Color color) {
    return byte_of(color.red) << 16 | byte_of(color.green) << 8 | byte_of(color.blue);
}

void Canvas::Close::operator()(cairo_t* context) const {
    cairo_destroy(context);
}

void Canvas::Close::operator()(cairo_surface_t* surface) const {
    cairo_surface_destroy(surface);
}

Canvas::Canvas(int width, int height) : Canvas(image_surface(width, height), width, height) {}

Canvas::Canvas(cairo_surface_t* surface, int width, int height)
    : width_(width),
      height_(height),
      scale_(std::min(width / least_width, height / least_height)),
      surface_(surface),
      context_(cairo_create(surface)) {
    cairo_t* const context = context_.get();
    if (cairo_status(context) != CAIRO_STATUS_SUCCESS)
        throw Error(std::string("cairo cannot draw: ") +
                    cairo_status_to_string(cairo_status(context)));
    cairo_scale(context, scale_, scale_);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
    cairo_set_font_face(context, font_face());
    cairo_font_options_t* const options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(context, options);
    cairo_font_options_destroy(options);
}

Canvas Canvas::svg(int width, int height) {
    require_size(width, height);
    auto bytes = std::make_unique<std::string>();
    Canvas canvas(cairo_svg_surface_create_for_stream(append, bytes.get(), width, height), width,
                  height);
    cairo_svg_surface_set_document_unit(canvas.surface_.get(), CAIRO_SVG_UNIT_PX);
    canvas.bytes_ = std::move(bytes);
    return canvas;
}

Box Canvas::area() const {
    return {0, 0, width_ / scale_, height_ / scale_};
}

double Canvas::pixels_per_point() const {
    return scale_;
}

void Canvas::source(Color color) {
    cairo_set_source_rgba(context_.get(), color.red, color.green, color.blue, color.alpha);
}

void Canvas::clear(Color color) {
    source(color);
    cairo_paint(context_.get());
}

void Canvas::path(const Box& whole, double corner) {
    if (!is_finite(whole)) return;
    cairo_t* const context = context_.get();
    const Box box = near(whole);
    const double r = std::min({corner, box.width / 2, box.height / 2});
    if (r <= 0) {
        cairo_rectangle(context, box.x, box.y, box.width, box.height);
        return;
    }
    cairo_new_sub_path(context);
    cairo_arc(context, box.right() - r, box.y + r, r, -M_PI / 2, 0);
    cairo_arc(context, box.right() - r, box.bottom() - r, r, 0, M_PI / 2);
    cairo_arc(context, box.x + r, box.bottom() - r, r, M_PI / 2, M_PI);
    cairo_arc(context, box.x + r, box.y + r, r, M_PI, 3 * M_PI / 2);
    cairo_close_path(context);
}

void Canvas::fill(const Box& box, Color color, double corner) {
    source(color);
    path(box, corner);
    cairo_fill(context_.get());
}

void Canvas::outline(const Box& box, Color color, double thickness, double corner) {
    path(box, corner);
    stroke(color, thickness);
}

void Canvas::stroke(Color color, double thickness) {
    source(color);
    cairo_set_line_width(context_.get(), std::isfinite(thickness) ? near(thickness) : 0);
    cairo_stroke(context_.get());
}

void Canvas::path(std::span<const Point> points) {
    for (const Point& point : points) {
        if (are_finite({point.x, point.y}))
            cairo_line_to(context_.get(), near(point.x), near(point.y));
        else
            cairo_new_sub_path(context_.get());
    }
}

void Canvas::line(Point from, Point to, Color color, double thickness) {
    const Point points[] = {from, to};
    polyline(points, color, thickness);
}

void Canvas::dashed_line(Point from, Point to, Color color, double thickness, double dash) {
    cairo_set_dash(context_.get(), &dash, 1, 0);
    line(from, to, color, thickness);
    cairo_set_dash(context_.get(), nullptr, 0, 0);
}

void Canvas::polyline(std::span<const Point> points, Color color, double thickness) {
    if (points.size() == 2 && !are_finite({points[0].x, points[0].y, points[1].x, points[1].y}))
        return;  // not the end that is known
    path(points);
    stroke(color, thickness);
}

void Canvas::polygon(std::span<const Point> points, Color color) {
    source(color);
    path(points);
    cairo_fill(context_.get());
}

void Canvas::outline_polygon(std::span<const Point> points, Color color, double thickness) {
    path(points);
    cairo_close_path(context_.get());
    stroke(color, thickness);
}

void Canvas::disc(Point center, double radius, Color color) {
    sector(center, radius, 0, 2 * M_PI, color);
}

void Canvas::ring(Point center, double radius, Color color, double thickness) {
    arc(center, radius, 0, 2 * M_PI, color, thickness);
}

bool Canvas::arc_path(Point center, double radius, double from, double to) {
    if (!are_finite({center.x, center.y, radius, from, to})) return false;
    // One full circle is enough, and all that can be computed where angles are large.
    if (std::abs(to - from) > 2 * M_PI) from = 0, to = 2 * M_PI;
    cairo_arc(context_.get(), near(center.x), near(center.y), std::max(near(radius), 0.0), from,
              to);
    return true;
}

void Canvas::arc(Point center, double radius, double from, double to, Color color,
                 double thickness) {
    cairo_new_path(context_.get());
    if (arc_path(center, radius, from, to)) stroke(color, thickness);
}

void Canvas::sector(Point center, double radius, double from, double to, Color color) {
    source(color);
    cairo_new_path(context_.get());
    if (!arc_path(center, radius, from, to)) return;
    if (to - from < 2 * M_PI) cairo_line_to(context_.get(), near(center.x), near(center.y));
    cairo_fill(context_.get());
}

double Canvas::text_width(std::string_view text, double size) const {
    cairo_set_font_size(context_.get(), size);
    cairo_text_extents_t extents;
    cairo_text_extents(context_.get(), std::string(text).c_str(), &extents);
    return extents.x_advance;
}

void Canvas::text(Point place, std::string_view text, const TextStyle& style) {
    if (!(style.size > 0 && style.size < farthest)) return;
    cairo_t* const context = context_.get();
    const double width = style.align == Align::Left ? 0 : text_width(text, style.size);
    // The height of capital letters, so that texts of one line share a base line, whatever their
    // letters.
    const double height = 0.73 * style.size;
    const double x = style.align == Align::Left     ? 0
                     : style.align == Align::Center ? -width / 2
                                                    : -width;
    const double y = style.vertical == VerticalAlign::Top      ? height
                     : style.vertical == VerticalAlign::Middle ? height / 2
                                                               : 0;
    const Saved saved = moved(place, style.turn);
    cairo_set_font_size(context, style.size);
    if (style.halo) {
        cairo_move_to(context, x, y);
        cairo_text_path(context, std::string(text).c_str());
        stroke(colors::paper.with_alpha(0.85), 3);
    }
    source(style.color);
    cairo_move_to(context, x, y);
    cairo_show_text(context, std::string(text).c_str());
    cairo_new_path(context);
}

namespace {

// Fewer rows: each the average of those that lie where it is.
std::vector<std::uint32_t> averaged_rows(std::span<const std::uint32_t> colors, int columns,
                                         int rows, int wanted) {
    std::vector<std::uint32_t> averages;
    averages.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(wanted));
    for (int row = 0; row < wanted; ++row) {
        const double begin = static_cast<double>(row) * rows / wanted;
        const double end = static_cast<double>(row + 1) * rows / wanted;
        for (int column = 0; column < columns; ++column) {
            double sums[3] = {0.5, 0.5, 0.5};  // rounds
            for (int r = static_cast<int>(begin); r < rows && r < end; ++r) {
                const double part =
                    (std::min(end, r + 1.0) - std::max<double>(begin, r)) / (end - begin);
                const std::uint32_t color = colors[static_cast<std::size_t>(r * columns + column)];
                for (int k = 0; k < 3; ++k) sums[k] += part * (color >> 8 * k & 0xff);
            }
            std::uint32_t average = 0;
            for (int k = 0; k < 3; ++k) average |= static_cast<std::uint32_t>(sums[k]) << 8 * k;
            averages.push_back(average);
        }
    }
    return averages;
}

std::vector<std::uint32_t> transposed(std::span<const std::uint32_t> colors, int columns,
                                      int rows) {
    std::vector<std::uint32_t> turned;
    turned.reserve(colors.size());
    for (int column = 0; column < columns; ++column)
        for (int row = 0; row < rows; ++row)
            turned.push_back(colors[static_cast<std::size_t>(row * columns + column)]);
    return turned;
}

}  // namespace

void Canvas::cells(const Box& whole, int columns, int rows, std::span<const std::uint32_t> colors) {
    if (columns <= 0 || rows <= 0 || !is_finite(whole)) return;
    const Box box = near(whole);
    if (std::min(box.width, box.height) < 1 / farthest) return;
    // If there are more cells than pixels, a pixel is an average; the others stay sharp.
    const int pixel_rows = std::max(static_cast<int>(box.height * scale_), 1);
    const int pixel_columns = std::max(static_cast<int>(box.width * scale_), 1);
    std::vector<std::uint32_t> averages;
    if (rows > pixel_rows) {
        averages = averaged_rows(colors, columns, rows, pixel_rows);
        rows = pixel_rows;
        colors = averages;
    }
    if (columns > pixel_columns) {
        averages = averaged_rows(transposed(colors, columns, rows), rows, columns, pixel_columns);
        columns = pixel_columns;
        averages = transposed(averages, rows, columns);
        colors = averages;
    }
    cairo_t* const context = context_.get();
    const std::unique_ptr<cairo_surface_t, Close> image(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows));
    const int stride = cairo_image_surface_get_stride(image.get());
    unsigned char* const data = cairo_image_surface_get_data(image.get());
    if (!data) throw std::bad_alloc();
    for (int row = 0; row < rows; ++row)
        std::memcpy(data + row * stride, colors.data() + row * columns,
                    sizeof(std::uint32_t) * static_cast<std::size_t>(columns));
    cairo_surface_mark_dirty(image.get());
    const Saved saved = moved({box.x, box.y});
    cairo_scale(context, box.width / columns, box.height / rows);
    cairo_set_source_surface(context, image.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
    cairo_rectangle(context, 0, 0, columns, rows);
    cairo_fill(context);
}

Canvas::Saved::~Saved() {
    cairo_restore(context_);
}

Canvas::Saved Canvas::moved(Point origin, double turn, double factor) {
    cairo_t* const context = context_.get();
    cairo_save(context);
    // cairo would draw nothing from then on, in no picture.
    const bool sensible = std::abs(factor) > 1 / farthest && std::abs(factor) < farthest;
    if (!are_finite({origin.x, origin.y, turn}) || !sensible) {
        cairo_rectangle(context, 0, 0, 0, 0);
        cairo_clip(context);
        return Saved(context);
    }
    cairo_translate(context, near(origin.x), near(origin.y));
    if (turn != 0) cairo_rotate(context, std::remainder(turn, 2 * M_PI));
    if (factor != 1) cairo_scale(context, factor, factor);
    return Saved(context);
}

Canvas::Saved Canvas::clipped(const Box& box) {
    cairo_t* const context = context_.get();
    cairo_save(context);
    path(box, 0);
    cairo_clip(context);
    return Saved(context);
}

void Canvas::read(Picture& picture) const {
    cairo_surface_t* const surface = surface_.get();
    cairo_surface_flush(surface);
    const unsigned char* const data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    picture.width = width_;
    picture.height = height_;
    const auto columns = static_cast<std::size_t>(width_);
    picture.pixels.resize(columns * static_cast<std::size_t>(height_));
    for (int y = 0; y < height_; ++y) {
        std::uint32_t* const row = picture.pixels.data() + static_cast<std::size_t>(y) * columns;
        std::memcpy(row, data + static_cast<std::ptrdiff_t>(y) * stride, columns * sizeof *row);
        // The fourth byte means nothing to cairo, and may be anything.
        for (std::size_t x = 0; x < columns; ++x) row[x] &= 0xffffff;
    }
}

std::string Canvas::finish_svg() {
    cairo_surface_finish(surface_.get());
    const cairo_status_t status = cairo_surface_status(surface_.get());
    if (status != CAIRO_STATUS_SUCCESS)
        throw Error(std::string("cairo cannot write SVG: ") + cairo_status_to_string(status));
    return std::move(*bytes_);
}

}  // namespace rddl::render
