#include "fitting/transitions.hpp"

#include "formats/trace.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

namespace rddlc::workbench {

namespace {

// A number of a record as a double; nothing for bools and objects.
std::optional<double> number_of_entry(const RecordEntry& entry,
                                      const std::vector<std::byte>& record) {
    if (entry.objects || entry.fluent->scalar == RDDL_BOOL) return {};
    if (entry.fluent->scalar == RDDL_REAL) return value_at<double>(record.data(), entry);
    return static_cast<double>(value_at<std::int64_t>(record.data(), entry));
}

}  // namespace

TransitionReader::TransitionReader(const rddl_simulator& simulator, std::string name)
    : problem_(*simulator.problem),
      name_(std::move(name)),
      states_(problem_, RDDL_STATE),
      actions_(problem_, RDDL_ACTION) {}

void TransitionReader::fail(const std::string& message, const std::string& hint) const {
    throw Failure(fmt::format("'{}', line {}: {}", name_, line_, message), hint);
}

std::optional<Transition> TransitionReader::read(std::string_view line) {
    ++line_;
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) return {};
    nlohmann::json object;
    try {
        object = object_of_trace_line(line);
    } catch (const Failure& refused) {
        fail(refused.what());
    }
    if (object.contains("rddl_trace")) {
        if (const auto complaint = complaint_about_header(object, problem_)) fail(*complaint);
        return {};
    }
    if (object.contains("fault")) {
        ++faulted_;
        return {};
    }
    for (const char* const member : {"state", "action", "next_state"})
        if (!object.contains(member) || !object[member].is_object())
            fail(fmt::format("the line has no '{}'", member),
                 "a fit takes each line by itself: state, action and next_state, as 'rddl run "
                 "--trace' writes them");
    require_all(states_, object, "state", false);
    require_all(states_, object, "next_state", true);
    const auto* const defaults = static_cast<const std::byte*>(problem_.default_action);
    Transition found;
    found.state = record_of(states_, object, "state", std::vector<std::byte>(states_.size()));
    found.action = record_of(actions_, object, "action", {defaults, defaults + actions_.size()});
    found.next = record_of(states_, object, "next_state", found.state);
    require_bounds(found.action);
    found.reward = reward_of(object);
    return found;
}

std::vector<std::byte> TransitionReader::record_of(const RecordLayout& layout,
                                                   const nlohmann::json& line, const char* member,
                                                   std::vector<std::byte> record) const {
    if (const auto complaint = layout.read(line.at(member), record.data()))
        fail(fmt::format("'{}': {}", member, *complaint));
    require_finite(layout, record, member);
    return record;
}

void TransitionReader::require_all(const RecordLayout& layout, const nlohmann::json& line,
                                   const char* member, bool only_reals) const {
    for (const RecordEntry& entry : layout.entries())
        if (!line.at(member).contains(entry.name) &&
            (!only_reals || entry.fluent->scalar == RDDL_REAL))
            fail(fmt::format("'{}' has no value of '{}'", member, entry.name));
}

void TransitionReader::require_finite(const RecordLayout& layout,
                                      const std::vector<std::byte>& record,
                                      const char* member) const {
    for (const RecordEntry& entry : layout.entries())
        if (const auto value = number_of_entry(entry, record); value && !std::isfinite(*value))
            fail(fmt::format("'{}': '{}' is {}, and a fit takes finite values only", member,
                             entry.name, *value));
}

// A default is accepted everywhere, as steps accept it.
void TransitionReader::require_bounds(const std::vector<std::byte>& action) const {
    const auto* const defaults = static_cast<const std::byte*>(problem_.default_action);
    const std::vector<std::byte> usual(defaults, defaults + actions_.size());
    for (const RecordEntry& entry : actions_.entries()) {
        const auto value = number_of_entry(entry, action);
        if (!value || !entry.fluent->lower || value == number_of_entry(entry, usual)) continue;
        const double lower = entry.fluent->lower[entry.grounding];
        const double upper = entry.fluent->upper[entry.grounding];
        if (*value < lower || *value > upper)
            fail(fmt::format("'action': '{}' is {}, outside of its bounds {} and {}", entry.name,
                             *value, lower, upper));
    }
}

std::optional<double> TransitionReader::reward_of(const nlohmann::json& line) const {
    const auto found = line.find("reward");
    if (found == line.end() || found->is_null()) return {};
    const auto reward = number_in_json(*found);
    if (!reward) fail(fmt::format("'reward' is a number, not {}", found->dump()));
    if (!std::isfinite(*reward))
        fail(fmt::format("'reward' is {}, and a fit takes finite values only", *reward));
    return reward;
}

}  // namespace rddlc::workbench
