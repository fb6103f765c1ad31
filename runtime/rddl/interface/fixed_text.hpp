// Text without allocation.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace rddl {

// Text into a buffer of fixed size, cut off where the buffer ends, always terminated.
class FixedText {
  public:
    explicit FixedText(std::span<char> buffer) : buffer_(buffer) { *this << std::string_view(); }

    FixedText& operator<<(std::string_view text) {
        wanted_ += text.size();
        for (const char character : text) {
            if (length_ + 1 >= buffer_.size()) break;
            buffer_[length_++] = character;
        }
        if (!buffer_.empty()) buffer_[length_] = '\0';
        return *this;
    }
    FixedText& operator<<(std::int64_t value) { return write_number(value); }
    // Writes the shortest exact form; a nan without its sign, which means nothing.
    FixedText& operator<<(double value) {
        return value != value ? *this << std::string_view("nan") : write_number(value);
    }

    // The length of the text as it would be without an end of the buffer.
    std::size_t wanted() const { return wanted_; }

  private:
    FixedText& write_number(auto value) {
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
    }

    std::span<char> buffer_;
    std::size_t length_ = 0, wanted_ = 0;
};

}  // namespace rddl
