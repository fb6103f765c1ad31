#include "support/utf8.hpp"

#include <utf8proc.h>

#include <algorithm>

namespace rddlc {

namespace {

bool is_invisible(utf8proc_category_t category) {
    return category == UTF8PROC_CATEGORY_CC || category == UTF8PROC_CATEGORY_CF ||
           category == UTF8PROC_CATEGORY_ZL || category == UTF8PROC_CATEGORY_ZP;
}

constexpr std::string_view replacement = "\xEF\xBF\xBD";
constexpr std::int32_t replacement_code = 0xFFFD;

std::string with_replacements(std::string_view text, std::string_view allowed) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        if (text.front() >= ' ' && text.front() <= '~') {
            out += text.front();
            text.remove_prefix(1);
            continue;
        }
        const Character character = first_character(text);
        const bool passes =
            character.is_visible || allowed.find(character.bytes) != std::string_view::npos;
        out += passes ? character.bytes : replacement;
        text.remove_prefix(character.bytes.size());
    }
    return out;
}

}  // namespace

Character first_character(std::string_view text) {
    constexpr std::size_t longest = 4;
    utf8proc_int32_t code_point = 0;
    const utf8proc_ssize_t length = utf8proc_iterate(
        reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
        static_cast<utf8proc_ssize_t>(std::min(text.size(), longest)), &code_point);
    if (length <= 0)
        return {.bytes = text.substr(0, 1),
                .code_point = replacement_code,
                .is_valid = false,
                .is_visible = false,
                .width = 1};
    return {.bytes = text.substr(0, static_cast<std::size_t>(length)),
            .code_point = code_point,
            .is_valid = true,
            .is_visible = !is_invisible(utf8proc_category(code_point)),
            .width = static_cast<std::size_t>(utf8proc_charwidth(code_point))};
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const Character character = first_character(text);
        if (!character.is_valid) return false;
        text.remove_prefix(character.bytes.size());
    }
    return true;
}

std::string printable(std::string_view text) {
    return with_replacements(text, "\n\t");
}

std::string printable_line(std::string_view text) {
    return with_replacements(text, "");
}

std::size_t display_width(std::string_view text) {
    std::size_t width = 0;
    while (!text.empty()) {
        const Character character = first_character(text);
        width += character.width;
        text.remove_prefix(character.bytes.size());
    }
    return width;
}

}  // namespace rddlc
