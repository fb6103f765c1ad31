#include "formats/json_text.hpp"

#include <nlohmann/json.hpp>

namespace rddlc::cli {

namespace {

std::string text_of(const nlohmann::ordered_json& value, int indent) {
    return value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

std::string json_line(const nlohmann::ordered_json& value) {
    return text_of(value, -1);
}

std::string json_document(const nlohmann::ordered_json& value) {
    return text_of(value, 2) + '\n';
}

}  // namespace rddlc::cli
