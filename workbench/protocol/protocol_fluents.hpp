// Values of fluents as elements of messages, and back.
#pragma once

#include "formats/records_json.hpp"
#include "protocol/xml.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace rddlc::workbench {

// A real as Java prints it: "1.0", "0.001", "1.0E-5", "NaN".
std::string java_real(double value);

// The elements <observed-fluent> of an observation record, or <action> of an action record.
class ProtocolFluents {
  public:
    // `problem` must outlive it. The role is RDDL_ACTION or RDDL_OBSERVATION.
    ProtocolFluents(const rddl_problem& problem, rddl_role role);

    std::size_t size() const { return layout_.size(); }  // bytes of a record
    std::size_t count() const { return layout_.entries().size(); }
    // The longest element that names one of them.
    std::size_t longest_element() const;

    // Appends an element for each value.
    void write(std::string& out, const std::byte* record) const;
    // The same for those that differ from `defaults`.
    void write_changes(std::string& out, const std::byte* record, const std::byte* defaults) const;
    // Sets the value that the element names, and returns its place among all. Throws a BadMessage.
    std::size_t read(const Element& element, std::byte* record) const;
    // How many values differ from those of `defaults`.
    std::int64_t count_changes(const std::byte* record, const std::byte* defaults) const {
        return layout_.count_changes(record, defaults);
    }
    const std::string& name(std::size_t place) const { return layout_.entries()[place].name; }

  private:
    void write_one(std::string& out, std::size_t place, const std::byte* record) const;

    std::string element_, kind_;  // "action", "action"; "observed-fluent", "fluent"
    RecordLayout layout_;
    std::vector<std::string> heads_;                   // names and arguments as elements
    std::unordered_map<std::string, std::size_t> at_;  // by "name(object,object)"
};

}  // namespace rddlc::workbench
