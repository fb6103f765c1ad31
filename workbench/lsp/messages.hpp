// Messages of the protocol as bytes: a header that says the length, then JSON.
// https://microsoft.github.io/language-server-protocol, base protocol
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace rddlc::lsp {

using Json = nlohmann::json;

// Longer messages are skipped: a text of RDDL has at most 64 MB, and JSON escapes some of it.
inline constexpr std::size_t longest_message = std::size_t{1} << 28;

// Bytes that are no message: why.
struct Malformed {
    std::string reason;
};
using Incoming = std::variant<Json, Malformed>;

// Cuts a stream of bytes into messages. Whatever the bytes are, it finds the next header.
class MessageReader {
  public:
    void add(std::string_view bytes);
    // Nothing if the rest of the message has not come yet.
    std::optional<Incoming> next();

  private:
    std::optional<Incoming> read_header();
    Incoming read_body();

    std::string buffer_;
    std::size_t skipped_ = 0;              // bytes still to come that nothing is made of
    std::optional<std::size_t> expected_;  // the length of the message, once its header was read
};

// The message with its header. Text that is not UTF-8 is sent with U+FFFD in its place.
std::string framed(const Json& message);

}  // namespace rddlc::lsp
