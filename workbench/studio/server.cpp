#include "studio/server.hpp"

#include "studio/access.hpp"
#include "studio/page.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <chrono>
#include <future>
#include <thread>
#include <utility>

namespace rddlc::studio {

namespace {

constexpr int usual_port = 7334;
constexpr const char* loopback = "127.0.0.1";
// Two texts, each escaped: as much as the compiler reads, and more than a page can edit.
constexpr std::size_t longest_body = std::size_t{1} << 26;
// Requests at work. A check of a large text takes a thread for as long as it runs.
constexpr std::size_t threads = 32;
constexpr std::time_t longest_silence = 5;  // seconds, between the bytes of a request
constexpr std::chrono::milliseconds longest_wait_for_requests{2000};

struct File {
    const char* path;
    const char* type;
    std::string_view text;
};

constexpr const char* script = "text/javascript; charset=utf-8";
const File files[] = {{"/", "text/html; charset=utf-8", page::index_html},
                      {"/studio.css", "text/css; charset=utf-8", page::studio_css},
                      {"/icon.svg", "image/svg+xml", page::icon_svg},
                      {"/server.js", script, page::server_js},
                      {"/words.js", script, page::words_js},
                      {"/editor.js", script, page::editor_js},
                      {"/problem.js", script, page::problem_js},
                      {"/chart.js", script, page::chart_js},
                      {"/episode.js", script, page::episode_js},
                      {"/try.js", script, page::try_js},
                      {"/compare.js", script, page::compare_js},
                      {"/train.js", script, page::train_js},
                      {"/main.js", script, page::main_js}};

// Nothing is loaded from elsewhere, nothing is framed, no script stands in the page.
const httplib::Headers headers = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; "
     "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cache-Control", "no-store"}};

constexpr const char* api = "/api/";

void refuse(httplib::Response& response, int status, const std::string& why) {
    response.status = status;
    response.set_content(fmt::format(R"({{"error":"{}"}})", why), "application/json");
}

// httplib shares the port with other programs of the user; this does not.
void set_options(socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

}  // namespace

struct StudioServer::Http {
    httplib::Server server;
    std::optional<Access> access;

    using Handled = httplib::Server::HandlerResponse;

    Handled check(const httplib::Request& request, httplib::Response& response) const {
        const std::string host = request.get_header_value("Host");
        const std::string origin = request.get_header_value("Origin");
        const std::string token = request.get_header_value("X-Rddl-Token");
        const Sender sender{host, origin, token};
        const bool is_api = request.path.starts_with(api);
        const auto why =
            is_api ? access->refusal_of_request(sender) : access->refusal_of_page(sender);
        if (why) {
            refuse(response, 403, *why);
            return Handled::Handled;
        }
        const bool is_json = request.get_header_value("Content-Type") == "application/json";
        if (is_api && (request.method != "POST" || !is_json)) {
            refuse(response, 415, "requests are JSON that is posted");
            return Handled::Handled;
        }
        return Handled::Unhandled;
    }

    void serve_files() {
        for (const File& file : files)
            server.Get(file.path, [&file](const httplib::Request&, httplib::Response& response) {
                response.set_content(file.text.data(), file.text.size(), file.type);
            });
    }

    void serve_requests(const std::shared_ptr<Studio>& studio) {
        server.Post("/api/([a-z_]+)",
                    [studio](const httplib::Request& request, httplib::Response& response) {
                        const Reply reply = studio->answer(request.matches[1], request.body);
                        response.status = reply.status;
                        response.set_content(reply.body, reply.type.c_str());
                    });
    }

    int bind(const ServerOptions& options) {
        if (options.port && *options.port != 0) {
            if (!server.bind_to_port(loopback, *options.port))
                throw Failure(fmt::format("cannot listen at port {}: it is taken", *options.port),
                              "leave out --port, or name another one");
            return *options.port;
        }
        if (!options.port && server.bind_to_port(loopback, usual_port)) return usual_port;
        const int port = server.bind_to_any_port(loopback);
        if (port < 0) throw Failure("cannot listen at any port");
        return port;
    }
};

StudioServer::StudioServer(std::shared_ptr<Studio> studio, const ServerOptions& options)
    : studio_(std::move(studio)), http_(std::make_shared<Http>()) {
    httplib::Server& server = http_->server;
    server.set_socket_options(set_options);
    server.set_payload_max_length(longest_body);
    server.set_read_timeout(longest_silence);
    server.set_write_timeout(longest_silence);
    server.set_keep_alive_max_count(1);  // a connection that waits would hold a thread
    server.set_default_headers(headers);
    server.set_tcp_nodelay(true);
    server.new_task_queue = [] {
        return new httplib::ThreadPool(threads);
    };
    http_->access.emplace(http_->bind(options), new_token());
    server.set_pre_routing_handler(
        [http = http_.get()](const httplib::Request& request, httplib::Response& response) {
            return http->check(request, response);
        });
    http_->serve_files();
    http_->serve_requests(studio_);
}

StudioServer::~StudioServer() = default;

std::string StudioServer::address() const {
    return http_->access->address();
}

bool StudioServer::run(const std::function<bool()>& stops) {
    const auto ended = std::make_shared<std::promise<void>>();
    const std::future<void> end = ended->get_future();
    std::thread listener([http = http_, ended] {
        http->server.listen_after_bind();
        ended->set_value();
    });
    constexpr std::chrono::milliseconds pause{100};
    while (!stops() && end.wait_for(pause) == std::future_status::timeout) {
    }
    http_->server.stop();
    const bool jobs_ended = studio_->stop();
    const bool requests_ended =
        end.wait_for(longest_wait_for_requests) == std::future_status::ready;
    if (requests_ended)
        listener.join();
    else
        listener.detach();
    return jobs_ended && requests_ended;
}

}  // namespace rddlc::studio
