#include "protocol/client.hpp"

#include "solvers/batches/batch.hpp"
#include "support/base64.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <utility>

namespace rddlc::workbench {

namespace {

constexpr std::size_t longest_answer = std::size_t{1} << 28;  // bytes
constexpr int wake_interval = 100;                            // milliseconds

double real_of(const Element& message, std::string_view name) {
    const std::string& text = message.text_of(name);
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end)
        throw BadMessage(
            fmt::format("<{}> of <{}> is '{}', which is not a number", name, message.name, text));
    return value;
}

std::int64_t count_of(const Element& message, std::string_view name, double least) {
    constexpr double most = 1e9;
    const double value = real_of(message, name);
    if (value >= least && value <= most) return static_cast<std::int64_t>(value);
    throw BadMessage(fmt::format("<{}> of <{}> is {}", name, message.name, value));
}

// The environment in which the policy sees what the server says.
class Round {
  public:
    Round(const rddl_simulator& simulator, const ProtocolFluents& actions,
          const ProtocolFluents& states, const solvers::Policy& policy, std::int64_t number,
          const PlayOptions& options)
        : simulator_(simulator),
          actions_(actions),
          states_(states),
          stops_(options.stops),
          number_(number),
          // It has no horizon: when a round ends is for the server to say.
          batch_(solvers::create_environment(simulator, number, options.seed, RDDL_NO_HORIZON)),
          actor_(policy.start(1)) {}

    // The element that answers a turn.
    std::string act(const Element& turn) {
        const rddl_problem& problem = *simulator_.problem;
        const std::int64_t step = count_of(turn, "turn-num", 1) - 1;
        if (!problem.partially_observed) take_state(turn, step);
        const auto* const defaults = static_cast<const std::byte*>(problem.default_action);
        std::vector<std::byte> action(defaults, defaults + problem.action_size);
        std::uint8_t causes = RDDL_RUNNING;
        simulator_.get_causes(batch_.get(), 0, 1, &causes);
        const std::uint8_t running = causes == RDDL_RUNNING;
        std::int32_t violated = -1;
        solvers::Decision decision{batch_.get(),  {&running, 1},  {&number_, 1}, {&step, 1},
                                   action.data(), {&violated, 1}, false,         &stops_};
        actor_(decision);
        std::string out = "<actions>";
        actions_.write_changes(out, action.data(), defaults);
        return out + "</actions>";
    }

  private:
    void take_state(const Element& turn, std::int64_t step) {
        std::vector<std::byte> state(states_.size());
        std::vector<std::uint8_t> seen(states_.count());
        for (const Element& each : turn.children)
            if (each.name == "observed-fluent") seen[states_.read(each, state.data())] = 1;
        if (const auto missing = std::find(seen.begin(), seen.end(), 0); missing != seen.end())
            throw BadMessage(
                fmt::format("the server does not say what {} is",
                            states_.name(static_cast<std::size_t>(missing - seen.begin()))));
        solvers::require_done(simulator_,
                              simulator_.set_state(batch_.get(), 0, 1, state.data(), &step));
    }

    const rddl_simulator& simulator_;
    const ProtocolFluents& actions_;
    const ProtocolFluents& states_;
    solvers::Stops stops_;
    std::int64_t number_;
    solvers::BatchHandle batch_;
    solvers::Actor actor_;
};

}  // namespace

ServerConnection::ServerConnection(Descriptor socket, double patience, std::function<bool()> stops)
    : socket_(std::move(socket)),
      patience_(patience),
      stops_(std::move(stops)),
      frames_(longest_answer) {}

void ServerConnection::send(const std::string& element) {
    std::string message = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + element + '\0';
    while (!message.empty()) {
        const long sent = send_some(socket_, message);
        if (sent < 0) return;  // its last words, if there are some, can still be read
        message.erase(0, static_cast<std::size_t>(sent));
    }
}

Element ServerConnection::next() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    while (true) {
        if (const auto text = frames_.next()) {
            Element message = parse_element(*text);
            if (message.name == "error")
                throw Failure(fmt::format("the server refuses: {}", message.text));
            if (message.name != "resource-notification") return message;
            continue;
        }
        if (stops_ && stops_())
            throw Failure("interrupted before the session was over", {}, interrupted_status());
        if (std::chrono::duration<double>(Clock::now() - begin).count() > patience_)
            throw Failure(fmt::format("the server has said nothing for {} seconds", patience_));
        if (!wait_to_read(socket_, wake_interval)) continue;
        std::string bytes;
        if (receive_some(socket_, bytes) < 0)
            throw Failure("the server has closed the connection before the session was over");
        frames_.add(bytes);
    }
}

SessionInit ServerConnection::begin_session(const std::string& problem, const std::string& client) {
    send("<session-request>" + tagged("problem-name", problem) + tagged("client-name", client) +
         tagged("input-language", "rddl") + "</session-request>");
    const Element answer = next();
    if (answer.name != "session-init")
        throw BadMessage(fmt::format("the server answers <{}>, not <session-init>", answer.name));
    SessionInit session;
    session.rounds = count_of(answer, "num-rounds", 0);
    session.seconds = real_of(answer, "time-allowed") / 1000;
    if (const Element* const task = answer.child("task")) {
        auto text = base64_decoded(task->text);
        if (!text) throw BadMessage("the server's <task> is not base 64");
        session.task = *std::move(text);
    }
    return session;
}

void play_session(ServerConnection& server, const SessionInit& session,
                  const rddl_simulator& simulator, const solvers::Policy& policy,
                  const PlayOptions& options, Played& played) {
    const rddl_problem& problem = *simulator.problem;
    const ProtocolFluents actions(problem, RDDL_ACTION), states(problem, RDDL_STATE);
    while (true) {
        if (static_cast<std::int64_t>(played.returns.size()) < session.rounds)
            server.send("<round-request><execute-policy>yes</execute-policy></round-request>");
        Element message = server.next();
        if (message.name == "session-end") {
            played.total = real_of(message, "total-reward");
            return;
        }
        if (message.name != "round-init")
            throw BadMessage(fmt::format("the server sends <{}>, not <round-init>", message.name));
        Round round(simulator, actions, states, policy,
                    static_cast<std::int64_t>(played.returns.size()), options);
        while ((message = server.next()).name == "turn") {
            server.send(round.act(message));
            ++played.turns;
        }
        if (message.name != "round-end")
            throw BadMessage(fmt::format("the server sends <{}>, not <round-end>", message.name));
        played.returns.push_back(real_of(message, "round-reward"));
        played.total += played.returns.back();
        if (options.round_ended) options.round_ended(played.returns.back());
    }
}

}  // namespace rddlc::workbench
