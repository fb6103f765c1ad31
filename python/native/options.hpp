// Options of learners that Python gives by their keywords.
#pragma once

#include "native/problem.hpp"
#include "solvers/options/options.hpp"

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rddlc::python {

// A value as a command line would have it.
inline std::string word_of(nanobind::handle value) {
    if (PyBool_Check(value.ptr())) return value.ptr() == Py_True ? "on" : "off";
    return nanobind::str(value).c_str();
}

inline std::vector<std::string> words_of(nanobind::handle value, bool is_list) {
    const bool is_one =
        nanobind::isinstance<nanobind::str>(value) || !PySequence_Check(value.ptr());
    if (!is_list || is_one) return {word_of(value)};
    std::vector<std::string> words;
    for (const nanobind::handle each : nanobind::iter(value)) words.push_back(word_of(each));
    return words;
}

// Throws Refused, with the keyword, where one is not known, or has a value that it does not take.
template <class Options>
void set_options(const solvers::OptionTable<Options>& table, const nanobind::dict& given,
                 Options& options) {
    std::vector<std::string> known;
    for (const solvers::LearnerOption<Options>& option : table) {
        known.push_back(option.keyword);
        if (!given.contains(option.keyword.c_str())) continue;
        const nanobind::object value = given[option.keyword.c_str()];
        try {
            option.set(options, words_of(value, option.is_list));
        } catch (const solvers::OptionRefused& refused) {
            throw Refused(fmt::format("{}: {}", option.keyword, refused.what()));
        }
    }
    for (const auto [name, value] : given) {
        const auto keyword = nanobind::cast<std::string>(name);
        if (std::ranges::find(known, keyword) == known.end())
            throw Refused(solvers::unknown_option(keyword, known));
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
