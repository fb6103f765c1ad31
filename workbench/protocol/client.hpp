// A client of the protocol: plays a policy against a server, such as rddlsim or rddl serve.
#pragma once

#include "protocol/protocol_fluents.hpp"
#include "protocol/sockets.hpp"
#include "protocol/xml.hpp"
#include "solvers/policies/policy.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace rddlc::workbench {

// The server's description of itself.
struct SessionInit {
    std::string task;  // domain and instance; "" where the server sends none
    std::int64_t rounds = 0;
    double seconds = 0;  // that are allowed
};

class ServerConnection {
  public:
    // Gives up where the server says nothing for `patience` seconds, or once `stops` says so.
    ServerConnection(Descriptor socket, double patience, std::function<bool()> stops);

    // Throws a Failure where the server refuses. An empty name means the problem that a server of
    // rddlc has.
    SessionInit begin_session(const std::string& problem, const std::string& client);

    // A connection that the server has closed is reported by next().
    void send(const std::string& element);
    // The next message, which is not <resource-notification>. Throws a Failure where the server
    // has closed the connection, or has sent an <error>.
    Element next();

  private:
    Descriptor socket_;
    double patience_;
    std::function<bool()> stops_;
    MessageFrames frames_;
};

struct PlayOptions {
    std::uint64_t seed = 0;  // of the simulator's copies that a planner or a policy block draws in
    // Called after each round, with the reward that the server counts.
    std::function<void(double)> round_ended = {};
    std::function<bool()> stops = {};
};

struct Played {
    std::vector<double> returns;  // of the rounds, as the server counts them: discounted
    double total = 0;             // that the server ends with; the sum of the rounds before that
    std::int64_t turns = 0;
};

// Plays the rounds of a session that has begun. The states are the server's; the policy sees them
// in a batch of `simulator`. Throws a Failure where the problems differ or the session ends early;
// `played` then has the rounds that are over.
void play_session(ServerConnection& server, const SessionInit& session,
                  const rddl_simulator& simulator, const solvers::Policy& policy,
                  const PlayOptions& options, Played& played);

}  // namespace rddlc::workbench
