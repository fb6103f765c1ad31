// The canonical layout of RDDL text (`rddl fmt`).
#pragma once

#include "support/diagnostic.hpp"
#include "support/source.hpp"
#include "support/standard.hpp"

#include <optional>
#include <string>

namespace rddlc {

// The file in canonical layout: all tokens and comments as they are, other blanks and line breaks
// between them. Formatting the result changes nothing. Reports what is wrong and returns nothing if
// the file is not RDDL; throws std::logic_error if the result did not mean the same.
std::optional<std::string> format_file(const Sources& sources, FileId file,
                                       Diagnostics& diagnostics,
                                       Standard standard = Standard::PyRddlGym);

}  // namespace rddlc
