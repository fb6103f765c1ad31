#include "lsp/server.hpp"

#include "lsp/session.hpp"
#include "terminal/interrupt.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <deque>
#include <future>
#include <memory>
#include <system_error>
#include <thread>
#include <variant>

namespace rddlc::lsp {

namespace {

// The client has closed its end.
struct HungUp {};

// A check that runs beside the server. A byte arrives in a pipe when it is done.
class BackgroundCheck {
  public:
    BackgroundCheck() {
        if (::pipe2(pipe_.data(), O_CLOEXEC) != 0)
            throw std::system_error(errno, std::generic_category(), "pipe");
    }
    BackgroundCheck(const BackgroundCheck&) = delete;
    BackgroundCheck& operator=(const BackgroundCheck&) = delete;

    int descriptor() const { return pipe_[0]; }
    bool is_running() const { return checks_.valid(); }

    void start(CheckRequest request) {
        std::packaged_task<Checks()> task([all = std::move(request)] { return run_checks(all); });
        checks_ = task.get_future();
        const int done = pipe_[1];
        // The thread may outlive the server: a client that leaves does not wait for it.
        std::thread([work = std::move(task), done]() mutable {
            work();
            const char byte = 0;
            [[maybe_unused]] const auto written = ::write(done, &byte, 1);
        }).detach();
    }

    // Once the byte has arrived. Throws what the check did.
    Checks take() {
        char byte = 0;
        [[maybe_unused]] const auto bytes = ::read(pipe_[0], &byte, 1);
        return checks_.get();
    }

  private:
    std::array<int, 2> pipe_{-1, -1};  // open for as long as the program runs
    std::future<Checks> checks_;
};

class Server {
  public:
    Server(int input, int output, const ServerOptions& options)
        : input_(input), output_(output), options_(options), session_(options.standard) {}

    ExitStatus run() {
        try {
            while (!session_.has_ended() && !workbench::is_interrupted()) turn();
        } catch (const HungUp&) {
            return diagnosed;
        }
        if (workbench::is_interrupted()) return workbench::interrupted_status();
        return session_.was_shut_down() ? success : diagnosed;
    }

    bool is_checking() const { return check_.is_running(); }

  private:
    // Waits for input, for a check that ends, or for the time to begin one.
    void turn() {
        if (session_.take_change()) {
            is_due_ = true;
            due_ = std::chrono::steady_clock::now() + options_.pause;
        }
        std::array<pollfd, 2> ready{{{input_, POLLIN, 0}, {check_.descriptor(), POLLIN, 0}}};
        if (::poll(ready.data(), ready.size(), timeout()) < 0 && errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "poll");
        if (ready[0].revents != 0) {
            read_input();
            handle_all();
        }
        if (ready[1].revents & POLLIN) finish_check();
        if (is_due_ && !check_.is_running() && timeout() == 0) begin_check();
    }

    int timeout() const {
        if (!is_due_ || check_.is_running()) return -1;
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(due_ - std::chrono::steady_clock::now());
        return std::max(0, static_cast<int>(left.count()));
    }

    void read_input() {
        std::array<char, 1 << 16> block;
        const ssize_t size = ::read(input_, block.data(), block.size());
        if (size < 0 && (errno == EINTR || errno == EAGAIN)) return;
        if (size <= 0) throw HungUp{};
        reader_.add({block.data(), static_cast<std::size_t>(size)});
        while (auto message = reader_.next()) queue_.push_back(std::move(*message));
    }

    // Whatever has come is known before the first of it is handled, so a request can be cancelled.
    void handle_all() {
        drop_cancelled();
        while (!queue_.empty() && !session_.has_ended()) {
            const Incoming message = std::move(queue_.front());
            queue_.pop_front();
            if (const auto* malformed = std::get_if<Malformed>(&message))
                send(session_.handle_malformed(malformed->reason));
            else
                send(session_.handle(std::get<Json>(message)));
        }
    }

    void drop_cancelled() {
        std::vector<Json> cancelled;
        std::erase_if(queue_, [&](const Incoming& each) {
            const auto* json = std::get_if<Json>(&each);
            const bool is_cancel =
                json && json->is_object() && json->value("method", Json()) == "$/cancelRequest";
            if (is_cancel) {
                const Json params = json->value("params", Json());
                cancelled.push_back(params.is_object() ? params.value("id", Json()) : Json());
            }
            return is_cancel;
        });
        for (const Json& id : cancelled) drop(id);
    }

    void drop(const Json& id) {
        const auto is_it = [&](const Incoming& each) {
            const auto* json = std::get_if<Json>(&each);
            return json && json->is_object() && json->contains("method") && !id.is_null() &&
                   json->value("id", Json()) == id;
        };
        if (std::erase_if(queue_, is_it) > 0) send({Session::cancelled(id)});
    }

    void begin_check() {
        is_due_ = false;
        check_.start(session_.check_request());
    }

    void finish_check() {
        try {
            send(session_.publish(check_.take()));
        } catch (const std::exception& error) {
            const Json params = {{"type", 1}, {"message", std::string("rddl: ") + error.what()}};
            send({{{"jsonrpc", "2.0"}, {"method", "window/logMessage"}, {"params", params}}});
        }
    }

    void send(const std::vector<Json>& messages) {
        for (const Json& message : messages) write(framed(message));
    }

    void write(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t size = ::write(output_, bytes.data(), bytes.size());
            if (size < 0 && errno == EINTR) continue;
            if (size < 0 && errno == EAGAIN) {
                pollfd ready{output_, POLLOUT, 0};
                ::poll(&ready, 1, -1);
                continue;
            }
            if (size < 0) throw HungUp{};
            bytes.remove_prefix(static_cast<std::size_t>(size));
        }
    }

    int input_, output_;
    ServerOptions options_;
    Session session_;
    MessageReader reader_;
    std::deque<Incoming> queue_;
    BackgroundCheck check_;
    bool is_due_ = false;
    std::chrono::steady_clock::time_point due_;
};

}  // namespace

ExitStatus serve(int input, int output, const ServerOptions& options) {
    Server server(input, output, options);
    const ExitStatus status = server.run();
    // A check of a large problem may take minutes, and the client does not wait for it.
    if (server.is_checking()) std::_Exit(status);
    return status;
}

}  // namespace rddlc::lsp
