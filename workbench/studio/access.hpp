// Which requests of a browser are answered: those of our own page alone. Other pages in the same
// browser can send requests to any port of this machine, and names of theirs may lead to it (DNS
// rebinding), so that the address alone protects nothing.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rddlc::studio {

// The parts of a request that say who sends it. Absent headers are empty.
struct Sender {
    std::string_view host;    // "127.0.0.1:7334"
    std::string_view origin;  // "http://127.0.0.1:7334"
    std::string_view token;
};

class Access {
  public:
    Access(int port, std::string token);

    const std::string& token() const { return token_; }
    // Ends with the token, as a fragment: browsers send it neither to servers nor as a referrer.
    std::string address() const;

    // Why the page's own files are refused; nothing if they are not. They hold no secret.
    std::optional<std::string> refusal_of_page(const Sender& sender) const;
    // The same for requests that read or do something.
    std::optional<std::string> refusal_of_request(const Sender& sender) const;

  private:
    int port_;
    std::string token_;
};

// 256 random bits of the system as hexadecimal digits. Throws a Failure.
std::string new_token();

}  // namespace rddlc::studio
