#include "support/json_text.hpp"

#include "support/utf8.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <unordered_set>
#include <vector>

namespace rddlc {

namespace {

constexpr int most_brackets = 256;  // within each other

// The message without nlohmann's "[json.exception...] ".
std::string message_of(const nlohmann::json::exception& error) {
    const std::string_view what = error.what();
    const std::size_t end = what.find("] ");
    return std::string(end == std::string_view::npos ? what : what.substr(end + 2));
}

template <class Json>
Json parse_strictly(std::string_view text) {
    std::vector<std::unordered_set<std::string>> members;  // of the objects around, outermost first
    using Event = typename Json::parse_event_t;
    const auto see = [&](int depth, Event event, Json& parsed) {
        if (depth > most_brackets)
            throw RefusedJson(
                fmt::format("more than {} brackets lie within each other", most_brackets));
        if (event == Event::object_start) members.emplace_back();
        if (event == Event::object_end) members.pop_back();
        if (event == Event::key &&
            !members.back().insert(parsed.template get_ref<const std::string&>()).second)
            throw RefusedJson(fmt::format("the member '{}' is given twice",
                                          parsed.template get_ref<const std::string&>()));
        return true;
    };
    try {
        return Json::parse(text, see);
    } catch (const nlohmann::json::parse_error& error) {
        throw RefusedJson(message_of(error),
                          std::min(error.byte > 0 ? error.byte - 1 : 0, text.size()));
    } catch (const nlohmann::json::exception& error) {
        throw RefusedJson(message_of(error));  // a number that is too large
    }
}

// `json` is ASCII but within texts.
std::string with_visible_characters(std::string_view json) {
    std::string out;
    out.reserve(json.size());
    while (!json.empty()) {
        if (json.front() >= ' ' && json.front() <= '~') {
            out += json.front();
            json.remove_prefix(1);
            continue;
        }
        const Character character = first_character(json);
        json.remove_prefix(character.bytes.size());
        if (character.is_visible || character.bytes == "\n") {
            out += character.bytes;
            continue;
        }
        const auto code = static_cast<std::uint32_t>(character.code_point);
        if (code < 0x10000)
            out += fmt::format("\\u{:04x}", code);
        else
            out +=
                fmt::format("\\u{:04x}\\u{:04x}", 0xD7C0 + (code >> 10), 0xDC00 + (code & 0x3FF));
    }
    return out;
}

std::string text_of(const nlohmann::ordered_json& value, int indent) {
    return with_visible_characters(
        value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace

nlohmann::json parse_json(std::string_view text) {
    return parse_strictly<nlohmann::json>(text);
}

nlohmann::ordered_json parse_ordered_json(std::string_view text) {
    return parse_strictly<nlohmann::ordered_json>(text);
}

nlohmann::json json_if_valid(std::string_view text) {
    return nlohmann::json::parse(text, nullptr, false);
}

std::string json_excerpt(const nlohmann::json& value) {
    constexpr std::size_t most = 40;
    if (value.is_structured()) return value.is_array() ? "an array" : "an object";
    const std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    return text.size() > most ? text.substr(0, most) + "..." : text;
}

std::string json_line(const nlohmann::ordered_json& value) {
    return text_of(value, -1);
}

std::string json_document(const nlohmann::ordered_json& value) {
    return text_of(value, 2) + '\n';
}

}  // namespace rddlc
