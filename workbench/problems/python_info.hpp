// Reads the `info = {'name': 'TSP', ...}` literal of an __init__.py, without Python.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace rddlc::workbench {

// The string-valued members of the first dictionary in `text`; other members are skipped.
std::map<std::string, std::string> read_python_info(std::string_view text);

}  // namespace rddlc::workbench
