// JSON as text, read and written. Callers do not compile nlohmann's parser and writer in each of
// their files, which takes seconds a file.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rddlc {

// The text is not JSON, or is JSON that other programs may misread: an object names a member twice,
// so that it is ambiguous, a number is larger than any double, or so many brackets lie within each
// other that recursion would run out of stack. what() is a sentence.
struct RefusedJson : std::runtime_error {
    explicit RefusedJson(const std::string& message, std::optional<std::size_t> place = {})
        : std::runtime_error(message), byte(place) {}

    std::optional<std::size_t> byte;  // of the text, where it stops to be JSON
};

// JSON of users is read here and nowhere else. Fail with a RefusedJson, and with nothing else.
nlohmann::json parse_json(std::string_view text);
// Keeps the order of members.
nlohmann::ordered_json parse_ordered_json(std::string_view text);
// JSON from other programs: `discarded` (nlohmann's word) if it is not JSON.
nlohmann::json json_if_valid(std::string_view text);

// The beginning of a value from another program, for messages: ASCII without control characters.
std::string json_excerpt(const nlohmann::json& value);

// Names of files may hold bytes that are not UTF-8: these become U+FFFD. Invisible characters, such
// as control characters, are written as escapes, so that they do not drive a terminal. The line has
// no line breaks.
std::string json_line(const nlohmann::ordered_json& value);
// Indented, with a line break at the end.
std::string json_document(const nlohmann::ordered_json& value);

}  // namespace rddlc
