// Records (the raw structs of simulator.h) as JSON objects and back.
//
// A value is a member under its grounded name: `rlevel___t1`, `at___i1__n2`, or just `turn`
// without parameters. Booleans are true and false, ints integers, reals numbers or "nan", "inf",
// "-inf"; objects and enumerated values are strings without '@' (which is accepted when reading).
#pragma once

#include <rddl/simulator.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace rddlc::workbench {

// One value of a record.
struct RecordEntry {
    std::string name;  // grounded
    const rddl_fluent* fluent;
    std::int64_t grounding;    // row-major index over the parameters' objects
    std::size_t offset;        // bytes into the record
    const rddl_type* objects;  // of an object- or enumerated-valued fluent, else NULL
};

// The value of that entry: std::uint8_t for bools, std::int64_t for ints and objects, double.
template <class Value>
Value value_at(const std::byte* record, const RecordEntry& entry) {
    Value value;
    std::memcpy(&value, record + entry.offset, sizeof value);
    return value;
}

class RecordLayout {
  public:
    // The layout of the state, action or observation record. A problem without observation-fluents
    // has the state as its observation. `problem` must outlive the layout.
    RecordLayout(const rddl_problem& problem, rddl_role role);
    RecordLayout(RecordLayout&&) noexcept = default;  // entry_named_ looks into entries_
    RecordLayout& operator=(RecordLayout&&) noexcept = default;

    std::size_t size() const { return size_; }  // bytes
    const std::vector<RecordEntry>& entries() const { return entries_; }

    // Appends {"name":value,...}, in declaration order.
    void write(std::string& out, const std::byte* record) const;
    // The same with the values that differ from those of `defaults` only.
    void write_changes(std::string& out, const std::byte* record, const std::byte* defaults) const;

    // Sets the named values and keeps the others. On a bad name or value returns the error; the
    // record is unusable then.
    std::optional<std::string> read(const nlohmann::json& values, std::byte* record) const;

    // How many values differ from those of `defaults`; nan differs from everything.
    std::int64_t count_changes(const std::byte* record, const std::byte* defaults) const;

  private:
    std::string unknown_name(const std::string& name) const;

    std::string what_;  // "state", ... for messages
    std::size_t size_;
    std::vector<RecordEntry> entries_;
    std::vector<std::string> keys_;  // "name": as JSON, one an entry
    std::unordered_map<std::string_view, std::size_t> entry_named_;
};

// `name`, or `name___object__object` for the grounding-th tuple of objects.
std::string grounded_name(const rddl_problem& problem, const rddl_fluent& fluent,
                          std::int64_t grounding);

// The value of that entry, as JSON.
void write_value(std::string& out, const RecordEntry& entry, const std::byte* record);

// Bytes of one value.
std::size_t scalar_size(rddl_scalar scalar);

// The shortest text that reads back as the same double, with ".0" where it would look like an
// int; "nan", "inf", "-inf" in quotes. As JSON.
void write_real(std::string& out, double value);

// The same as a JSON value: a number, or a string for nan and inf.
nlohmann::ordered_json json_number(double value);
// Back; nothing for any other JSON.
std::optional<double> number_in_json(const nlohmann::json& value);
// An int of 64 bits with a sign; nothing for any other JSON, or a number beyond it.
std::optional<std::int64_t> int_in_json(const nlohmann::json& value);

// A JSON string in quotes, of valid UTF-8 whatever the text.
void write_string(std::string& out, std::string_view text);

}  // namespace rddlc::workbench
