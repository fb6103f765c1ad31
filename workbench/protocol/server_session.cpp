#include "protocol/server_session.hpp"

#include "engines/faults.hpp"
#include "support/base64.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <utility>

namespace rddlc::workbench {

namespace {

// Environments of rounds that do not count lie beyond those of rounds that do.
constexpr std::int64_t first_practice = std::int64_t{1} << 40;
constexpr std::size_t room_for_the_rest = 1 << 16;  // of a message besides its actions
constexpr std::size_t longest_name = 200;

std::string number(std::int64_t value) {
    return std::to_string(value);
}

solvers::BatchHandle no_batch() {
    return {nullptr, [](rddl_batch*) {
            }};
}

}  // namespace

ServedProblem::ServedProblem(const rddl_simulator& served, const std::string& text)
    : simulator(served),
      task(base64(text)),
      actions(*served.problem, RDDL_ACTION),
      observations(*served.problem, RDDL_OBSERVATION),
      longest_message(room_for_the_rest + actions.count() * actions.longest_element()) {}

ServerSession::ServerSession(const ServedProblem& problem, SessionOptions options, std::int64_t id)
    : problem_(problem), options_(std::move(options)), id_(id), batch_(no_batch()) {}

double ServerSession::seconds() const {
    return has_begun() ? options_.clock() - began_ : 0;
}

std::int64_t ServerSession::milliseconds_left() const {
    return static_cast<std::int64_t>(std::floor(1000 * (options_.seconds - seconds())));
}

std::string ServerSession::framed(const std::string& element) const {
    if (!has_headers_) return element;
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + element + '\0';
}

std::string ServerSession::answer(const Element& message) {
    if (message.name == "resource-request" && has_begun())
        return framed("<resource-notification>" + tagged("time-left", number(milliseconds_left())) +
                      tagged("memory-left", "enough") + "</resource-notification>");
    switch (phase_) {
        case Phase::Greeting:
            return greet(message);
        case Phase::BetweenRounds:
            return begin_round(message);
        case Phase::InRound:
            return take_turn(message);
        case Phase::Over:  // a request that was sent before its end was read
            break;
    }
    return {};
}

namespace {

void require_name(const Element& message, const char* wanted) {
    if (message.name != wanted)
        throw BadMessage(fmt::format("<{}> was expected here, not <{}>", wanted, message.name));
}

}  // namespace

std::string ServerSession::greet(const Element& message) {
    require_name(message, "session-request");
    const std::string instance = problem_.simulator.problem->instance;
    const std::string& wanted = message.text_of("problem-name");
    if (!wanted.empty() && wanted != instance)
        throw BadMessage(
            fmt::format("there is no problem '{}' here: '{}' is served", wanted, instance));
    if (const Element* const language = message.child("input-language");
        language && language->text != "rddl")
        throw BadMessage(
            fmt::format("there are problems in RDDL alone, not in '{}'", language->text));
    client_ = message.text_of("client-name").substr(0, longest_name);
    has_headers_ = !message.child("no-header");
    began_ = options_.clock();
    phase_ = Phase::BetweenRounds;
    return framed("<session-init>" + tagged("task", problem_.task) +
                  tagged("session-id", number(id_)) +
                  tagged("num-rounds", number(options_.rounds)) +
                  tagged("time-allowed", java_real(1000 * options_.seconds)) + "</session-init>");
}

std::string ServerSession::begin_round(const Element& message) {
    require_name(message, "round-request");
    const Element* const executed = message.child("execute-policy");
    counts_ = !executed || executed->text != "no";
    const auto done = static_cast<std::int64_t>(returns_.size());
    const std::int64_t environment = counts_ ? done : first_practice + practice_rounds_++;
    batch_ = solvers::create_environment(problem_.simulator, environment, options_.seed);
    turns_ = 0;
    reward_ = total_ = 0;
    discount_ = 1;
    phase_ = Phase::InRound;
    const std::int64_t round = done + (counts_ ? 1 : 0);
    return framed("<round-init>" + tagged("round-num", number(round)) +
                  tagged("round-left", number(options_.rounds - round)) +
                  tagged("time-left", number(milliseconds_left())) + "</round-init>") +
           turn_message();
}

std::string ServerSession::turn_message() const {
    std::string out = "<turn>" + tagged("turn-num", number(turns_ + 1)) +
                      tagged("time-left", number(milliseconds_left())) +
                      tagged("immediate-reward", java_real(reward_));
    if (problem_.simulator.problem->partially_observed && turns_ == 0) {
        out += "<no-observed-fluents/>";
    } else {
        std::vector<std::byte> record(problem_.observations.size());
        problem_.simulator.get_observation(batch_.get(), 0, 1, record.data());
        problem_.observations.write(out, record.data());
    }
    return framed(out + "</turn>");
}

std::vector<std::byte> ServerSession::action_of(const Element& message) const {
    require_name(message, "actions");
    const rddl_problem& problem = *problem_.simulator.problem;
    const auto* const defaults = static_cast<const std::byte*>(problem.default_action);
    std::vector<std::byte> action(defaults, defaults + problem.action_size);
    for (const Element& each : message.children) {
        require_name(each, "action");
        problem_.actions.read(each, action.data());
    }
    return action;
}

// Why the action is illegal; "" if it is not.
std::string ServerSession::complaint_about(const std::vector<std::byte>& action) {
    const rddl_simulator& simulator = problem_.simulator;
    const rddl_problem& problem = *simulator.problem;
    const std::int64_t changes = problem_.actions.count_changes(
        action.data(), static_cast<const std::byte*>(problem.default_action));
    if (problem.max_nondef_actions >= 0 && changes > problem.max_nondef_actions)
        return fmt::format("{} action values differ from their default; at most {} may", changes,
                           problem.max_nondef_actions);
    std::int32_t violated = -1;
    simulator.violated_preconditions(batch_.get(), action.data(), &violated);
    if (violated < 0) return {};
    const rddl_condition& condition = *rddl_condition_at(&problem, problem.preconditions, violated);
    return fmt::format("{}: precondition violated: {}", source_text(condition.source),
                       condition.text);
}

std::string ServerSession::take_turn(const Element& message) {
    const std::vector<std::byte> action = action_of(message);
    reward_ = 0;
    if (const std::string why = complaint_about(action); !why.empty()) {
        note_ = why;
        return end_round();
    }
    std::uint8_t causes = RDDL_RUNNING;
    rddl_transition out{};
    out.rewards = &reward_;
    out.causes = &causes;
    problem_.simulator.step(batch_.get(), action.data(), &out);
    if (causes & RDDL_FAULTED) {
        note_ = solvers::fault_text(problem_.simulator, *batch_, 0);
        reward_ = 0;
    }
    total_ += discount_ * reward_;
    discount_ *= problem_.simulator.problem->discount;
    ++turns_;
    ++all_turns_;
    return causes == RDDL_RUNNING && !is_late() ? turn_message() : end_round();
}

std::string ServerSession::end_round() {
    phase_ = Phase::BetweenRounds;
    const auto place = static_cast<std::int64_t>(returns_.size());
    if (counts_) returns_.push_back(total_);
    const std::string end =
        framed("<round-end>" + tagged("instance-name", problem_.simulator.problem->instance) +
               tagged("client-name", client_) + tagged("round-num", number(place)) +
               tagged("round-reward", java_real(total_)) + tagged("turns-used", number(turns_)) +
               tagged("time-left", number(milliseconds_left())) +
               tagged("immediate-reward", java_real(reward_)) + "</round-end>");
    const bool is_last = static_cast<std::int64_t>(returns_.size()) == options_.rounds;
    return is_last || is_late() ? end + end_session() : end;
}

std::string ServerSession::end_session() {
    phase_ = Phase::Over;
    const double total = std::accumulate(returns_.begin(), returns_.end(), 0.0);
    return framed("<session-end>" + tagged("instance-name", problem_.simulator.problem->instance) +
                  tagged("total-reward", java_real(total)) +
                  tagged("rounds-used", number(static_cast<std::int64_t>(returns_.size()))) +
                  tagged("client-name", client_) + tagged("session-id", number(id_)) +
                  tagged("time-left", number(milliseconds_left())) + "</session-end>");
}

std::string ServerSession::end_if_late() {
    if (!has_begun() || is_over() || !is_late()) return {};
    note_ = "the time of the session is up";
    return phase_ == Phase::InRound ? end_round() : end_session();
}

}  // namespace rddlc::workbench
