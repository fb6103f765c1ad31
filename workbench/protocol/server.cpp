#include "protocol/server.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace rddlc::workbench {

namespace {

constexpr std::size_t most_clients = 64;
constexpr std::size_t most_unread = 1 << 20;  // bytes, from which on a client is not read
constexpr int poll_interval = 100;            // milliseconds

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace

struct ProtocolServer::Client {
    Client(Descriptor connection, const ServedProblem& problem, const SessionOptions& options,
           std::int64_t id)
        : socket(std::move(connection)),
          name(peer_of(socket)),
          frames(problem.longest_message),
          session(problem, options, id),
          waiting_since(now()) {}

    Descriptor socket;
    std::string name;
    MessageFrames frames;
    ServerSession session;
    std::string output;    // that is not sent yet
    double waiting_since;  // the client has owed something
    bool is_last_output = false, is_closed = false;

    // Whether the client has to do something at once: begin, finish a message, read, or leave.
    // Thinking about an action takes no more than the session's own time.
    bool owes() const {
        return !session.has_begun() || session.is_over() || frames.is_within_message() ||
               !output.empty();
    }
    // Whether there is room for answers. Some are ten thousand times as long as what they answer.
    bool takes_more() const { return !is_closed && !is_last_output && output.size() < most_unread; }
    bool can_answer() const { return takes_more() && frames.has_more(); }
};

ProtocolServer::ProtocolServer(const ServedProblem& problem, ServerOptions options)
    : problem_(problem),
      options_(std::move(options)),
      listener_(listen_at(options_.host, options_.port)) {
    options_.session.clock = now;
}

ProtocolServer::~ProtocolServer() = default;

void ProtocolServer::run(const std::function<bool()>& stops) {
    while (!stops() && !has_served_all()) {
        wait();
        accept_clients();
        for (const auto& client : clients_) serve(*client);
        remove_closed();
    }
    for (const auto& client : clients_) client->is_closed = true;
    remove_closed();
}

void ProtocolServer::wait() const {
    std::vector<pollfd> all{{listener_.get(), POLLIN, 0}};
    for (const auto& client : clients_) {
        const int events =
            (client->takes_more() ? POLLIN : 0) | (client->output.empty() ? 0 : POLLOUT);
        all.push_back({client->socket.get(), static_cast<short>(events), 0});
    }
    const bool is_busy = std::ranges::any_of(clients_, &Client::can_answer);
    poll(all.data(), static_cast<nfds_t>(all.size()), is_busy ? 0 : poll_interval);
}

void ProtocolServer::accept_clients() {
    while (true) {
        Descriptor socket = accept_one(listener_);
        if (socket.get() < 0) return;
        clients_.push_back(std::make_unique<Client>(std::move(socket), problem_, options_.session,
                                                    ++last_session_));
        if (clients_.size() > most_clients)
            refuse(*clients_.back(), fmt::format("there are {} clients already", most_clients));
    }
}

void ProtocolServer::serve(Client& client) {
    if (client.takes_more() && !client.frames.has_more()) receive(client);
    answer_some(client);
    look_at_clock(client);
    send(client);
}

void ProtocolServer::receive(Client& client) {
    std::string bytes;
    const long count = receive_some(client.socket, bytes);
    if (count < 0) {
        client.is_closed = true;
        return;
    }
    client.frames.add(bytes);
}

// Answers as much as has room, and leaves the rest until that is sent.
void ProtocolServer::answer_some(Client& client) {
    try {
        while (client.takes_more()) {
            const auto message = client.frames.next();
            if (!message) return;
            if (!client.session.is_over()) client.waiting_since = now();
            client.output += client.session.answer(parse_element(*message));
            note(client);
        }
    } catch (const BadMessage& error) {
        refuse(client, error.what());
    } catch (const Failure& failure) {  // such as a lack of memory
        refuse(client, failure.what());
    }
}

// Both sides are told what is wrong.
void ProtocolServer::refuse(Client& client, const std::string& why) {
    if (options_.tell) options_.tell(fmt::format("{}: {}", client.name, why));
    client.output += tagged("error", why) + '\0';
    client.is_last_output = true;
}

void ProtocolServer::note(Client& client) {
    if (const std::string why = client.session.take_note(); !why.empty() && options_.tell)
        options_.tell(fmt::format("{}: round {} ended early: {}", client.name,
                                  client.session.returns().size(), why));
}

void ProtocolServer::look_at_clock(Client& client) {
    if (client.is_closed) return;
    if (std::string end = client.session.end_if_late(); !end.empty()) {
        client.output += end;
        client.waiting_since = now();
        note(client);
    }
    if (!client.owes()) client.waiting_since = now();
    if (now() - client.waiting_since <= options_.patience) return;
    const bool is_done = client.session.is_over() && client.output.empty();
    if (is_done || client.is_last_output || !client.output.empty()) {
        if (!is_done && options_.tell)
            options_.tell(fmt::format("{}: it does not read what it is sent", client.name));
        client.is_closed = true;
        return;
    }
    refuse(client, fmt::format("{} for more than {} seconds",
                               client.session.has_begun() ? "a message has not ended"
                                                          : "there was no <session-request>",
                               options_.patience));
    client.waiting_since = now();
}

void ProtocolServer::send(Client& client) {
    if (client.is_closed) return;
    while (!client.output.empty()) {
        const long sent = send_some(client.socket, client.output);
        if (sent < 0) client.is_closed = true;
        if (sent <= 0) return;
        client.output.erase(0, static_cast<std::size_t>(sent));
        client.waiting_since = now();
    }
    if (client.is_last_output) client.is_closed = true;
}

void ProtocolServer::remove_closed() {
    for (const auto& client : clients_) {
        if (!client->is_closed || !client->session.has_begun()) continue;
        ++ended_;
        if (options_.ended) options_.ended(client->session);
    }
    std::erase_if(clients_, [](const auto& client) { return client->is_closed; });
}

}  // namespace rddlc::workbench
