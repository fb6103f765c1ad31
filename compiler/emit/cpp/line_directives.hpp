// #line: what a debugger shows for a line of the emitted text is the RDDL line that it came from.
#pragma once

#include "support/source.hpp"

#include <string>
#include <string_view>

namespace rddlc::cpp {

// The next line of the text belongs to the place in the RDDL source.
std::string line_directive(const Sources& sources, Span span);

// Stands where the text is itself again; its number is known only when the file is complete.
inline const std::string line_restorer = "#line here";

// Fills in all restorers. `name` is what the file will be called.
std::string restore_lines(const std::string& text, const std::string& name);

}  // namespace rddlc::cpp
