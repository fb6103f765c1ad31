// The one place where diagnostics become text.
#pragma once

#include "support/diagnostic.hpp"

#include <string>

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

// The first line of a span and a caret line below it, as in the text form of a diagnostic.
std::string source_excerpt(const Sources& sources, Span span);

}  // namespace rddlc
