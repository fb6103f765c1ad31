// Text in UTF-8, by utf8proc: what is one character, whether it is valid, and how wide it is on a
// terminal. The locale does not matter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace rddlc {

struct Character {
    std::string_view bytes;   // a single byte, if it is not UTF-8
    std::int32_t code_point;  // U+FFFD, if it is not UTF-8
    bool is_valid;
    // False for what is not UTF-8, for controls, and for format characters, which change the
    // direction of a line or end it.
    bool is_visible;
    std::size_t width;  // in columns of a terminal: 0 for an accent on the one before, or 2
};

// The text must not be empty.
Character first_character(std::string_view text);

// False for the bytes of a character behind its first one.
constexpr bool begins_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
}

bool is_utf8(std::string_view text);

// The text as a terminal may get it, with U+FFFD for each invisible character, line breaks and tabs
// excepted. Texts that are not ours reach a terminal only through this.
std::string printable(std::string_view text);
// The same of what stands within a line.
std::string printable_line(std::string_view text);

// Columns of a terminal.
std::size_t display_width(std::string_view text);

}  // namespace rddlc
