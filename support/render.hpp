// The one place where diagnostics become text.
#pragma once

#include "support/diagnostic.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rddlc {

enum class DiagnosticsFormat { Text, Json };

struct RenderOptions {
    DiagnosticsFormat format = DiagnosticsFormat::Text;
    bool color = false;            // ANSI colours, for terminals
    std::size_t error_limit = 50;  // 0: no limit
};

// Text: "path:line:col: error: message [E0203]", the source line, a caret line with the
// "declared here" note beside it, then notes and hint. Json: an array of objects.
std::string render(const Diagnostics& diagnostics, const Sources& sources,
                   const RenderOptions& options);

// The lines below the diagnostics: their number, and how `program` explains the first error. Empty
// if there is nothing to report.
std::string closing_lines(const Diagnostics& diagnostics, std::string_view program);
// "'rddl --explain E0203' explains it\n"
std::string pointer_to_explanation(Code code, std::string_view program);

// "1 error", "2 errors"
std::string counted(std::size_t count, std::string_view what);

// Each as text, without colours.
struct RenderedDiagnostic {
    Code code;
    bool is_error;
    std::string text;
};
std::vector<RenderedDiagnostic> render_each(const Diagnostics& diagnostics, const Sources& sources);

// The first line of a span and a caret line below it, as in the text form of a diagnostic.
std::string source_excerpt(const Sources& sources, Span span);

}  // namespace rddlc
