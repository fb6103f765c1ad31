// JSON as text, read and written. Programs that call these do not make nlohmann's parser and writer
// anew in each of their files, which takes seconds a file to compile.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rddlc {

// JSON that others may take: an object names a member twice, and nobody knows which one is meant,
// or too many brackets lie within each other. what() is a sentence.
struct RefusedJson : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Fails with a nlohmann::json::exception or a RefusedJson. `most_brackets`: that may lie within
// each other, for those who walk through what was read by recursion and would run out of stack.
nlohmann::json parse_json(std::string_view text,
                          int most_brackets = std::numeric_limits<int>::max());
// Keeps the order of members. Fails with a nlohmann::json::exception.
nlohmann::ordered_json parse_ordered_json(std::string_view text);
// What other programs wrote: `discarded` (nlohmann's word) where it is no JSON.
nlohmann::json json_if_valid(std::string_view text);

// The beginning of a value that somebody else wrote, for messages: ASCII without control
// characters.
std::string json_excerpt(const nlohmann::json& value);

// Names of files may hold bytes that are not UTF-8: these become U+FFFD.
// Without line breaks.
std::string json_line(const nlohmann::ordered_json& value);
// Indented, with a line break at the end.
std::string json_document(const nlohmann::ordered_json& value);

}  // namespace rddlc
