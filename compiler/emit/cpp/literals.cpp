#include "emit/cpp/literals.hpp"

#include "support/match.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <type_traits>

namespace rddlc::cpp {
namespace {

// The shortest digits that read back exactly.
template <class Real>
std::string shortest(Real value) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return {buffer, end};
}

template <class Real>
std::string non_finite(Real value) {
    const std::string type = std::is_same_v<Real, float> ? "float" : "double";
    const std::string limits = "std::numeric_limits<" + type + ">::";
    if (std::isnan(value)) return limits + "quiet_NaN()";
    return (value < 0 ? "-" : "") + limits + "infinity()";
}

template <class Real>
std::string real(Real value) {
    if (!std::isfinite(value)) return non_finite(value);
    const std::string digits = shortest(value);
    const std::string suffix = std::is_same_v<Real, float> ? "f" : "";
    return digits + (digits.find_first_of(".e") == std::string::npos ? ".0" : "") + suffix;
}

// Below, integers are exact and their digits few.
template <class Real>
constexpr Real exact_integers = std::is_same_v<Real, float> ? 1e7 : 1e9;

// An integer converts implicitly as long as it is exact; -0 would lose its sign.
template <class Real>
std::string real_entry(Real value) {
    const bool is_short_integer =
        value == std::trunc(value) && std::fabs(value) < exact_integers<Real>;
    return is_short_integer && !(value == 0 && std::signbit(value)) ? shortest(value) : real(value);
}

std::string integer(std::int64_t value) {
    // C++ has no literal for it.
    if (value == std::numeric_limits<std::int64_t>::min()) {
        return "std::numeric_limits<std::int64_t>::min()";
    }
    return std::to_string(value);
}

}  // namespace

std::string literal(const ir::Value& value, RealType type) {
    return match(
        value, [](bool v) -> std::string { return v ? "true" : "false"; },
        [](std::int64_t v) { return integer(v); },
        [type](double v) {
            return type == RealType::Float ? real(static_cast<float>(v)) : real(v);
        });
}

std::string table_entry(const ir::Value& value, RealType type) {
    return match(
        value, [](bool v) -> std::string { return v ? "1" : "0"; },
        [](std::int64_t v) { return integer(v); },
        [type](double v) {
            return type == RealType::Float ? real_entry(static_cast<float>(v)) : real_entry(v);
        });
}

std::string literal(std::string_view text) {
    std::string result = "\"";
    for (char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            result += {'\\', c};
        } else if (byte < 0x20 || byte == 0x7f) {
            // Three octal digits: a digit that follows is not read as part of the escape.
            const auto digit = [&](int shift) {
                return static_cast<char>('0' + (byte >> shift & 7));
            };
            result += {'\\', digit(6), digit(3), digit(0)};
        } else {
            result += c;
        }
    }
    return result + '"';
}

std::string comment_text(std::string_view text) {
    std::string result;
    for (char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        result += byte < 0x20 || byte == 0x7f ? ' ' : c;
    }
    while (!result.empty() && (result.back() == ' ' || result.back() == '\\')) result.pop_back();
    return result;
}

}  // namespace rddlc::cpp
