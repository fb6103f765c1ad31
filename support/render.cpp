#include "support/render.hpp"

#include "support/json_text.hpp"
#include "support/utf8.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

namespace rddlc {

namespace {

// ------------------------------------------------------------------------- one line of source

constexpr std::size_t tab_width = 4;
constexpr std::size_t window_width = 110;  // longer lines are shown around the caret only
constexpr std::string_view ellipsis = "...";

// The display of a piece of source on a terminal, one element per column: tabs become blanks,
// invisible characters a replacement character. Wide characters are followed by an empty element;
// accents stand in the element of their character.
void append_columns(std::vector<std::string>& columns, std::string_view text) {
    while (!text.empty()) {
        const Character character = first_character(text);
        text.remove_prefix(character.bytes.size());
        if (character.bytes == "\t") {
            columns.insert(columns.end(), tab_width - columns.size() % tab_width, " ");
        } else if (!character.is_visible) {
            columns.emplace_back("\xEF\xBF\xBD");
        } else if (character.width == 0) {
            if (columns.empty()) columns.emplace_back(" ");
            columns.back() += character.bytes;
        } else {
            columns.emplace_back(character.bytes);
            if (character.width > 1) columns.emplace_back();
        }
    }
}

// A source line as shown, with the marked columns [begin, end).
struct Excerpt {
    std::vector<std::string> columns;
    std::size_t begin;
    std::size_t end;
};

// The part of a line around [first, last): enough bytes to fill a window, so that the cost does
// not depend on how long the line is. Does not begin inside a character.
struct Part {
    std::string_view before, marked, after;
    bool cut_left, cut_right;
};

Part part_of(std::string_view line, std::size_t first, std::size_t last) {
    constexpr std::size_t reach = 4 * window_width;  // a code point has at most 4 bytes
    std::size_t begin = first > reach ? first - reach : 0;
    while (begin > 0 && begin < first && !begins_character(line[begin])) ++begin;
    const std::size_t end = std::min(line.size(), first + reach);
    last = std::min(last, end);
    return {line.substr(begin, first - begin), line.substr(first, last - first),
            line.substr(last, end - last), begin > 0, end < line.size()};
}

// The first line of the span; a span over several lines is marked to the end of the first.
Part part_of(const Source& source, Span span) {
    const int number = source.position(span.begin).line;
    const std::string_view line = source.line(number);
    const std::size_t line_begin = source.line_begin(number);
    const std::size_t first = std::min(span.begin - line_begin, line.size());
    return part_of(line, first, std::clamp(span.end - line_begin, first, line.size()));
}

// Cuts what does not fit into the window.
Excerpt excerpt_of(const Part& part) {
    std::vector<std::string> columns;
    append_columns(columns, part.before);
    const std::size_t begin = columns.size();
    append_columns(columns, part.marked);
    const std::size_t end = std::max(columns.size(), begin + 1);
    append_columns(columns, part.after);
    if (columns.size() <= window_width && !part.cut_left && !part.cut_right)
        return {std::move(columns), begin, end};

    const std::size_t half = window_width / 2;
    const std::size_t first = begin > half ? begin - half : 0;
    const std::size_t last = std::min(first + window_width, columns.size());
    const bool cut_left = part.cut_left || first > 0;
    const bool cut_right = part.cut_right || last < columns.size();
    std::vector<std::string> shown(columns.begin() + static_cast<std::ptrdiff_t>(first),
                                   columns.begin() + static_cast<std::ptrdiff_t>(last));
    if (shown.front().empty()) shown.front() = " ";  // half of a wide character
    if (cut_left) shown.emplace(shown.begin(), ellipsis);
    if (cut_right) shown.emplace_back(ellipsis);
    // The leading ellipsis is one element, but as wide as its text.
    const std::size_t shift = cut_left ? ellipsis.size() : 0;
    return {std::move(shown), begin - first + shift,
            std::max(std::min(end, last) - first, begin - first + 1) + shift};
}

std::string joined(const std::vector<std::string>& columns) {
    std::string text;
    for (const std::string& column : columns) text += column;
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

// ---------------------------------------------------------------------------------------- text

struct Palette {
    std::string_view bold, error, warning, note, caret, off;
};
constexpr Palette plain{};
constexpr Palette colored{"\x1b[1m",    "\x1b[1;31m", "\x1b[1;35m",
                          "\x1b[1;36m", "\x1b[1;32m", "\x1b[0m"};

// "declared here" becomes "declared at path:line:col"; nothing for notes of another form.
std::optional<std::string> beside_caret(const Note& note, const Sources& sources) {
    constexpr std::string_view here = " here";
    const std::string_view message = note.message;
    if (!note.span || !message.ends_with(here)) return std::nullopt;
    return fmt::format("{} at {}", message.substr(0, message.size() - here.size()),
                       sources.location(*note.span));
}

// The line of source and the caret line, with a remark beside the caret.
std::string source_lines(const Sources& sources, Span span, const std::string& remark,
                         const Palette& palette) {
    const Excerpt excerpt = excerpt_of(part_of(sources[span.file], span));
    const std::string source = joined(excerpt.columns);
    const std::string tildes(excerpt.end - excerpt.begin - 1, '~');
    return fmt::format("{:5} |{}{}\n", sources.position(span).line, source.empty() ? "" : " ",
                       source) +
           fmt::format("{:5} | {:{}}{}^{}{}{}{}\n", "", "", excerpt.begin, palette.caret, tildes,
                       palette.off, remark.empty() ? "" : "   ", printable_line(remark));
}

class TextRenderer {
  public:
    TextRenderer(const Diagnostics& diagnostics, const Sources& sources, bool color)
        : diagnostics_(diagnostics), sources_(sources), palette_(color ? colored : plain) {}

    std::string render(const Diagnostic& diagnostic) const {
        std::string text = headline(diagnostic);
        const Note* beside = nullptr;
        if (diagnostic.span) {
            std::string remark;
            if (!diagnostic.notes.empty())
                if (auto found = beside_caret(diagnostic.notes.front(), sources_)) {
                    beside = &diagnostic.notes.front();
                    remark = std::move(*found);
                }
            text += source_lines(sources_, *diagnostic.span, remark, palette_);
        }
        for (const Note& note : diagnostic.notes)
            if (&note != beside) text += note_line(note);
        if (!diagnostic.hint.empty())
            text += fmt::format("{}hint:{} {}\n", palette_.note, palette_.off,
                                printable(diagnostic.hint));
        return text;
    }

  private:
    std::string headline(const Diagnostic& diagnostic) const {
        const bool error = diagnostics_.is_error(diagnostic);
        return fmt::format("{0}{1}{2}{3}{4}:{2} {0}{5}{2} [{6}]\n", palette_.bold,
                           place(diagnostic.span), palette_.off,
                           error ? palette_.error : palette_.warning, error ? "error" : "warning",
                           printable(diagnostic.message), to_string(diagnostic.code));
    }

    std::string note_line(const Note& note) const {
        return fmt::format("{}{}note:{} {}\n", place(note.span), palette_.note, palette_.off,
                           printable(note.message));
    }

    std::string place(const std::optional<Span>& span) const {
        return span ? printable_line(sources_.location(*span)) + ": " : "";
    }

    const Diagnostics& diagnostics_;
    const Sources& sources_;
    Palette palette_;
};

std::string render_text(const Diagnostics& diagnostics, const Sources& sources,
                        const RenderOptions& options) {
    const TextRenderer renderer(diagnostics, sources, options.color);
    std::string text;
    std::size_t errors = 0;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        if (diagnostics.is_error(diagnostic) && ++errors > options.error_limit &&
            options.error_limit != 0) {
            const std::size_t left = diagnostics.error_count() - options.error_limit;
            return text + fmt::format("{} more error{} not shown\n", left, left == 1 ? "" : "s");
        }
        text += renderer.render(diagnostic);
    }
    return text;
}

// ---------------------------------------------------------------------------------------- JSON

using nlohmann::ordered_json;

void add_place(ordered_json& object, const std::optional<Span>& span, const Sources& sources) {
    if (!span) return;
    const Source& source = sources[span->file];
    const Position begin = source.position(span->begin);
    const Position end = source.position(span->end);
    object["file"] = source.path();
    object["line"] = begin.line;
    object["column"] = begin.column;
    object["end_line"] = end.line;
    object["end_column"] = end.column;
}

ordered_json to_json(const Diagnostic& diagnostic, const Diagnostics& diagnostics,
                     const Sources& sources) {
    ordered_json object;
    object["severity"] = diagnostics.is_error(diagnostic) ? "error" : "warning";
    object["code"] = to_string(diagnostic.code);
    object["message"] = diagnostic.message;
    add_place(object, diagnostic.span, sources);
    object["notes"] = ordered_json::array();
    for (const Note& note : diagnostic.notes) {
        ordered_json& entry = object["notes"].emplace_back();
        entry["message"] = note.message;
        add_place(entry, note.span, sources);
    }
    if (!diagnostic.hint.empty()) object["hint"] = diagnostic.hint;
    for (const Replacement& replacement : diagnostic.fix) {
        ordered_json& entry = object["fix"].emplace_back();
        add_place(entry, replacement.span, sources);
        entry["text"] = replacement.text;
    }
    return object;
}

std::string render_json(const Diagnostics& diagnostics, const Sources& sources) {
    ordered_json array = ordered_json::array();
    for (const Diagnostic& diagnostic : diagnostics.all())
        array.push_back(to_json(diagnostic, diagnostics, sources));
    // Paths and excerpts of broken files may not be UTF-8.
    return json_document(array);
}

}  // namespace

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string pointer_to_explanation(Code code, std::string_view program) {
    return fmt::format("'{} --explain {}' explains it\n", program, to_string(code));
}

std::string closing_lines(const Diagnostics& diagnostics, std::string_view program) {
    const auto& all = diagnostics.all();
    const std::size_t errors = diagnostics.error_count();
    const std::size_t warnings = all.size() - errors;
    if (all.empty()) return "";
    if (errors == 0) return counted(warnings, "warning") + "\n";
    const auto first = std::ranges::find_if(
        all, [&](const Diagnostic& each) { return diagnostics.is_error(each); });
    return counted(errors, "error") + (warnings == 0 ? "" : ", " + counted(warnings, "warning")) +
           "\n" + pointer_to_explanation(first->code, program);
}

std::vector<RenderedDiagnostic> render_each(const Diagnostics& diagnostics,
                                            const Sources& sources) {
    const TextRenderer renderer(diagnostics, sources, false);
    std::vector<RenderedDiagnostic> all;
    for (const Diagnostic& diagnostic : diagnostics.all())
        all.push_back(
            {diagnostic.code, diagnostics.is_error(diagnostic), renderer.render(diagnostic)});
    return all;
}

std::string source_excerpt(const Sources& sources, Span span) {
    return source_lines(sources, span, {}, plain);
}

std::string render(const Diagnostics& diagnostics, const Sources& sources,
                   const RenderOptions& options) {
    return options.format == DiagnosticsFormat::Json ? render_json(diagnostics, sources)
                                                     : render_text(diagnostics, sources, options);
}

}  // namespace rddlc
