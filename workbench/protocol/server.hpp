// A server of the protocol of IPPC 2011 to 2018, which rddlsim speaks (docs/planning.md): many
// clients side by side, each with a session of its own, in one thread.
#pragma once

#include "protocol/server_session.hpp"
#include "protocol/sockets.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rddlc::workbench {

struct ServerOptions {
    SessionOptions session;  // its clock is set here
    std::string host = "127.0.0.1";
    int port = 2323;            // 0: any that is free
    double patience = 60;       // seconds for the rest of a message, for a client to read, ...
    std::int64_t sessions = 0;  // after which the server ends; 0: it goes on
    // Called with each session that was begun, when its connection is over.
    std::function<void(const ServerSession&)> ended = {};
    // Called with sentences about clients that did something wrong.
    std::function<void(const std::string&)> tell = {};
};

class ProtocolServer {
  public:
    // Listens from now on. `problem` must outlive it. Throws a Failure.
    ProtocolServer(const ServedProblem& problem, ServerOptions options);
    ~ProtocolServer();

    int port() const { return port_of(listener_); }
    // Serves until `stops`, which is asked ten times a second, or the last session has ended.
    void run(const std::function<bool()>& stops);

  private:
    struct Client;

    void accept_clients();
    void wait() const;
    void serve(Client& client);
    void receive(Client& client);
    void answer_some(Client& client);
    void refuse(Client& client, const std::string& why);
    void send(Client& client);
    void look_at_clock(Client& client);
    void note(Client& client);
    void remove_closed();
    bool has_served_all() const { return options_.sessions > 0 && ended_ >= options_.sessions; }

    const ServedProblem& problem_;
    ServerOptions options_;
    Descriptor listener_;
    std::vector<std::unique_ptr<Client>> clients_;
    std::int64_t last_session_ = 0, ended_ = 0;
};

}  // namespace rddlc::workbench
