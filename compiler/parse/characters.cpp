#include "parse/characters.hpp"

#include "support/utf8.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc {
namespace {

struct Invisible {
    std::int32_t first, last;
    std::string_view name;
    bool is_blank = false;
};

// https://www.unicode.org/charts: those that editors show as nothing, or as an ordinary blank.
constexpr Invisible invisibles[] = {
    {0x0085, 0x0085, "next line", true},
    {0x0080, 0x009F, "control character"},
    {0x00A0, 0x00A0, "no-break space", true},
    {0x00AD, 0x00AD, "soft hyphen"},
    {0x034F, 0x034F, "combining grapheme joiner"},
    {0x061C, 0x061C, "mark of the direction of text"},
    {0x115F, 0x1160, "Hangul filler"},
    {0x1680, 0x1680, "Ogham space mark", true},
    {0x180E, 0x180E, "Mongolian vowel separator"},
    {0x2000, 0x200A, "space of a fixed width", true},
    {0x200B, 0x200B, "zero width space"},
    {0x200C, 0x200C, "zero width non-joiner"},
    {0x200D, 0x200D, "zero width joiner"},
    {0x200E, 0x200E, "left-to-right mark"},
    {0x200F, 0x200F, "right-to-left mark"},
    {0x2028, 0x2028, "line separator", true},
    {0x2029, 0x2029, "paragraph separator", true},
    {0x202A, 0x202E, "mark of the direction of text"},
    {0x202F, 0x202F, "narrow no-break space", true},
    {0x205F, 0x205F, "mathematical space", true},
    {0x2060, 0x2060, "word joiner"},
    {0x2061, 0x2064, "invisible operator"},
    {0x2066, 0x206F, "mark of the direction of text"},
    {0x2800, 0x2800, "blank pattern of Braille", true},
    {0x3000, 0x3000, "ideographic space", true},
    {0x3164, 0x3164, "Hangul filler"},
    {0xFE00, 0xFE0F, "variation selector"},
    {0xFEFF, 0xFEFF, "byte order mark"},
    {0xFFA0, 0xFFA0, "Hangul filler"},
    {0xFFF9, 0xFFFB, "annotation mark"},
    {0xE0000, 0xE01EF, "tag"},
};

struct Lookalike {
    std::string_view characters;  // in the order of `meant`
    std::string_view meant;       // a byte each, or one for all
    std::string_view kind;
};

constexpr Lookalike lookalikes[] = {
    {"‐‑‒–—―−﹣⁃", "-", "a dash or minus sign"},
    {"×⋅·∗•✕", "*", "a sign of multiplication"},
    {"÷∕⁄", "/", "a sign of division"},
    {"∼˜～", "~", "a tilde"},
    {"ˆ⋀", "^", "a sign of 'and'"},
    {"∣│❘⋁", "|", "a bar"},
    {"′‘’‛ʹʼ`´", "'", "an apostrophe or quotation mark"},
    {"‚", ",", "a quotation mark"},
    {"\xCD\xBE", ";", "a Greek question mark"},
    {"∶ː", ":", "a colon"},
    {"‹〈⟨", "<", "a bracket"},
    {"›〉⟩", ">", "a bracket"},
    {"аеорсухіѕјԁһԛԝАВЕКМНОРСТУХІЅЈ", "aeopcyxisjdhqwABEKMHOPCTYXISJ", "a Cyrillic letter"},
    {"αονικρυΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "aovikpuABEZHIKMNOPTYX", "a Greek letter"},
};

const Invisible* find_invisible(std::int32_t code_point) {
    const auto* found = std::ranges::find_if(invisibles, [&](const Invisible& each) {
        return each.first <= code_point && code_point <= each.last;
    });
    return found == std::end(invisibles) ? nullptr : found;
}

std::string code_of(std::int32_t code_point) {
    return fmt::format("U+{:04X}", code_point);
}

template <class Visit>
void for_each_character(std::string_view text, Visit visit) {
    while (!text.empty()) {
        const Character character = first_character(text);
        visit(character);
        text.remove_prefix(character.bytes.size());
    }
}

struct Meant {
    char character;
    std::string_view kind;
};

std::optional<Meant> meant_by(const Character& character) {
    // Full-width forms are in the order of ASCII.
    if (character.code_point >= 0xFF01 && character.code_point <= 0xFF5E)
        return Meant{static_cast<char>(character.code_point - 0xFF01 + '!'),
                     "a full-width character"};
    for (const Lookalike& row : lookalikes) {
        std::optional<Meant> meant;
        std::size_t index = 0;
        for_each_character(row.characters, [&](const Character& each) {
            if (each.bytes == character.bytes)
                meant = Meant{row.meant[std::min(index, row.meant.size() - 1)], row.kind};
            ++index;
        });
        if (meant) return meant;
    }
    return std::nullopt;
}

}  // namespace

std::string spoken(std::string_view characters) {
    constexpr std::size_t most_named = 3;
    std::vector<std::string> names;
    for_each_character(characters, [&](const Character& character) {
        const Invisible* invisible = find_invisible(character.code_point);
        if (!invisible) return;
        const std::string name =
            fmt::format("{} ({})", code_of(character.code_point), invisible->name);
        if (std::ranges::find(names, name) == names.end() && names.size() < most_named)
            names.push_back(name);
    });
    if (names.empty()) return fmt::format("'{}'", characters);
    return fmt::format("the invisible {}", fmt::join(names, ", "));
}

Hint hint_for_lookalike(std::string_view characters, Span place) {
    std::string hint, replaced;
    bool all_known = true;
    for_each_character(characters, [&](const Character& character) {
        std::string words;
        if (const Invisible* invisible = find_invisible(character.code_point)) {
            words = invisible->is_blank ? "replace it by an ordinary blank" : "remove it";
            replaced += invisible->is_blank ? " " : "";
        } else if (const auto meant = meant_by(character)) {
            words = fmt::format("this is {}, {}; write '{}'", code_of(character.code_point),
                                meant->kind, meant->character);
            replaced += meant->character;
        }
        all_known = all_known && !words.empty();
        if (hint.empty()) hint = words;
    });
    if (!all_known || hint.empty()) return hint;
    return {hint, {{place, replaced}}};
}

}  // namespace rddlc
