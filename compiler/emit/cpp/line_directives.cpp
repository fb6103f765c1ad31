#include "emit/cpp/line_directives.hpp"

#include "emit/cpp/literals.hpp"

#include <sstream>

namespace rddlc::cpp {

std::string line_directive(const Sources& sources, Span span) {
    return "#line " + std::to_string(sources.position(span).line) + " " +
           literal(std::string_view(sources[span.file].path()));
}

std::string restore_lines(const std::string& text, const std::string& name) {
    std::istringstream lines(text);
    std::string result;
    int number = 1;
    for (std::string line; std::getline(lines, line); ++number) {
        // The directive names the number of the line after it.
        if (line == line_restorer)
            line = "#line " + std::to_string(number + 1) + " " + literal(std::string_view(name));
        result += line + "\n";
    }
    return result;
}

}  // namespace rddlc::cpp
