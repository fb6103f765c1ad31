// One session of the protocol, as the server has it: messages in, messages out, without sockets.
// Rounds are episodes: that number r (from 0) is environment r of the seed, as in run_episodes.
#pragma once

#include "protocol/protocol_fluents.hpp"
#include "protocol/xml.hpp"
#include "solvers/batches/batch.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::workbench {

struct SessionOptions {
    std::int64_t rounds = 30;
    double seconds = 1080;  // of a session; rddlsim's
    std::uint64_t seed = 0;
    // Seconds since some moment.
    std::function<double()> clock = {};
};

// The data that all sessions share. The simulator must outlive it.
struct ServedProblem {
    ServedProblem(const rddl_simulator& served, const std::string& text);

    const rddl_simulator& simulator;
    std::string task;  // domain and instance, in base 64
    ProtocolFluents actions, observations;
    std::size_t longest_message;  // of a client, in bytes
};

class ServerSession {
  public:
    // `problem` must outlive it.
    ServerSession(const ServedProblem& problem, SessionOptions options, std::int64_t id);

    // The bytes that answer a message. Throws a BadMessage with what the client has to be told
    // before its connection is closed.
    std::string answer(const Element& message);
    // Ends a session whose time is up: the bytes that say so, or none while there is time left.
    std::string end_if_late();

    bool has_begun() const { return phase_ != Phase::Greeting; }
    bool is_over() const { return phase_ == Phase::Over; }
    const std::string& client() const { return client_; }
    // The reward of each round that is over, discounted.
    const std::vector<double>& returns() const { return returns_; }
    std::int64_t turns() const { return all_turns_; }
    double seconds() const;  // since the session began
    // The sentence why the round ended early, since it was asked last; "" if nothing did.
    std::string take_note() { return std::exchange(note_, {}); }

  private:
    enum class Phase { Greeting, BetweenRounds, InRound, Over };

    std::string greet(const Element& message);
    std::string begin_round(const Element& message);
    std::string take_turn(const Element& message);
    std::vector<std::byte> action_of(const Element& message) const;
    std::string complaint_about(const std::vector<std::byte>& action);
    std::string end_round();
    std::string end_session();
    std::string turn_message() const;
    std::string framed(const std::string& element) const;
    std::int64_t milliseconds_left() const;
    bool is_late() const { return milliseconds_left() <= 0; }

    const ServedProblem& problem_;
    SessionOptions options_;
    std::int64_t id_;
    Phase phase_ = Phase::Greeting;
    bool has_headers_ = true;  // and zero bytes behind messages
    std::string client_;
    double began_ = 0;
    solvers::BatchHandle batch_;
    // The state of the round.
    bool counts_ = true;
    std::int64_t turns_ = 0;  // that are made
    double reward_ = 0, total_ = 0, discount_ = 1;

    std::vector<double> returns_;
    std::int64_t all_turns_ = 0, practice_rounds_ = 0;
    std::string note_;
};

}  // namespace rddlc::workbench
