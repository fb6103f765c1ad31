#include "studio/access.hpp"

#include "support/failure.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <cerrno>

namespace rddlc::studio {

namespace {

// Takes the same time for all wrong tokens of the right length.
bool is_same_secret(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

bool is_one_of(std::string_view text, const std::array<std::string, 2>& all) {
    return text == all[0] || text == all[1];
}

}  // namespace

Access::Access(int port, std::string token) : port_(port), token_(std::move(token)) {}

std::string Access::address() const {
    return fmt::format("http://127.0.0.1:{}/#{}", port_, token_);
}

std::optional<std::string> Access::refusal_of_page(const Sender& sender) const {
    if (!is_one_of(sender.host,
                   {fmt::format("127.0.0.1:{}", port_), fmt::format("localhost:{}", port_)}))
        return "the Host is not this server";
    if (!sender.origin.empty() &&
        !is_one_of(sender.origin, {fmt::format("http://127.0.0.1:{}", port_),
                                   fmt::format("http://localhost:{}", port_)}))
        return "another page has sent this";
    return std::nullopt;
}

std::optional<std::string> Access::refusal_of_request(const Sender& sender) const {
    if (auto refusal = refusal_of_page(sender)) return refusal;
    if (!is_same_secret(sender.token, token_))
        return "the token is missing or wrong: open the address that 'rddl studio' has printed";
    return std::nullopt;
}

std::string new_token() {
    std::array<unsigned char, 32> bytes{};
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = getrandom(bytes.data() + done, bytes.size() - done, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) throw Failure("the system gives no random numbers");
        done += static_cast<std::size_t>(got);
    }
    std::string text;
    for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

}  // namespace rddlc::studio
