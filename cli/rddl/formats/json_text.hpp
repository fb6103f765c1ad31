// JSON as text. Names of files may hold bytes that are not UTF-8: these become U+FFFD.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <stdexcept>
#include <string>
#include <string_view>

namespace rddlc::cli {

// An object names a member twice; which one is meant nobody knows. what() is a sentence.
struct RepeatedMember : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Fails with a nlohmann::json::exception or a RepeatedMember.
nlohmann::json parse_json(std::string_view text);

// Without line breaks.
std::string json_line(const nlohmann::ordered_json& value);
// Indented, with a line break at the end.
std::string json_document(const nlohmann::ordered_json& value);

}  // namespace rddlc::cli
