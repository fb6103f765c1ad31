#include "emit/line_directives.hpp"

#include "emit/literals.hpp"

namespace rddlc::cpp {

std::string line_directive(const Sources& sources, Span span) {
    return "#line " + std::to_string(sources.position(span).line) + " " +
           literal(std::string_view(sources[span.file].path())) + "\n";
}

std::string restore_lines(const std::string& text, const std::string& name) {
    std::string result;
    int number = 1;
    for (std::size_t begin = 0; begin < text.size(); ++number) {
        const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
        const std::string_view line = std::string_view(text).substr(begin, end - begin);
        begin = end;
        // The directive names the number of the line after it.
        result += line == line_restorer ? "#line " + std::to_string(number + 1) + " " +
                                              literal(std::string_view(name)) + "\n"
                                        : std::string(line);
    }
    return result;
}

}  // namespace rddlc::cpp
