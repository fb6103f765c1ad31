#include "protocol/sockets.hpp"

#include "support/failure.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

namespace rddlc::workbench {

namespace {

#ifdef MSG_NOSIGNAL
constexpr int without_signal = MSG_NOSIGNAL;
#else
constexpr int without_signal = 0;
#endif

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

Addresses addresses_of(const std::string& host, int port, int flags) {
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = flags | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
    if (error != 0)
        throw Failure(fmt::format("there is no address '{}': {}", host, gai_strerror(error)));
    return {found, freeaddrinfo};
}

void prepare(int socket) {
    fcntl(socket, F_SETFD, FD_CLOEXEC);
    const int yes = 1;
    setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
#ifdef SO_NOSIGPIPE
    setsockopt(socket, SOL_SOCKET, SO_NOSIGPIPE, &yes, sizeof yes);
#endif
}

void do_not_block(int socket) {
    fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
}

// The first address for which `use` succeeds.
template <class Use>
Descriptor first_socket(const Addresses& addresses, Use use) {
    for (const addrinfo* each = addresses.get(); each; each = each->ai_next) {
        Descriptor socket(::socket(each->ai_family, each->ai_socktype, each->ai_protocol));
        if (socket.get() < 0) continue;
        prepare(socket.get());
        if (use(socket.get(), *each)) return socket;
    }
    return Descriptor();
}

bool is_only_for_now() {
    return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

}  // namespace

Descriptor::~Descriptor() {
    if (number_ >= 0) close(number_);
}

Descriptor listen_at(const std::string& host, int port) {
    Descriptor socket =
        first_socket(addresses_of(host, port, AI_PASSIVE), [](int number, const addrinfo& address) {
            const int yes = 1;
            setsockopt(number, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
            return bind(number, address.ai_addr, address.ai_addrlen) == 0 &&
                   listen(number, SOMAXCONN) == 0;
        });
    if (socket.get() < 0)
        throw Failure(fmt::format("cannot listen at {}:{}: {}", host, port, std::strerror(errno)),
                      errno == EADDRINUSE ? "another server is there: choose another --port" : "");
    do_not_block(socket.get());
    return socket;
}

int port_of(const Descriptor& socket) {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.ss_family == AF_INET6
                     ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                     : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

std::string peer_of(const Descriptor& socket) {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    std::array<char, NI_MAXHOST> host{};
    std::array<char, NI_MAXSERV> port{};
    auto* const where = reinterpret_cast<sockaddr*>(&address);
    if (getpeername(socket.get(), where, &size) != 0 ||
        getnameinfo(where, size, host.data(), host.size(), port.data(), port.size(),
                    NI_NUMERICHOST | NI_NUMERICSERV) != 0)
        return "a client";
    return fmt::format("{}:{}", host.data(), port.data());
}

Descriptor accept_one(const Descriptor& listener) {
    Descriptor socket(accept(listener.get(), nullptr, nullptr));
    if (socket.get() < 0) return socket;
    prepare(socket.get());
    do_not_block(socket.get());
    return socket;
}

Descriptor connect_to(const std::string& host, int port) {
    Descriptor socket =
        first_socket(addresses_of(host, port, 0), [](int number, const addrinfo& address) {
            return connect(number, address.ai_addr, address.ai_addrlen) == 0;
        });
    if (socket.get() < 0)
        throw Failure(
            fmt::format("no server answers at {}:{}: {}", host, port, std::strerror(errno)),
            "start one: rddl serve DOMAIN INSTANCE");
    return socket;
}

long send_some(const Descriptor& socket, std::string_view bytes) {
    const ssize_t sent = send(socket.get(), bytes.data(), bytes.size(), without_signal);
    if (sent >= 0) return sent;
    return is_only_for_now() ? 0 : -1;
}

long receive_some(const Descriptor& socket, std::string& bytes) {
    std::array<char, 1 << 16> buffer;
    const ssize_t received = recv(socket.get(), buffer.data(), buffer.size(), 0);
    if (received > 0) bytes.append(buffer.data(), static_cast<std::size_t>(received));
    if (received > 0) return received;
    return received < 0 && is_only_for_now() ? 0 : -1;
}

bool wait_to_read(const Descriptor& socket, int milliseconds) {
    pollfd entry{socket.get(), POLLIN, 0};
    return poll(&entry, 1, milliseconds) > 0;
}

}  // namespace rddlc::workbench
