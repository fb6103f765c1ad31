#include "lsp/messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace rddlc::lsp {

namespace {

constexpr std::size_t longest_header = 8192;
constexpr std::string_view length_field = "content-length:";

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return lower;
}

struct Header {
    std::size_t end;  // of the blank line
    std::string_view text;
};

// Lines should end in "\r\n"; "\n" is understood also.
std::optional<Header> find_header(std::string_view buffer) {
    const std::size_t strict = buffer.find("\r\n\r\n");
    const std::size_t lax = buffer.find("\n\n");
    if (strict == buffer.npos && lax == buffer.npos) return std::nullopt;
    if (strict < lax) return Header{strict + 4, buffer.substr(0, strict)};
    return Header{lax + 2, buffer.substr(0, lax)};
}

std::optional<std::size_t> length_in(std::string_view header) {
    const std::string lower = in_lower_case(header);
    const std::size_t field = lower.rfind(length_field);
    if (field == lower.npos) return std::nullopt;
    std::size_t at = field + length_field.size();
    while (at < lower.size() && lower[at] == ' ') ++at;
    std::size_t length = 0;
    const char* const end = lower.data() + lower.size();
    const auto [stop, error] = std::from_chars(lower.data() + at, end, length);
    const bool ends = stop == end || *stop == '\r' || *stop == '\n' || *stop == ' ';
    if (error != std::errc{} || !ends) return std::nullopt;
    return length;
}

}  // namespace

void MessageReader::add(std::string_view bytes) {
    const std::size_t dropped = std::min(skipped_, bytes.size());
    skipped_ -= dropped;
    buffer_ += bytes.substr(dropped);
}

std::optional<Incoming> MessageReader::next() {
    if (!expected_)
        if (auto malformed = read_header()) return malformed;
    if (!expected_ || buffer_.size() < *expected_) return std::nullopt;
    return read_body();
}

// Sets the expected length, or says what is wrong.
std::optional<Incoming> MessageReader::read_header() {
    const auto header = find_header(buffer_);
    if (!header) {
        if (buffer_.size() <= longest_header) return std::nullopt;
        buffer_.erase(0, buffer_.size() - length_field.size());
        return Malformed{"a header without end"};
    }
    const auto length = length_in(header->text);
    buffer_.erase(0, header->end);
    if (!length) return Malformed{"a header without Content-Length"};
    if (*length > longest_message) {
        const std::size_t here = std::min(*length, buffer_.size());
        buffer_.erase(0, here);
        skipped_ = *length - here;
        return Malformed{
            fmt::format("a message of {} bytes; {} are the limit", *length, longest_message)};
    }
    expected_ = length;
    return std::nullopt;
}

Incoming MessageReader::read_body() {
    const std::string body = buffer_.substr(0, *expected_);
    buffer_.erase(0, *expected_);
    expected_.reset();
    try {
        return Json::parse(body);
    } catch (const Json::exception& error) {
        return Malformed{error.what()};
    }
}

std::string framed(const Json& message) {
    const std::string body = message.dump(-1, ' ', false, Json::error_handler_t::replace);
    return fmt::format("Content-Length: {}\r\n\r\n{}", body.size(), body);
}

}  // namespace rddlc::lsp
