#include "support/number_word.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace rddlc {

namespace {

template <class Number>
bool reads_as(std::string_view word, Number& value) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc{} && end == word.data() + word.size();
}

// 1e6 is an int as well; beyond 2^53 a double is not.
template <class Number>
bool reads_as_number(std::string_view word, Number& value) {
    if (reads_as(word, value)) return true;
    if constexpr (std::is_integral_v<Number>) {
        double real = 0;
        if (!reads_as(word, real) || std::trunc(real) != real || std::abs(real) >= 0x1p53)
            return false;
        if (!std::in_range<Number>(static_cast<std::int64_t>(real))) return false;
        value = static_cast<Number>(real);
        return true;
    }
    return false;
}

// The largest ints are not written out.
template <class Number>
std::string text_of_bound(Number most) {
    if (std::is_integral_v<Number> && most == std::numeric_limits<Number>::max())
        return fmt::format("2^{} - 1", std::numeric_limits<Number>::digits);
    return fmt::format("{}", most);
}

bool is_of_digits(std::string_view word) {
    return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

template <class Number>
std::optional<Number> number_in_word(std::string_view word, Number least, Number most) {
    Number value{};
    if (reads_as_number(word, value) && value >= least && value <= most) return value;
    return std::nullopt;
}

template <class Number>
std::string no_number_in_word(std::string_view word, Number least, Number most) {
    if (std::is_integral_v<Number> && most == std::numeric_limits<Number>::max() && least >= 0 &&
        least <= 1 && !is_of_digits(word))
        return fmt::format("'{}' is not {}", word,
                           least == 0 ? "an int from 0 on" : "a positive int");
    return fmt::format("'{}' is not {} from {} to {}", word,
                       std::is_integral_v<Number> ? "an int" : "a number", least,
                       text_of_bound(most));
}

template std::optional<int> number_in_word(std::string_view, int, int);
template std::optional<std::int64_t> number_in_word(std::string_view, std::int64_t, std::int64_t);
template std::optional<std::uint64_t> number_in_word(std::string_view, std::uint64_t,
                                                     std::uint64_t);
template std::optional<double> number_in_word(std::string_view, double, double);
template std::string no_number_in_word(std::string_view, int, int);
template std::string no_number_in_word(std::string_view, std::int64_t, std::int64_t);
template std::string no_number_in_word(std::string_view, std::uint64_t, std::uint64_t);
template std::string no_number_in_word(std::string_view, double, double);

}  // namespace rddlc
