// Consumers, providers and items by their first two features, and how content they are.
#include "render/visualizers/visualizers.hpp"
#include "render/widgets.hpp"

#include <algorithm>
#include <cmath>

namespace rddl::render::recommender {

namespace {

double part_of(double value, const Values& all) {
    const auto [least, most] = std::minmax_element(all.numbers.begin(), all.numbers.end());
    return *most > *least ? (value - *least) / (*most - *least) : 0.5;
}

void draw_features(Canvas& canvas, const Box& box, const Snapshot& snapshot) {
    const Values &affinity = snapshot["CONSUMER-AFFINITY"],
                 &competence = snapshot["PROVIDER-COMPETENCE"];
    const Values &item = snapshot["item-feature"], &content = snapshot["consumer-satisfaction"];
    const int second = affinity.count(1) > 1 ? 1 : 0;
    Extent across, up;
    for (const Values* const values : {&affinity, &competence, &item})
        for (int i = 0; i < values->count(0); ++i) {
            across.add((*values)(i, 0));
            up.add((*values)(i, second));
        }
    across = across.rounded();
    up = up.rounded();
    canvas.fill(box, rgb(0xf6f9fc), 4);
    const Canvas::Saved inside = canvas.clipped(box);
    const Scale x{across.low, across.high, box.x, box.right()};
    const Scale y{up.low, up.high, box.bottom(), box.y};
    const auto place = [&](const Values& values, int i) {
        return Point{x(values(i, 0)), y(values(i, second))};
    };
    if (snapshot.acts() && snapshot.has("recommend")) {
        const Values& recommend = snapshot["recommend"];
        for (int c = 0; c < recommend.count(0); ++c)
            for (int i = 0; i < recommend.count(1); ++i)
                if (recommend.is(c, i))
                    canvas.line(place(affinity, c), place(item, i), colors::rule, 1);
    }
    for (int i = 0; i < item.count(0); ++i) {
        const Point at = place(item, i);
        canvas.fill({at.x - 2, at.y - 2, 4, 4}, colors::muted);
    }
    for (int c = 0; c < affinity.count(0); ++c) {
        const Point at = place(affinity, c);
        const double part = part_of(content(c), content);
        canvas.disc(at, 4 + 5 * part, sequential_color(0.2 + 0.7 * part));
        canvas.ring(at, 4 + 5 * part, colors::blue, 1);
    }
    const Values& pleased = snapshot["provider-satisfaction"];
    std::vector<Point> named;  // a name that would lie on another is left out
    for (int p = 0; p < competence.count(0); ++p) {
        const Point at = place(competence, p);
        const double r = 5 + 7 * part_of(pleased(p), pleased);
        const Point shape[] = {
            {at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, {at.x - r, at.y}};
        canvas.polygon(shape, colors::vermilion.with_alpha(0.85));
        const Point beside{at.x + r + 3, at.y};
        if (std::any_of(named.begin(), named.end(), [&](const Point& other) {
                return std::abs(other.x - beside.x) < 24 && std::abs(other.y - beside.y) < 11;
            }))
            continue;
        canvas.text(beside, competence.object(0, p), {.size = 9, .halo = true});
        named.push_back(beside);
    }
}

void draw_providers(Canvas& canvas, const Box& box, const Snapshot& snapshot) {
    const Values& pleased = snapshot["provider-satisfaction"];
    canvas.text({box.x, box.y + 6}, "content providers", {.size = 11, .color = colors::muted});
    const int count = pleased.count(0);
    const double height = std::min((box.height - 18) / count, 22.0);
    double most = 1e-9;
    for (const double value : pleased.numbers) most = std::max(most, value);
    for (int p = 0; p < count; ++p) {
        const Box row{box.x, box.y + 18 + p * height, box.width, height};
        if (height >= 9)
            label(canvas, row.left(30), pleased.object(0, p), {.size = 9, .color = colors::muted});
        const Box bar = row.after(32).before(40).inset(0, 1.5);
        canvas.fill(bar, colors::faint);
        canvas.fill(bar.left(bar.width * std::clamp(pleased(p) / most, 0.0, 1.0)),
                    colors::vermilion.with_alpha(0.85));
        if (height >= 9)
            label(canvas, row.rightmost(38), number_text(std::round(pleased(p) * 100) / 100),
                  {.size = 9, .align = Align::Right});
    }
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    const Box body = area.above(20);
    draw_features(canvas, body.before(180), snapshot);
    draw_providers(canvas, body.rightmost(166), snapshot);
    const Entry entries[] = {{"consumer, larger if content", colors::sky},
                             {"provider, larger if content", colors::vermilion},
                             {"item", colors::muted},
                             {"recommended", colors::rule}};
    legend(canvas, area.lowest(14), entries);
}

}  // namespace

const Visualizer visualizer{"recommender",
                            "consumers, providers and items by their features, and who is content",
                            {"recsim_ecosystem_welfare"},
                            {"provider-satisfaction", "consumer-satisfaction", "item-feature",
                             "PROVIDER-COMPETENCE", "CONSUMER-AFFINITY"},
                            draw};

}  // namespace rddl::render::recommender
