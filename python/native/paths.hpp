// Texts and paths that Python gives.
#pragma once

#include <nanobind/nanobind.h>

#include <string>
#include <vector>

namespace rddlc::python {

// All of a str, NUL characters too; what UTF-8 cannot write is escaped.
std::string utf8_text(nanobind::handle text);

// A str, bytes or os.PathLike. Every native call takes its paths through this: a path that is cut
// at a NUL character, or that Python and C++ write differently, is another file. Throws Refused for
// anything but a path, for a NUL character and for a name that is not UTF-8.
std::string path_of(nanobind::handle given);
std::vector<std::string> paths_of(nanobind::handle list);

}  // namespace rddlc::python
