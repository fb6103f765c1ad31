#include "protocol/protocol_fluents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

namespace rddlc::workbench {

namespace {

// Programs write '@' before members of enumerated types, and some '$' before objects.
std::string_view bare(std::string_view name) {
    return name.starts_with('@') || name.starts_with('$') ? name.substr(1) : name;
}

std::string object_text(const rddl_type& type, std::int64_t object) {
    return fmt::format("{}{}", type.enumerated ? "@" : "", bare(type.objects[object]));
}

// The objects of the grounding-th tuple.
std::vector<std::string> arguments_of(const rddl_problem& problem, const rddl_fluent& fluent,
                                      std::int64_t grounding) {
    std::vector<std::string> arguments(static_cast<std::size_t>(fluent.rank));
    for (std::int32_t k = fluent.rank; k-- > 0;) {
        const rddl_type& type = *rddl_type_at(&problem, fluent.parameter_types[k]);
        arguments[static_cast<std::size_t>(k)] = object_text(type, grounding % type.object_count);
        grounding /= type.object_count;
    }
    return arguments;
}

template <class Value>
void set_value(std::byte* record, std::size_t offset, Value value) {
    std::memcpy(record + offset, &value, sizeof value);
}

std::string text_of(const RecordEntry& entry, const std::byte* record) {
    switch (entry.fluent->scalar) {
        case RDDL_BOOL:
            return value_at<std::uint8_t>(record, entry) ? "true" : "false";
        case RDDL_INT: {
            const auto value = value_at<std::int64_t>(record, entry);
            return entry.objects ? object_text(*entry.objects, value) : std::to_string(value);
        }
        case RDDL_REAL:
            break;
    }
    return java_real(value_at<double>(record, entry));
}

[[noreturn]] void refuse_value(const RecordEntry& entry, const std::string& text,
                               const char* wanted) {
    throw BadMessage(
        fmt::format("the value of {} is '{}', which is not {}", entry.name, text, wanted));
}

std::int64_t object_named(const RecordEntry& entry, const std::string& text) {
    const rddl_type& type = *entry.objects;
    for (std::int64_t k = 0; k < type.object_count; ++k)
        if (bare(type.objects[k]) == bare(text)) return k;
    refuse_value(entry, text, fmt::format("an object of type {}", type.name).c_str());
}

template <class Number>
bool reads(const std::string& text, Number& number) {
    const char* const end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, number);
    return result.ec == std::errc() && result.ptr == end;
}

double real_in(const RecordEntry& entry, const std::string& text) {
    if (text == "NaN") return std::nan("");
    if (text == "Infinity") return HUGE_VAL;
    if (text == "-Infinity") return -HUGE_VAL;
    double value = 0;
    if (!reads(text, value)) refuse_value(entry, text, "a real");
    return value;
}

void read_value(const RecordEntry& entry, const std::string& text, std::byte* record) {
    if (entry.objects) {
        set_value(record, entry.offset, object_named(entry, text));
    } else if (entry.fluent->scalar == RDDL_BOOL) {
        if (text != "true" && text != "false") refuse_value(entry, text, "true or false");
        set_value(record, entry.offset, static_cast<std::uint8_t>(text == "true"));
    } else if (entry.fluent->scalar == RDDL_INT) {
        std::int64_t value = 0;
        if (!reads(text, value)) refuse_value(entry, text, "an int");
        set_value(record, entry.offset, value);
    } else {
        const double value = real_in(entry, text);
        // The simulator takes no others in actions.
        if (entry.fluent->role == RDDL_ACTION && !std::isfinite(value))
            refuse_value(entry, text, "finite");
        set_value(record, entry.offset, value);
    }
}

}  // namespace

std::string java_real(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
    const double size = std::abs(value);
    if (size == 0 || (size >= 1e-3 && size < 1e7)) {
        std::string text = fmt::format("{}", value);
        if (text.find('e') != std::string::npos) text = fmt::format("{:f}", value);
        return text.find('.') == std::string::npos ? text + ".0" : text;
    }
    // The shortest digits: "1e-05", "1.2345e+20".
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                   std::chars_format::scientific)
                         .ptr;
    const std::string_view text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
    const std::size_t e = text.find('e');
    std::string digits(text.substr(0, e));
    if (digits.find('.') == std::string::npos) digits += ".0";
    int exponent = 0;
    const std::string_view power = text.substr(text[e + 1] == '+' ? e + 2 : e + 1);
    std::from_chars(power.data(), power.data() + power.size(), exponent);
    return fmt::format("{}E{}", digits, exponent);
}

ProtocolFluents::ProtocolFluents(const rddl_problem& problem, rddl_role role)
    : element_(role == RDDL_ACTION ? "action" : "observed-fluent"),
      kind_(role == RDDL_ACTION ? "action" : "fluent"),
      layout_(problem, role) {
    for (const RecordEntry& entry : layout_.entries()) {
        std::string head = tagged(kind_ + "-name", entry.fluent->name);
        std::string key = entry.fluent->name;
        for (const std::string& argument : arguments_of(problem, *entry.fluent, entry.grounding)) {
            head += tagged(kind_ + "-arg", argument);
            key += fmt::format(" {}", bare(argument));
        }
        at_.emplace(std::move(key), heads_.size());
        heads_.push_back(std::move(head));
    }
}

std::size_t ProtocolFluents::longest_element() const {
    std::size_t longest = 0;
    for (const std::string& head : heads_) longest = std::max(longest, head.size());
    // The value may be a name of any length, which is no longer than that of some object.
    return 2 * longest + 256;
}

void ProtocolFluents::write_one(std::string& out, std::size_t place,
                                const std::byte* record) const {
    out +=
        fmt::format("<{}>{}{}</{}>", element_, heads_[place],
                    tagged(kind_ + "-value", text_of(layout_.entries()[place], record)), element_);
}

void ProtocolFluents::write(std::string& out, const std::byte* record) const {
    for (std::size_t k = 0; k < heads_.size(); ++k) write_one(out, k, record);
}

void ProtocolFluents::write_changes(std::string& out, const std::byte* record,
                                    const std::byte* defaults) const {
    for (std::size_t k = 0; k < heads_.size(); ++k) {
        const RecordEntry& entry = layout_.entries()[k];
        if (std::memcmp(record + entry.offset, defaults + entry.offset,
                        scalar_size(entry.fluent->scalar)) != 0)
            write_one(out, k, record);
    }
}

std::size_t ProtocolFluents::read(const Element& element, std::byte* record) const {
    std::string key = element.text_of(kind_ + "-name");
    for (const Element& child : element.children)
        if (child.name == kind_ + "-arg") key += fmt::format(" {}", bare(child.text));
    const auto found = at_.find(key);
    if (found == at_.end())
        throw BadMessage(fmt::format("the problem has no {} '{}'",
                                     element_ == "action" ? "action" : "observed fluent", key));
    read_value(layout_.entries()[found->second], element.text_of(kind_ + "-value"), record);
    return found->second;
}

}  // namespace rddlc::workbench
