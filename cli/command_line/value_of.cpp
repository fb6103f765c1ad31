#include "command_line/value_of.hpp"

#include "support/diagnostic.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace rddlc::cli {

namespace {

// 2^10 bytes, 2^20, ...: the power's tenth, for a unit such as "", "b", "M", "mb" or "MiB".
std::optional<int> power_of(std::string_view unit) {
    constexpr std::string_view letters = "kmgtpe";
    std::string lower(unit);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    if (lower.empty() || lower == "b") return 0;
    const std::size_t power = letters.find(lower[0]);
    const std::string_view rest = std::string_view(lower).substr(1);
    const bool is_known = rest.empty() || rest == "b" || rest == "ib";
    if (power == letters.npos || !is_known) return std::nullopt;
    return static_cast<int>(power) + 1;
}

// The number at the beginning of a word, and the unit behind it.
template <class Number>
std::optional<std::pair<Number, int>> number_and_power(std::string_view word) {
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{}) return std::nullopt;
    std::string_view unit = word.substr(static_cast<std::size_t>(end - word.data()));
    while (unit.starts_with(' ')) unit.remove_prefix(1);
    const auto power = power_of(unit);
    if (!power) return std::nullopt;
    return std::pair{number, *power};
}

// 4G, 1.5G, 1e9 and the like; at least one byte.
std::optional<std::int64_t> read_bytes(std::string_view word) {
    if (const auto whole = number_and_power<std::int64_t>(word)) {
        const auto [number, power] = *whole;
        if (number < 1 || number > std::numeric_limits<std::int64_t>::max() >> 10 * power)
            return std::nullopt;
        return number << 10 * power;
    }
    const auto real = number_and_power<double>(word);
    if (!real) return std::nullopt;
    const double bytes = std::ldexp(real->first, 10 * real->second);
    if (!(bytes >= 1 && bytes < 0x1p63)) return std::nullopt;
    return static_cast<std::int64_t>(bytes);
}

void require_choice(const Option& option, const std::string& word) {
    if (option.choices.empty() || std::ranges::find(option.choices, word) != option.choices.end())
        return;
    const auto near = did_you_mean(word, option.choices);
    throw UsageError(fmt::format("{}: '{}' is not one of {}{}", option.names, word,
                                 fmt::join(option.choices, ", "), ending_with_name(near)));
}

}  // namespace

std::string value_of(const Option& option, const std::string& word) {
    const bool is_value = option.kind == OptionKind::Value || option.kind == OptionKind::Bytes;
    if (is_value && !option.is_list && word.empty()) throw no_value_for(option);
    require_choice(option, word);
    if (option.kind != OptionKind::Bytes) return word;
    const auto bytes = read_bytes(word);
    if (!bytes)
        throw UsageError(
            fmt::format("{}: '{}' is not a size, such as 512M, 4G or a number of bytes from 1 on",
                        option.names, word));
    return std::to_string(*bytes);
}

UsageError no_value_for(const Option& option) {
    if (option.kind == OptionKind::Flag) return UsageError(option.names + " is given no value");
    return UsageError(fmt::format("{0} is given no value; expected {0} {1}: {2}", option.names,
                                  option.value_name, option.explanation));
}

UsageError no_value_for(const Option& option, const std::string& list) {
    if (list.empty()) return no_value_for(option);
    return UsageError(fmt::format("{0}: a value is missing in '{1}'; expected {0} {2}: {3}",
                                  option.names, list, option.value_name, option.explanation));
}

}  // namespace rddlc::cli
