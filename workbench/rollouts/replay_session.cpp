#include "rollouts/replay_session.hpp"

#include "engines/faults.hpp"
#include "formats/records_json.hpp"
#include "formats/trace.hpp"
#include "support/diagnostic.hpp"
#include "support/json_text.hpp"
#include "support/suggestion.hpp"

#include <rddl/random/random.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace rddlc::workbench {

namespace {

using nlohmann::json;

// Identities beyond those of any trace's episodes.
constexpr std::int64_t first_sample = std::int64_t{1} << 40;
// Environments that draw samples together: bounds the memory for large states.
constexpr std::int64_t samples_at_once = 256;
constexpr std::int64_t most_repeats = 10'000'000;

constexpr std::array<std::string_view, 5> understood{"state", "action", "reset", "repeat",
                                                     "episode"};
// Further members in the lines of a trace: outputs, which the input repeats.
constexpr std::array<std::string_view, 8> ignored_members{
    "step", "reward", "next_state", "observation", "terminated", "truncated", "causes", "fault"};

// The error in a line.
struct Refusal {
    std::string message;
};

void refuse_if(const std::optional<std::string>& message) {
    if (message) throw Refusal{*message};
}

void check_members(const json& line) {
    if (!line.is_object()) throw Refusal{"the line is not a JSON object"};
    const auto contains = [](const auto& names, std::string_view name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const auto& [name, value] : line.items()) {
        if (contains(understood, name) || contains(ignored_members, name)) continue;
        const auto near = did_you_mean(name, {understood.begin(), understood.end()});
        throw Refusal{fmt::format("unknown member '{}'{}", name, ending_with_name(near))};
    }
}

std::optional<std::int64_t> read_count(const json& line, const char* name, std::int64_t least,
                                       std::int64_t most) {
    const auto found = line.find(name);
    if (found == line.end()) return std::nullopt;
    const auto value = int_in_json(*found);
    if (value && *value >= least && *value <= most) return value;
    throw Refusal{fmt::format("'{}' is not an int from {} to {}", name, least, most)};
}

std::optional<std::uint64_t> read_seed(const json& line) {
    const auto found = line.find("seed");
    if (found == line.end()) return std::nullopt;
    if (found->is_number_unsigned()) return found->get<std::uint64_t>();
    throw Refusal{fmt::format("'seed' is not an int from 0 to {}",
                              std::numeric_limits<std::uint64_t>::max())};
}

bool read_flag(const json& line, const char* name) {
    const auto found = line.find(name);
    if (found == line.end()) return false;
    if (!found->is_boolean()) throw Refusal{fmt::format("'{}' is not true or false", name)};
    return found->get<bool>();
}

std::string with_warning(std::string answer, const std::string& warning) {
    if (warning.empty()) return answer;
    answer.resize(answer.size() - 2);  // the brace and the line break
    answer += R"(,"warning":)";
    write_string(answer, warning);
    return answer + "}\n";
}

}  // namespace

ReplaySession::ReplaySession(const rddl_simulator& simulator, ReplayOptions options)
    : simulator_(simulator),
      problem_(*simulator.problem),
      options_(options),
      seed_(options.seed.value_or(0)),
      horizon_(options.horizon.value_or(problem_.horizon)),
      state_layout_(problem_, RDDL_STATE),
      action_layout_(problem_, RDDL_ACTION),
      observation_layout_(problem_, RDDL_OBSERVATION),
      next_sample_(first_sample),
      batch_(create(0, 1, horizon_)),
      initial_state_(state()) {}

std::string ReplaySession::answer(std::string_view line) {
    ++line_;
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) return {};
    const bool is_first = !std::exchange(has_begun_, true);
    std::string message;
    try {
        return answer_object(parse_json(line), is_first);
    } catch (const RefusedJson& error) {
        message = error.what();
    } catch (const ForeignTrace&) {
        throw;
    } catch (const Refusal& refusal) {
        message = refusal.message;
    } catch (const Failure& failure) {  // such as a lack of memory: the next line may need less
        message = failure.what();
    }
    return error_line(message);
}

std::string ReplaySession::refuse(std::string_view why) {
    ++line_;
    has_begun_ = true;
    return error_line(why);
}

std::string ReplaySession::error_line(std::string_view message) const {
    std::string out = R"({"error":)";
    write_string(out, message);
    return out + fmt::format(",\"line\":{}}}\n", line_);
}

std::string ReplaySession::answer_object(const json& line, bool is_first) {
    if (line.is_object() && line.contains("rddl_trace")) {
        if (!is_first) throw Refusal{"a trace's header stands before all other lines"};
        read_header(line);
        return {};
    }
    Request request = read_request(line);
    prepare(request);
    if (!request.steps) return describe_start();
    require_running();
    const std::string warning = check_preconditions(request.action);
    return with_warning(
        request.samples ? sample(request.action, *request.samples) : step(request.action), warning);
}

// ---------------------------------------------------------------------------- reading a line

// The trace's own seed and horizon, so that replaying it gives the same steps again.
void ReplaySession::read_header(const json& header) {
    if (const auto complaint = complaint_about_header(header, problem_))
        throw ForeignTrace(fmt::format("line {} of the input: {}", line_, *complaint));
    if (options_.see_header) options_.see_header(header);
    const auto seed = read_seed(header);
    const auto horizon = read_count(header, "horizon", 0, std::numeric_limits<std::int64_t>::max());
    if (!options_.seed && seed) seed_ = *seed;
    if (!options_.horizon && horizon) horizon_ = *horizon;
    batch_ = create(environment_, 1, horizon_);
}

ReplaySession::Request ReplaySession::read_request(const json& line) const {
    check_members(line);
    Request request;
    request.environment = read_count(line, "episode", 0, first_sample - 1);
    if (request.environment == environment_) request.environment.reset();
    request.reset = read_flag(line, "reset");
    request.samples = read_count(line, "repeat", 1, most_repeats);
    request.steps = !request.reset || line.contains("action") || request.samples;
    if (const auto values = line.find("state"); values != line.end())
        request.state = read_state(*values, request.environment || request.reset);
    const auto values = line.find("action");
    request.action = read_action(values == line.end() ? json::object() : *values);
    return request;
}

// `fresh`: a part of a state is set in the initial state, else in the current one.
ReplaySession::Record ReplaySession::read_state(const json& values, bool fresh) const {
    Record record = fresh ? initial_state_ : state();
    refuse_if(state_layout_.read(values, record.data()));
    return record;
}

ReplaySession::Record ReplaySession::read_action(const json& values) const {
    const auto* const defaults = static_cast<const std::byte*>(problem_.default_action);
    Record record(defaults, defaults + problem_.action_size);
    refuse_if(action_layout_.read(values, record.data()));
    const std::int64_t changes = action_layout_.count_changes(record.data(), defaults);
    if (problem_.max_nondef_actions >= 0 && changes > problem_.max_nondef_actions)
        throw Refusal{fmt::format("{} action values differ from their default; at most {} may",
                                  changes, problem_.max_nondef_actions)};
    return record;
}

// ------------------------------------------------------------------------------- acting on it

solvers::BatchHandle ReplaySession::create(std::int64_t first, std::int64_t count,
                                           std::int64_t horizon) const {
    rddl_batch_options options{};
    options.environment_count = count;
    options.first_environment = first;
    options.seed = seed_;
    options.thread_count = 1;
    options.horizon = solvers::horizon_option(horizon);
    return solvers::create_batch(simulator_, options);
}

void ReplaySession::prepare(const Request& request) {
    if (request.environment) {
        environment_ = *request.environment;
        batch_ = create(environment_, 1, horizon_);
    }
    if (request.reset) simulator_.reset(batch_.get(), nullptr, nullptr);
    if (request.state &&
        simulator_.set_state(batch_.get(), 0, 1, request.state->data(), nullptr) != RDDL_OK)
        throw Refusal{"the simulator refuses the state"};
}

void ReplaySession::require_running() const {
    const std::uint8_t why = causes();
    if (why == RDDL_RUNNING) return;
    const char* const reason = why & RDDL_FAULTED               ? "a step faulted"
                               : why & RDDL_TERMINATED          ? "a termination condition holds"
                               : why & RDDL_TRUNCATED_INVARIANT ? "a state invariant is violated"
                                                                : "the horizon is reached";
    throw Refusal{fmt::format("the episode is over: {}", reason)};
}

std::string ReplaySession::check_preconditions(Record& action) const {
    if (options_.preconditions == Preconditions::Ignore) return {};
    std::int32_t violated = -1;
    simulator_.violated_preconditions(batch_.get(), action.data(), &violated);
    if (violated < 0) return {};
    const std::string message = explain(violated, action);
    if (options_.preconditions == Preconditions::Error) throw Refusal{message};
    if (options_.preconditions == Preconditions::Noop)
        std::copy_n(static_cast<const std::byte*>(problem_.default_action), action.size(),
                    action.begin());
    return message;
}

std::string ReplaySession::explain(std::int32_t precondition, const Record& action) const {
    if (!options_.explain) {
        const rddl_condition& condition = problem_.preconditions[precondition];
        return fmt::format("{}: precondition violated: {}", source_text(condition.source),
                           condition.text);
    }
    std::int64_t steps = 0, episodes = 0;
    simulator_.get_progress(batch_.get(), 0, 1, &steps, &episodes);
    Violation violation{state(), action};
    violation.context.key = rddl::stream_key(seed_, static_cast<std::uint64_t>(environment_),
                                             static_cast<std::uint64_t>(episodes));
    violation.context.step = static_cast<std::uint32_t>(steps + 1);
    return options_.explain(violation);
}

std::string ReplaySession::describe_start() const {
    std::string out;
    write_outcome(out, *batch_, 0, 0.0, causes());
    return out + '\n';
}

std::string ReplaySession::step(const Record& action) {
    double reward = 0;
    std::uint8_t ended_by = RDDL_RUNNING;
    rddl_transition out{};
    out.rewards = &reward;
    out.causes = &ended_by;
    simulator_.step(batch_.get(), action.data(), &out);
    std::string line;
    write_outcome(line, *batch_, 0, reward, ended_by);
    return line + '\n';
}

// The same step again and again from here, each time in an environment of its own.
std::string ReplaySession::sample(const Record& action, std::int64_t count) {
    std::string out = R"({"samples":[)";
    for (std::int64_t done = 0; done < count; done += samples_at_once) {
        if (done > 0) out += ',';
        add_samples(out, action, std::min(samples_at_once, count - done));
    }
    return out + "]}\n";
}

void ReplaySession::add_samples(std::string& out, const Record& action, std::int64_t count) {
    const auto size = static_cast<std::size_t>(count);
    const auto copies_of = [size](const Record& record) {
        Record copies;
        for (std::size_t i = 0; i < size; ++i)
            copies.insert(copies.end(), record.begin(), record.end());
        return copies;
    };
    const solvers::BatchHandle batch = create(next_sample_, count, 0);
    next_sample_ += count;
    simulator_.set_state(batch.get(), 0, count, copies_of(state()).data(), nullptr);

    std::vector<double> rewards(size);
    std::vector<std::uint8_t> ended_by(size);
    rddl_transition transition{};
    transition.rewards = rewards.data();
    transition.causes = ended_by.data();
    simulator_.step(batch.get(), copies_of(action).data(), &transition);

    // These environments are at their first step; the horizon counts those of the main one.
    std::int64_t steps = 0;
    simulator_.get_progress(batch_.get(), 0, 1, &steps, nullptr);
    const bool at_horizon = horizon_ > 0 && steps + 1 >= horizon_;
    for (std::size_t i = 0; i < size; ++i) {
        if (i > 0) out += ',';
        const auto causes = ended_by[i] | (at_horizon ? RDDL_TRUNCATED_HORIZON : 0);
        write_outcome(out, *batch, static_cast<std::int64_t>(i), rewards[i],
                      static_cast<std::uint8_t>(causes));
    }
}

void ReplaySession::write_outcome(std::string& out, const rddl_batch& batch, std::int64_t place,
                                  double reward, std::uint8_t causes) const {
    Record record(std::max(state_layout_.size(), observation_layout_.size()));
    simulator_.get_state(&batch, place, 1, record.data());
    out += R"({"state":)";
    state_layout_.write(out, record.data());
    out += R"(,"observation":)";
    if (problem_.partially_observed) {
        simulator_.get_observation(&batch, place, 1, record.data());
        observation_layout_.write(out, record.data());
    } else {
        out += "null";
    }
    out += R"(,"reward":)";
    write_real(out, reward);
    out += fmt::format(R"(,"terminated":{},"truncated":{})", (causes & RDDL_TERMINATED) != 0,
                       (causes & ~RDDL_TERMINATED) != 0);
    if (causes & RDDL_FAULTED) {
        out += R"(,"fault":)";
        write_string(out, fault_text(simulator_, batch, place));
    }
    out += '}';
}

std::uint8_t ReplaySession::causes() const {
    std::uint8_t ended_by = RDDL_RUNNING;
    simulator_.get_causes(batch_.get(), 0, 1, &ended_by);
    return ended_by;
}

ReplaySession::Record ReplaySession::state() const {
    Record record(state_layout_.size());
    simulator_.get_state(batch_.get(), 0, 1, record.data());
    return record;
}

}  // namespace rddlc::workbench
