// Numbers as users write them: on command lines, as keywords, in options of learners.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rddlc {

// The decimal number that a word is, such as -3, 0.5 or 1e6, if it lies between the bounds.
template <class Number>
std::optional<Number> number_in_word(std::string_view word, Number least, Number most);
// "'x' is not an int from 1 to 10"
template <class Number>
std::string no_number_in_word(std::string_view word, Number least, Number most);

extern template std::optional<int> number_in_word(std::string_view, int, int);
extern template std::optional<std::int64_t> number_in_word(std::string_view, std::int64_t,
                                                           std::int64_t);
extern template std::optional<std::uint64_t> number_in_word(std::string_view, std::uint64_t,
                                                            std::uint64_t);
extern template std::optional<double> number_in_word(std::string_view, double, double);
extern template std::string no_number_in_word(std::string_view, int, int);
extern template std::string no_number_in_word(std::string_view, std::int64_t, std::int64_t);
extern template std::string no_number_in_word(std::string_view, std::uint64_t, std::uint64_t);
extern template std::string no_number_in_word(std::string_view, double, double);

}  // namespace rddlc
