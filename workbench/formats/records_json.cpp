#include "formats/records_json.hpp"

#include "support/diagnostic.hpp"
#include "support/json_text.hpp"
#include "support/suggestion.hpp"

#include <rddl/interface/describe.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace rddlc::workbench {

namespace {

using nlohmann::json;

std::size_t record_size(const rddl_problem& problem, rddl_role role) {
    if (role == RDDL_STATE) return static_cast<std::size_t>(problem.state_size);
    if (role == RDDL_ACTION) return static_cast<std::size_t>(problem.action_size);
    return static_cast<std::size_t>(problem.observation_size);
}

std::string_view record_name(rddl_role role) {
    if (role == RDDL_STATE) return "state";
    return role == RDDL_ACTION ? "action" : "observation";
}

template <class T>
void store(std::byte* record, std::size_t offset, T value) {
    std::memcpy(record + offset, &value, sizeof value);
}

bool same_bits(const RecordEntry& entry, const std::byte* a, const std::byte* b) {
    return std::memcmp(a + entry.offset, b + entry.offset, scalar_size(entry.fluent->scalar)) == 0;
}

bool equal_values(const RecordEntry& entry, const std::byte* a, const std::byte* b) {
    if (entry.fluent->scalar != RDDL_REAL) return same_bits(entry, a, b);
    return value_at<double>(a, entry) == value_at<double>(b, entry);
}

void write_int(std::string& out, std::int64_t value) {
    char text[24];
    out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

// The values that a fluent takes, for messages.
std::string expected_value(const RecordEntry& entry) {
    if (entry.objects) return fmt::format("an object of type '{}'", entry.objects->name);
    switch (entry.fluent->scalar) {
        case RDDL_BOOL:
            return "true or false";
        case RDDL_INT:
            return "an int";
        case RDDL_REAL:
            return "a number";
    }
    return {};
}

std::string wrong_value(const RecordEntry& entry, const json& value, std::string_view why = {}) {
    constexpr std::size_t longest = 60;
    std::string text = value.is_array()    ? "an array"
                       : value.is_object() ? "a JSON object"
                                           : json_line(value);
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    return fmt::format("'{}' takes {}, not {}{}", entry.name, expected_value(entry), text, why);
}

std::optional<std::int64_t> as_int(const json& value) {
    if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
    return int_in_json(value);
}

std::optional<double> as_real(const json& value) {
    if (value.is_boolean()) return value.get<bool>() ? 1.0 : 0.0;
    return number_in_json(value);
}

std::optional<std::string> read_object(const RecordEntry& entry, const json& value,
                                       std::byte* record) {
    if (!value.is_string()) return wrong_value(entry, value);
    std::string_view name = value.get_ref<const std::string&>();
    if (name.starts_with('@')) name.remove_prefix(1);
    const char* const* const begin = entry.objects->objects;
    const char* const* const end = begin + entry.objects->object_count;
    const char* const* const found = std::find(begin, end, name);
    if (found == end) {
        const auto near = did_you_mean(name, std::vector<std::string>(begin, end));
        return wrong_value(entry, value, ending_with_name(near));
    }
    store<std::int64_t>(record, entry.offset, found - begin);
    return {};
}

// RDDL's casts: bool to int to real, never back.
std::optional<std::string> read_value(const RecordEntry& entry, const json& value,
                                      std::byte* record) {
    if (entry.objects) return read_object(entry, value, record);
    switch (entry.fluent->scalar) {
        case RDDL_BOOL:
            if (!value.is_boolean()) break;
            store<std::uint8_t>(record, entry.offset, value.get<bool>() ? 1 : 0);
            return {};
        case RDDL_INT:
            if (const auto number = as_int(value)) {
                store(record, entry.offset, *number);
                return {};
            }
            break;
        case RDDL_REAL:
            if (const auto number = as_real(value)) {
                store(record, entry.offset, *number);
                return {};
            }
            break;
    }
    return wrong_value(entry, value);
}

}  // namespace

std::size_t scalar_size(rddl_scalar scalar) {
    return scalar == RDDL_BOOL ? 1 : 8;
}

void write_value(std::string& out, const RecordEntry& entry, const std::byte* record) {
    switch (entry.fluent->scalar) {
        case RDDL_BOOL:
            out += value_at<std::uint8_t>(record, entry) ? "true" : "false";
            return;
        case RDDL_REAL:
            write_real(out, value_at<double>(record, entry));
            return;
        case RDDL_INT:
            break;
    }
    const auto value = value_at<std::int64_t>(record, entry);
    if (entry.objects && value >= 0 && value < entry.objects->object_count)
        write_string(out, entry.objects->objects[value]);
    else
        write_int(out, value);
}

std::string grounded_name(const rddl_problem& problem, const rddl_fluent& fluent,
                          std::int64_t grounding) {
    const auto write = [&](std::span<char> buffer) {
        rddl::FixedText text(buffer);
        rddl::write_grounding_name(text, problem, fluent, grounding);
        return text.wanted();
    };
    std::string name(write({}), '\0');
    write({name.data(), name.size() + 1});  // the text ends with a zero, as the string does
    return name;
}

RecordLayout::RecordLayout(const rddl_problem& problem, rddl_role role)
    : what_(record_name(role)), size_(record_size(problem, role)) {
    const bool state_observed = role == RDDL_OBSERVATION && !problem.partially_observed;
    const rddl_role stored_role = state_observed ? RDDL_STATE : role;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role != stored_role) continue;
        const rddl_type* objects =
            fluent.range_type >= 0 ? &problem.types[fluent.range_type] : nullptr;
        for (std::int64_t g = 0; g < fluent.count; ++g) {
            const auto offset = static_cast<std::size_t>(fluent.offset) +
                                static_cast<std::size_t>(g) * scalar_size(fluent.scalar);
            entries_.push_back({grounded_name(problem, fluent, g), &fluent, g, offset, objects});
        }
    }
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        write_string(keys_.emplace_back(), entries_[i].name);
        keys_.back() += ':';
        entry_named_.emplace(entries_[i].name, i);
    }
}

void RecordLayout::write(std::string& out, const std::byte* record) const {
    out += '{';
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (i > 0) out += ',';
        out += keys_[i];
        write_value(out, entries_[i], record);
    }
    out += '}';
}

void RecordLayout::write_changes(std::string& out, const std::byte* record,
                                 const std::byte* defaults) const {
    out += '{';
    bool first = true;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (same_bits(entries_[i], record, defaults)) continue;
        if (!first) out += ',';
        first = false;
        out += keys_[i];
        write_value(out, entries_[i], record);
    }
    out += '}';
}

std::optional<std::string> RecordLayout::read(const json& values, std::byte* record) const {
    if (!values.is_object()) return fmt::format("'{}' is not a JSON object", what_);
    for (const auto& [name, value] : values.items()) {
        const auto found = entry_named_.find(name);
        if (found == entry_named_.end()) return unknown_name(name);
        if (auto message = read_value(entries_[found->second], value, record)) return message;
    }
    return {};
}

std::int64_t RecordLayout::count_changes(const std::byte* record, const std::byte* defaults) const {
    return std::count_if(entries_.begin(), entries_.end(), [&](const RecordEntry& entry) {
        return !equal_values(entry, record, defaults);
    });
}

std::string RecordLayout::unknown_name(const std::string& name) const {
    for (const RecordEntry& entry : entries_) {
        if (name == entry.fluent->name)
            return fmt::format("'{}' has parameters: name one of its values, such as '{}'", name,
                               entry.name);
    }
    constexpr std::size_t few = 2000;  // beyond, looking for a near name takes too long
    std::vector<std::string> candidates;
    for (const RecordEntry& entry : entries_)
        if (candidates.size() < few) candidates.push_back(entry.name);
    const auto near = did_you_mean(name, candidates);
    return fmt::format("no {}-fluent is called '{}'{}", what_, name, ending_with_name(near));
}

void write_real(std::string& out, double value) {
    if (!std::isfinite(value)) {
        out += std::isnan(value) ? "\"nan\"" : value > 0 ? "\"inf\"" : "\"-inf\"";
        return;
    }
    char digits[32];
    const std::string_view text(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    out += text;
    const bool looks_like_int = text.find_first_of(".e") == std::string_view::npos;
    if (looks_like_int) out += ".0";
}

nlohmann::ordered_json json_number(double value) {
    if (std::isfinite(value)) return value;
    std::string text;
    write_real(text, value);
    return parse_ordered_json(text);
}

std::optional<double> number_in_json(const json& value) {
    if (value.is_number()) return value.get<double>();
    if (value == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (value == "inf") return std::numeric_limits<double>::infinity();
    if (value == "-inf") return -std::numeric_limits<double>::infinity();
    return {};
}

std::optional<std::int64_t> int_in_json(const json& value) {
    if (!value.is_number_integer()) return {};
    constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max();
    if (value.is_number_unsigned() && value.get<std::uint64_t>() > most) return {};
    return value.get<std::int64_t>();
}

void write_string(std::string& out, std::string_view text) {
    const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
        return c >= ' ' && c <= '~' && c != '"' && c != '\\';
    });
    if (plain)
        ((out += '"') += text) += '"';
    else  // bytes that are not UTF-8 become U+FFFD
        out += json_line(std::string(text));
}

}  // namespace rddlc::workbench
