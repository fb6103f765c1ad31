#include "formats/trace_steps.hpp"

#include "formats/records_json.hpp"
#include "formats/trace.hpp"
#include "support/failure.hpp"
#include "support/utf8.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace rddlc::workbench {

namespace {

// The description of the episode in the header.
std::string course_in(const nlohmann::json& header) {
    const auto policy = header.find("policy"), seed = header.find("seed");
    if (policy == header.end() || !policy->is_string()) return {};
    const std::string text = "policy " + printable_line(policy->get<std::string>());
    return seed != header.end() && seed->is_number_integer() ? text + ", seed " + seed->dump()
                                                             : text;
}

bool is_set(const nlohmann::json& line, const char* member) {
    const auto found = line.find(member);
    return found != line.end() && found->is_boolean() && found->get<bool>();
}

// A missing reward is 0, and one that is not a number is nan.
double reward_in(const nlohmann::json& line) {
    const auto found = line.find("reward");
    if (found == line.end()) return 0;
    return number_in_json(*found).value_or(std::numeric_limits<double>::quiet_NaN());
}

// The causes of the end in words: "terminated", "horizon, invariant".
std::string end_in(const nlohmann::json& line) {
    std::string text;
    if (const auto causes = line.find("causes"); causes != line.end() && causes->is_array())
        for (const auto& cause : *causes)
            if (cause.is_string()) text += (text.empty() ? "" : ", ") + cause.get<std::string>();
    if (!text.empty()) return printable_line(text);
    return is_set(line, "terminated") ? "terminated" : is_set(line, "truncated") ? "truncated" : "";
}

}  // namespace

TraceSteps::TraceSteps(const rddl_simulator& simulator, std::optional<std::int64_t> episode,
                       std::string name)
    : simulator_(simulator),
      problem_(*simulator.problem),
      episode_(episode),
      name_(std::move(name)),
      state_layout_(problem_, RDDL_STATE),
      action_layout_(problem_, RDDL_ACTION),
      horizon_(problem_.horizon),
      state_(state_layout_.size()) {
    simulator.initial_state(&simulator, state_.data());
}

void TraceSteps::fail(const std::string& message) const {
    throw Failure(fmt::format("'{}', line {}: {}", name_, line_, message));
}

std::int64_t TraceSteps::count_in(const nlohmann::json& line, const char* member,
                                  std::int64_t otherwise) const {
    const auto found = line.find(member);
    if (found == line.end() || found->is_null()) return otherwise;
    const auto count = int_in_json(*found);
    if (!count || *count < 0)
        fail(fmt::format("'{}' is an int from 0 on, not {}", member, found->dump()));
    // Axes and pages hold it as a double.
    constexpr std::int64_t largest = std::int64_t{1} << 53;
    if (*count > largest) fail(fmt::format("'{}' is at most {}, not {}", member, largest, *count));
    return *count;
}

std::optional<TraceStep> TraceSteps::read(std::string_view line) {
    ++line_;
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) return std::nullopt;
    nlohmann::json object;
    try {
        object = object_of_trace_line(line);
    } catch (const Failure& refused) {
        fail(refused.what());
    }
    if (!object.contains("rddl_trace")) return read_object(object);
    if (const auto complaint = complaint_about_header(object, problem_)) fail(*complaint);
    horizon_ = count_in(object, "horizon", horizon_);
    course_ = course_in(object);
    return std::nullopt;
}

void TraceSteps::read_record(const RecordLayout& layout, const nlohmann::json& line,
                             const char* member, std::vector<std::byte>& record) const {
    const auto found = line.find(member);
    if (found == line.end() || found->is_null()) return;
    if (!found->is_object()) fail(fmt::format("'{}' is not a JSON object", member));
    if (const auto complaint = layout.read(*found, record.data())) fail(*complaint);
}

std::optional<TraceStep> TraceSteps::read_object(const nlohmann::json& line) {
    const std::int64_t episode = count_in(line, "episode", 0);
    if (!episode_) episode_ = episode;
    if (episode != *episode_) {
        is_over_ = next_number_ > 0;
        return std::nullopt;
    }
    if (!line.contains("state") && !line.contains("next_state") && !line.contains("action"))
        fail("the line is not a step: it has no state and no action");
    TraceStep step;
    step.number = count_in(line, "step", next_number_);
    if (step.number < next_number_)
        fail(fmt::format("step {} of episode {} comes after step {}", step.number, episode,
                         next_number_ - 1));
    next_number_ = step.number + 1;
    read_record(state_layout_, line, "state", state_);
    step.state = state_;
    if (line.contains("action")) {
        step.action.assign(
            static_cast<const std::byte*>(problem_.default_action),
            static_cast<const std::byte*>(problem_.default_action) + problem_.action_size);
        read_record(action_layout_, line, "action", step.action);
    }
    step.reward = reward_in(line);
    step.total = total_;
    total_ += step.reward;
    end_ = end_in(line);
    if (step.action.empty()) step.end = end_;
    has_next_state_ = line.contains("next_state");
    read_record(state_layout_, line, "next_state", state_);
    return step;
}

void TraceSteps::begin_next() {
    --line_;
    simulator_.initial_state(&simulator_, state_.data());
    episode_.reset();
    has_next_state_ = is_over_ = false;
    next_number_ = 0;
    total_ = 0;
    end_.clear();
}

std::optional<TraceStep> TraceSteps::last() {
    if (!has_next_state_) return std::nullopt;
    TraceStep step;
    step.number = next_number_;
    step.state = state_;
    step.total = total_;
    step.end = end_;
    return step;
}

}  // namespace rddlc::workbench
