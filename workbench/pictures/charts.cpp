#include "pictures/charts.hpp"

#include "formats/number_text.hpp"
#include "pictures/picture_writer.hpp"
#include "solvers/training/training.hpp"
#include "support/files.hpp"

#include <fmt/format.h>
#include <render/canvas.hpp>
#include <render/png.hpp>
#include <render/widgets.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rddlc::workbench {

namespace render = rddl::render;

namespace {

constexpr double title_size = 14, text_size = 11, tick_size = 10;

std::string tick_text(double value) {
    return std::abs(value) >= 10000 ? solvers::count_text(value) : number_text(value + 0.0);
}

void draw_title(render::Canvas& canvas, const render::Box& area, const std::string& title) {
    canvas.text({area.x, area.y + title_size / 2},
                render::shortened(canvas, title, title_size, area.width), {.size = title_size});
}

// Lines at round numbers, with the numbers below.
void draw_x_axis(render::Canvas& canvas, const render::Box& plot, const render::Scale& x,
                 const std::string& title) {
    for (const double tick : render::ticks(x.low, x.high, static_cast<int>(plot.width / 80))) {
        const double at = x(tick);
        canvas.line({at, plot.y}, {at, plot.bottom()}, render::colors::faint);
        canvas.text(
            {at, plot.bottom() + 11}, tick_text(tick),
            {.size = tick_size, .color = render::colors::muted, .align = render::Align::Center});
    }
    canvas.line({plot.x, plot.bottom()}, {plot.right(), plot.bottom()}, render::colors::muted);
    canvas.text(
        {plot.center().x, plot.bottom() + 27}, title,
        {.size = text_size, .color = render::colors::muted, .align = render::Align::Center});
}

void draw_y_axis(render::Canvas& canvas, const render::Box& area, const render::Box& plot,
                 const render::Scale& y, const std::string& title) {
    for (const double tick : render::ticks(y.low, y.high, static_cast<int>(plot.height / 40))) {
        const double at = y(tick);
        canvas.line({plot.x, at}, {plot.right(), at}, render::colors::faint);
        canvas.text(
            {plot.x - 6, at}, tick_text(tick),
            {.size = tick_size, .color = render::colors::muted, .align = render::Align::Right});
    }
    canvas.text({area.x + 6, plot.center().y}, title,
                {.size = text_size,
                 .color = render::colors::muted,
                 .align = render::Align::Center,
                 .turn = -std::numbers::pi / 2});
}

// All entries, in as many rows as it takes. Returns the height.
double draw_legend(render::Canvas& canvas, const render::Box& area,
                   const std::vector<render::Entry>& entries) {
    constexpr double row_height = 18;
    std::vector<render::Entry> row;
    double used = 0, y = area.y;
    const auto flush = [&] {
        render::legend(canvas, {area.x, y, area.width + 1, row_height}, row);
        y += row_height;
        row.clear();
        used = 0;
    };
    for (render::Entry entry : entries) {
        entry.name = render::shortened(canvas, entry.name, text_size, area.width - 30);
        const double width = 29 + canvas.text_width(entry.name, text_size);
        if (!row.empty() && used + width > area.width) flush();
        row.push_back(entry);
        used += width;
    }
    if (!row.empty()) flush();
    return y - area.y;
}

void draw_curve(render::Canvas& canvas, const Curve& curve, const render::Scale& x,
                const render::Scale& y, render::Color color) {
    std::vector<render::Point> line, band;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
        line.push_back({x(curve.x[i]), y(curve.mean[i])});
        band.push_back({x(curve.x[i]), y(curve.mean[i] + curve.deviation[i])});
    }
    for (std::size_t i = curve.x.size(); i-- > 0;)
        band.push_back({x(curve.x[i]), y(curve.mean[i] - curve.deviation[i])});
    if (curve.runs > 1) canvas.polygon(band, color.with_alpha(0.2));
    if (line.size() > 1) canvas.polyline(line, color, 1.8);
    canvas.disc(line.back(), 2.6, color);
}

void draw(render::Canvas& canvas, const CurveChart& chart) {
    canvas.clear(render::colors::paper);
    const render::Box area = canvas.area().inset(16, 12);
    draw_title(canvas, area, chart.title);
    std::vector<render::Entry> entries;
    render::Extent xs, ys;
    for (const Curve& curve : chart.curves) {
        entries.push_back({curve.runs > 1
                               ? fmt::format("{} (mean ± std of {} runs)", curve.name, curve.runs)
                               : curve.name,
                           render::series_color(entries.size())});
        for (std::size_t i = 0; i < curve.x.size(); ++i) {
            xs.add(curve.x[i]);
            ys.add(curve.mean[i] - curve.deviation[i]);
            ys.add(curve.mean[i] + curve.deviation[i]);
        }
    }
    const double legend_height = draw_legend(canvas, area.below(22), entries);
    const render::Box plot = area.below(22 + legend_height + 8).above(36).after(62).before(8);
    const render::Scale x =
        render::scale_around(std::min(0.0, xs.low), xs.high, plot.x, plot.right(), 0);
    const render::Scale y = render::scale_around(ys.low, ys.high, plot.bottom(), plot.y);
    draw_x_axis(canvas, plot, x, chart.x_title);
    draw_y_axis(canvas, area, plot, y, chart.y_title);
    for (std::size_t c = 0; c < chart.curves.size(); ++c)
        draw_curve(canvas, chart.curves[c], x, y, render::series_color(c));
}

void draw(render::Canvas& canvas, const IntervalChart& chart) {
    canvas.clear(render::colors::paper);
    const render::Box area = canvas.area().inset(16, 12);
    draw_title(canvas, area, chart.title);
    double names = 0, numbers = 0;
    render::Extent xs;
    const auto mean_text = [](const IntervalChart::Row& row) {
        return row.half_width > 0
                   ? fmt::format("{} ± {:.3g}", number_text(row.mean), row.half_width)
                   : number_text(row.mean);
    };
    for (const IntervalChart::Row& row : chart.rows) {
        names = std::max(names, canvas.text_width(row.name, text_size));
        numbers = std::max(numbers, canvas.text_width(mean_text(row), text_size));
        for (const double number :
             {row.minimum, row.maximum, row.mean - row.half_width, row.mean + row.half_width})
            xs.add(number);
    }
    names = std::min(names, area.width * 0.3);
    const render::Box plot = area.below(34).above(36).after(names + 14).before(numbers + 14);
    const render::Scale x = render::scale_around(xs.low, xs.high, plot.x, plot.right());
    draw_x_axis(canvas, plot, x, chart.x_title);
    const double room = plot.height / static_cast<double>(chart.rows.size());
    for (std::size_t r = 0; r < chart.rows.size(); ++r) {
        const IntervalChart::Row& row = chart.rows[r];
        const double y = plot.y + (static_cast<double>(r) + 0.5) * room;
        const render::Color color = render::series_color(r);
        canvas.text({plot.x - 10, y}, render::shortened(canvas, row.name, text_size, names),
                    {.size = text_size, .align = render::Align::Right});
        canvas.line({x(row.minimum), y}, {x(row.maximum), y}, color.with_alpha(0.5), 1.5);
        for (const double end : {row.minimum, row.maximum})
            canvas.line({x(end), y - 4}, {x(end), y + 4}, color.with_alpha(0.5), 1.5);
        canvas.line({x(row.mean - row.half_width), y}, {x(row.mean + row.half_width), y}, color, 6);
        canvas.disc({x(row.mean), y}, 5, color);
        canvas.text({area.right(), y}, mean_text(row),
                    {.size = text_size, .align = render::Align::Right});
    }
}

template <class Chart>
void write(const Chart& chart, const ChartFiles& files) {
    UsedFiles used;
    if (!files.png.empty()) {
        render::Canvas canvas(files.width, files.height);
        draw(canvas, chart);
        render::Picture picture;
        canvas.read(picture);
        write_file(files.png, render::png_bytes(picture), used);
    }
    if (!files.svg.empty()) {
        render::Canvas canvas = render::Canvas::svg(files.width, files.height);
        draw(canvas, chart);
        write_file(files.svg, canvas.finish_svg(), used);
    }
}

}  // namespace

void require_writable_chart(const ChartFiles& files) {
    UsedFiles used;
    for (const std::string& file : {files.png, files.svg}) {
        if (file == "-")
            throw Failure("a chart is not written to standard output", "name a file", usage_error);
        if (!file.empty()) require_writable(file, used);
    }
}

void write_chart(const CurveChart& chart, const ChartFiles& files) {
    write(chart, files);
}

void write_chart(const IntervalChart& chart, const ChartFiles& files) {
    write(chart, files);
}

}  // namespace rddlc::workbench
