#include "check/context.hpp"

#include "support/suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc::checking {

std::optional<std::string> name_meant(const Context& context, std::string_view name,
                                      const Candidates& candidates) {
    constexpr std::size_t enough_errors = 50;
    if (context.diagnostics.error_count() >= enough_errors) return std::nullopt;
    std::vector<std::string> names = candidates();
    std::ranges::sort(names);
    return did_you_mean(name, names);
}

Hint suggestion(const Context& context, std::string_view name, Span place,
                const Candidates& candidates) {
    return hint_of_name(name_meant(context, name, candidates), place);
}

std::string counted(std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string joined(const std::vector<std::string>& words, std::string_view last) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? fmt::format(" {} ", last) : ", ";
        text += words[i];
    }
    return text;
}

std::string with_article(Role role) {
    const std::string_view name = name_of(role);
    const bool vowel = std::string_view("aeiou").find(name.front()) != std::string_view::npos;
    return fmt::format("{} {}", vowel ? "an" : "a", name);
}

std::optional<Span> mark_behind(Span name, char mark, const Context& context) {
    const std::string& text = context.sources[name.file].text();
    const std::size_t at = text.find_first_not_of(" \t\r\n", name.end);
    if (at == text.npos || text[at] != mark) return std::nullopt;
    const auto begin = static_cast<std::uint32_t>(at);
    return Span{name.file, begin, begin + 1};
}

std::vector<Replacement> other_brackets(Span name, Span whole, std::string_view brackets,
                                        const Context& context) {
    const auto open = mark_behind(name, brackets == "[]" ? '(' : '[', context);
    if (!open) return {};
    return {{*open, std::string(1, brackets[0])},
            {last_character(whole), std::string(1, brackets[1])}};
}

std::string written_name(const model::Fluent& fluent, bool next) {
    return fluent.name + (next ? "'" : "");
}

}  // namespace rddlc::checking
