// JSON as text, read and written. Programs that call these do not make nlohmann's parser and writer
// anew in each of their files, which takes seconds a file to compile.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rddlc {

// No JSON, or JSON that others may take: an object names a member twice, and nobody knows which one
// is meant, a number is larger than any double, or so many brackets lie within each other that who
// walks through them by recursion would run out of stack. what() is a sentence.
struct RefusedJson : std::runtime_error {
    explicit RefusedJson(const std::string& message, std::optional<std::size_t> place = {})
        : std::runtime_error(message), byte(place) {}

    std::optional<std::size_t> byte;  // of the text, where it stops to be JSON
};

// JSON of users is read here and nowhere else. Fail with a RefusedJson, and with nothing else.
nlohmann::json parse_json(std::string_view text);
// Keeps the order of members.
nlohmann::ordered_json parse_ordered_json(std::string_view text);
// What other programs wrote: `discarded` (nlohmann's word) where it is no JSON.
nlohmann::json json_if_valid(std::string_view text);

// The beginning of a value that somebody else wrote, for messages: ASCII without control
// characters.
std::string json_excerpt(const nlohmann::json& value);

// Names of files may hold bytes that are not UTF-8: these become U+FFFD. What is not visible, such
// as a control character, is written as an escape, so that it does not drive a terminal.
// Without line breaks.
std::string json_line(const nlohmann::ordered_json& value);
// Indented, with a line break at the end.
std::string json_document(const nlohmann::ordered_json& value);

}  // namespace rddlc
