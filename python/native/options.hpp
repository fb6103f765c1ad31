// Options of learners that Python gives by their keywords.
#pragma once

#include "native/paths.hpp"
#include "native/problem.hpp"
#include "solvers/options/options.hpp"

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rddlc::python {

// A value as a command line would have it: True is "on" of options that have it, and no number.
inline std::string word_of(nanobind::handle value, const solvers::OptionText& option) {
    const bool is_switch = std::ranges::find(option.choices, "on") != option.choices.end();
    if (is_switch && PyBool_Check(value.ptr())) return value.ptr() == Py_True ? "on" : "off";
    return utf8_text(nanobind::str(value));
}

inline std::vector<std::string> words_of(nanobind::handle value,
                                         const solvers::OptionText& option) {
    const bool is_one =
        nanobind::isinstance<nanobind::str>(value) || !PySequence_Check(value.ptr());
    if (!option.is_list || is_one) return {word_of(value, option)};
    std::vector<std::string> words;
    for (const nanobind::handle each : nanobind::iter(value))
        words.push_back(word_of(each, option));
    return words;
}

// Sets the options of a table that are given, and adds all of them to `known`. Throws Refused, with
// the keyword, for a value that an option does not take.
template <class Options>
void set_options(const solvers::OptionTable<Options>& table, const nanobind::dict& given,
                 Options& options, std::vector<solvers::OptionText>& known) {
    for (const solvers::LearnerOption<Options>& option : table) {
        known.push_back(option);
        if (!given.contains(option.keyword.c_str())) continue;
        const nanobind::object value = given[option.keyword.c_str()];
        try {
            option.set(options, words_of(value, option));
        } catch (const solvers::OptionRefused& refused) {
            throw Refused(fmt::format("{}: {}", option.keyword, refused.what()));
        }
    }
}

inline void refuse_unknown(const nanobind::dict& given,
                           const std::vector<solvers::OptionText>& known) {
    for (const auto [name, value] : given) {
        const std::string keyword = utf8_text(name);
        if (std::ranges::find(known, keyword, &solvers::OptionText::keyword) == known.end())
            throw Refused(solvers::unknown_option(keyword, known, solvers::Face::Python));
    }
}

// A line for each option: its keyword, its values and what it is.
template <class Options>
std::string options_help(const solvers::OptionTable<Options>& table) {
    std::string text;
    for (const solvers::LearnerOption<Options>& option : table)
        text += fmt::format("    {}: {}\n", option.keyword, option.help);
    return text;
}

}  // namespace rddlc::python
