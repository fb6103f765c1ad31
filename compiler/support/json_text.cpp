#include "support/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unordered_set>
#include <vector>

namespace rddlc {

namespace {

std::string text_of(const nlohmann::ordered_json& value, int indent) {
    return value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

nlohmann::json parse_json(std::string_view text, int most_brackets) {
    using nlohmann::json;
    std::vector<std::unordered_set<std::string>> members;  // of the objects around, outermost first
    const auto see = [&](int depth, json::parse_event_t event, json& parsed) {
        if (depth > most_brackets)
            throw RefusedJson(
                fmt::format("more than {} brackets lie within each other", most_brackets));
        if (event == json::parse_event_t::object_start) members.emplace_back();
        if (event == json::parse_event_t::object_end) members.pop_back();
        if (event == json::parse_event_t::key &&
            !members.back().insert(parsed.get_ref<const std::string&>()).second)
            throw RefusedJson(fmt::format("the member '{}' is given twice",
                                          parsed.get_ref<const std::string&>()));
        return true;
    };
    return json::parse(text, see);
}

nlohmann::ordered_json parse_ordered_json(std::string_view text) {
    return nlohmann::ordered_json::parse(text);
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
