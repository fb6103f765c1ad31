// JSON as text. Names of files may hold bytes that are not UTF-8: these become U+FFFD.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rddlc::cli {

// Without line breaks.
std::string json_line(const nlohmann::ordered_json& value);
// Indented, with a line break at the end.
std::string json_document(const nlohmann::ordered_json& value);

}  // namespace rddlc::cli
