// Formulas as pictures: inputs on the left, outputs on the right, functions between them in
// columns.
#include "solvers/cgp/formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rddlc::solvers {

namespace {

struct Box {
    std::string label;
    std::vector<int> sources;  // boxes whose values it reads, in order
    bool is_function = false, is_output = false;
    int column = 0;
    double width = 0, x = 0, y = 0;  // of the middle
};

constexpr double height = 28, row_height = 46, gap = 70, margin = 16, letter = 7.6;

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return result;
}

// Each stands right of all that it reads.
std::vector<Box> boxes_of(const Formula& formula, const ProgramScope& scope) {
    std::vector<Box> boxes;
    int last = 0;
    const auto add = [&](Box box) {
        for (const int source : box.sources)
            box.column = std::max(box.column, boxes[static_cast<std::size_t>(source)].column + 1);
        last = std::max(last, box.column);
        box.width = letter * static_cast<double>(box.label.size()) + 18;
        boxes.push_back(std::move(box));
    };
    for (const Formula::Term& term : formula.terms) {
        Box box;
        box.is_function = term.kind == Formula::Term::Kind::Function;
        box.label = term.kind == Formula::Term::Kind::Input
                        ? input_label(scope.inputs[static_cast<std::size_t>(term.input)])
                    : box.is_function ? std::string(info_of(term.function).name)
                                      : fmt::format("{:.4g}", term.constant);
        for (const int argument : term.arguments)
            if (argument >= 0) box.sources.push_back(argument);
        add(std::move(box));
    }
    const int outputs = std::max(last, formula.terms.empty() ? 0 : 1);
    for (std::size_t o = 0; o < formula.outputs.size(); ++o) {
        Box box;
        box.label = scope.outputs[o];
        box.sources = {formula.outputs[o]};
        box.is_output = true;
        box.column = outputs + (last > 0 ? 1 : 0);
        add(std::move(box));
    }
    return boxes;
}

// Column by column, each box as near as may be to the mean height of what it reads.
struct Size {
    double width, height;
};
Size place(std::vector<Box>& boxes) {
    int columns = 0;
    for (const Box& box : boxes) columns = std::max(columns, box.column + 1);
    double x = margin, bottom = 0;
    for (int c = 0; c < columns; ++c) {
        std::vector<Box*> own;
        double widest = 0;
        for (Box& box : boxes) {
            if (box.column != c) continue;
            for (const int source : box.sources)
                box.y += boxes[static_cast<std::size_t>(source)].y /
                         static_cast<double>(box.sources.size());
            widest = std::max(widest, box.width);
            own.push_back(&box);
        }
        std::stable_sort(own.begin(), own.end(),
                         [](const Box* a, const Box* b) { return a->y < b->y; });
        double next = margin + height / 2;
        for (Box* const box : own) {
            box->x = x + widest / 2;
            box->y = std::max(box->y, next);
            next = box->y + row_height;
            bottom = std::max(bottom, box->y + height / 2);
        }
        x += widest + gap;
    }
    return {x - gap + margin, bottom + margin};
}

}  // namespace

// The input's label, with the scaling that the program applies.
std::string input_label(const ProgramInput& input) {
    std::string text = input.name;
    if (input.shift != 0)
        text =
            fmt::format("{} {} {:.4g}", text, input.shift > 0 ? '-' : '+', std::abs(input.shift));
    if (input.scale == 1) return text;
    return fmt::format("{} * {:.4g}", input.shift != 0 ? "(" + text + ")" : text, input.scale);
}

std::string formula_svg(const Formula& formula, const ProgramScope& scope) {
    std::vector<Box> boxes = boxes_of(formula, scope);
    const Size size = place(boxes);
    std::string text = fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" viewBox="0 0 {0:.0f} {1:.0f}" )"
        "font-family=\"monospace\" font-size=\"12\" text-anchor=\"middle\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        size.width, size.height);
    const auto out = std::back_inserter(text);
    for (const Box& box : boxes)
        for (std::size_t k = 0; k < box.sources.size(); ++k) {
            const Box& from = boxes[static_cast<std::size_t>(box.sources[k])];
            // Arguments arrive one below the other, in their order.
            const double spread = height / static_cast<double>(box.sources.size() + 1);
            const double x1 = from.x + from.width / 2, x2 = box.x - box.width / 2;
            const double y2 = box.y - height / 2 + spread * static_cast<double>(k + 1);
            const double middle = (x1 + x2) / 2;
            fmt::format_to(out,
                           "<path d=\"M{0:.1f} {1:.1f}C{2:.1f} {1:.1f} {2:.1f} {4:.1f} {3:.1f} "
                           "{4:.1f}\" fill=\"none\" stroke=\"#8a8f98\"/>\n",
                           x1, from.y, middle, x2, y2);
        }
    for (const Box& box : boxes)
        fmt::format_to(
            out,
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" rx=\"{}\" fill=\"{}\" "
            "stroke=\"#3b4252\" stroke-width=\"{}\"/>\n<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
            box.x - box.width / 2, box.y - height / 2, box.width, height,
            box.is_function ? height / 2 : 3, box.is_function ? "#e8eef7" : "#f6f3ea",
            box.is_output ? 2 : 1, box.x, box.y + 4, escaped(box.label));
    return text + "</svg>\n";
}

}  // namespace rddlc::solvers
