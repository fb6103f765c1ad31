// The meaning of a command line's word for an option.
#pragma once

#include "command_line/command_line.hpp"

#include <string>

namespace rddlc::cli {

// The argument of Option::take for this word. A word that the option does not take is a UsageError,
// which says what is expected.
std::string value_of(const Option& option, const std::string& word);

// "--seed is given no value; expected --seed S: Seed of all random numbers (0)"
UsageError no_value_for(const Option& option);
// The complaint about a missing value between the commas of a list: "--hidden: a value is missing
// in '64,,'; ..."
UsageError no_value_for(const Option& option, const std::string& list);

}  // namespace rddlc::cli
