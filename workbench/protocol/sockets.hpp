// TCP connections by POSIX sockets.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace rddlc::workbench {

// An open file descriptor; -1: none.
class Descriptor {
  public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor();

    int get() const { return number_; }

  private:
    int number_;
};

// A socket that listens at this address, which does not block; port 0: one that is free. Throws a
// Failure.
Descriptor listen_at(const std::string& host, int port);
int port_of(const Descriptor& socket);
// "127.0.0.1:2323" of the other side.
std::string peer_of(const Descriptor& socket);
// A connection that waits, or nothing (-1). It does not block.
Descriptor accept_one(const Descriptor& listener);

// Throws a Failure where no server answers.
Descriptor connect_to(const std::string& host, int port);

// Sends as much as the socket takes; how many bytes that were, or -1 where the connection is over.
long send_some(const Descriptor& socket, std::string_view bytes);
// Appends what has come; how many bytes that were (0: nothing yet), or -1 where the connection is
// over.
long receive_some(const Descriptor& socket, std::string& bytes);
// Waits until the socket can be read, for at most so many milliseconds.
bool wait_to_read(const Descriptor& socket, int milliseconds);

}  // namespace rddlc::workbench
