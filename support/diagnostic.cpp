#include "support/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace rddlc {

std::string to_string(Code code) {
    return fmt::format("{}{:04}", code.letter, code.number);
}

std::optional<Code> parse_code(std::string_view text) {
    const auto is_digit = [](char c) {
        return c >= '0' && c <= '9';
    };
    if (text.size() != 5) return std::nullopt;
    const char letter = text[0] == 'e' ? 'E' : text[0] == 'w' ? 'W' : text[0];
    if (letter != 'E' && letter != 'W') return std::nullopt;
    if (!std::all_of(text.begin() + 1, text.end(), is_digit)) return std::nullopt;
    int number = 0;
    for (const char digit : text.substr(1)) number = number * 10 + (digit - '0');
    return Code{letter, number};
}

Diagnostic&& Diagnostic::note(Span place, std::string text) && {
    notes.push_back({place, std::move(text)});
    return std::move(*this);
}

Diagnostic&& Diagnostic::with_hint(Hint chosen) && {
    hint = std::move(chosen.text);
    fix = std::move(chosen.fix);
    return std::move(*this);
}

Diagnostic&& Diagnostic::fixed_by(Span place, std::string text) && {
    fix.push_back({place, std::move(text)});
    return std::move(*this);
}

void Diagnostics::report(Diagnostic diagnostic) {
    const bool warning = diagnostic.code.letter == 'W';
    const bool silenced =
        options_.all_warnings_disabled || options_.disabled_warnings.contains(diagnostic.code);
    if (warning && silenced) return;
    if (is_error(diagnostic)) ++error_count_;
    diagnostics_.push_back(std::move(diagnostic));
}

bool Diagnostics::is_error(const Diagnostic& diagnostic) const {
    return diagnostic.code.letter == 'E' || options_.warnings_as_errors ||
           options_.codes_as_errors.contains(diagnostic.code);
}

void Diagnostics::sort_by_position() {
    const auto place = [](const Diagnostic& diagnostic) {
        const Span span = diagnostic.span.value_or(Span{});
        return std::tuple(diagnostic.span.has_value(), span.file, span.begin);
    };
    std::stable_sort(diagnostics_.begin(), diagnostics_.end(),
                     [&](const auto& a, const auto& b) { return place(a) < place(b); });
}

namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// Insertions, deletions, substitutions and swaps of neighbours; upper and lower case are the same.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last = std::exchange(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                                 lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

}  // namespace

std::optional<std::string> did_you_mean(std::string_view name,
                                        const std::vector<std::string>& candidates) {
    // Longer names are not compared: the search takes the square of the length.
    constexpr std::size_t longest_name = 100;
    if (name.size() > longest_name) return std::nullopt;
    const std::size_t tolerance = std::max<std::size_t>(1, name.size() / 3);
    std::size_t best_distance = tolerance + 1;
    std::optional<std::string> best;
    for (const std::string& candidate : candidates) {
        const std::size_t longer = std::max(candidate.size(), name.size());
        const std::size_t shorter = std::min(candidate.size(), name.size());
        if (candidate == name || longer - shorter >= best_distance) continue;
        const std::size_t distance = edit_distance(name, candidate);
        // A name that shares nothing with the candidate is not a misspelling of it.
        if (distance < best_distance && distance < longer) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace rddlc
