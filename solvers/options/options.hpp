// Options of learners: name, value, help, range and member of each stand once, in a table
// (ppo/option_table.cpp, cgp/option_table.cpp). Command lines, keywords of Python, programs of
// rddl_add_solver and the settings of runs are all made from it.
#pragma once

#include "support/failure.hpp"
#include "support/memory.hpp"
#include "support/number_word.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace rddlc::solvers {

// An option is given what it does not take. what() is a sentence about it, without its name.
struct OptionRefused : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The texts of an option that users see.
struct OptionText {
    std::string name;     // "--lr", of command lines
    std::string keyword;  // "learning_rate", of Python
    std::string value;    // "RATE"; "" for a flag
    std::string help;
    // Its names in Stable-Baselines3 and RLlib: an unknown option of such a name means this one.
    std::vector<std::string> elsewhere = {};
    bool is_setting = true;                 // a resumed run has the same
    bool is_list = false;                   // of words with commas between them
    std::vector<std::string> choices = {};  // the only words; empty: others
};

template <class Options>
struct LearnerOption : OptionText {
    // Sets the option from the words of its value: one, unless it is a list. Throws an
    // OptionRefused, and has changed nothing then.
    std::function<void(Options&, const std::vector<std::string>&)> set;
    // The value as `set` takes it; "auto": the learner chooses it.
    std::function<std::string(const Options&)> text;
};

template <class Options>
using OptionTable = std::vector<LearnerOption<Options>>;

inline constexpr const char* chosen_by_learner = "auto";

// ------------------------------------------------------------------ the usual kinds of options
//
// `member` gives a reference to the member of options, constant or not.

template <class Number>
Number number_of_option(const std::string& word, Number least, Number most) {
    if (const auto number = number_in_word<Number>(word, least, most)) return *number;
    throw OptionRefused(no_number_in_word<Number>(word, least, most));
}

// The member may be a std::optional: absent is "auto". So is 0, if it is below the range.
template <class Options, class Number, class Member>
LearnerOption<Options> number_option(OptionText text, Member member, Number least, Number most) {
    LearnerOption<Options> option{std::move(text), {}, {}};
    option.set = [=](Options& options, const std::vector<std::string>& words) {
        member(options) = number_of_option<Number>(words.front(), least, most);
    };
    option.text = [=](const Options& options) -> std::string {
        const std::optional<Number> value = member(options);
        const bool is_chosen = !value || (*value == Number{} && Number{} < least);
        return is_chosen ? chosen_by_learner : fmt::format("{}", *value);
    };
    return option;
}

// A number above 0.
template <class Options, class Member>
LearnerOption<Options> positive_option(OptionText text, Member member, double most) {
    LearnerOption<Options> option =
        number_option<Options, double>(std::move(text), member, 0, most);
    option.set = [=, set = option.set](Options& options, const std::vector<std::string>& words) {
        if (number_in_word<double>(words.front(), 0, 0))
            throw OptionRefused(
                fmt::format("'{}' is not a number above 0, up to {}", words.front(), most));
        set(options, words);
    };
    return option;
}

template <class Options, class Choice, class Member>
LearnerOption<Options> choice_option(OptionText text, Member member,
                                     const std::vector<std::pair<std::string, Choice>>& choices) {
    LearnerOption<Options> option{std::move(text), {}, {}};
    for (const auto& [word, choice] : choices) option.choices.push_back(word);
    option.set = [=](Options& options, const std::vector<std::string>& words) {
        for (const auto& [word, choice] : choices) {
            if (word != words.front()) continue;
            member(options) = choice;
            return;
        }
        std::vector<std::string> names;
        for (const auto& [word, choice] : choices) names.push_back(word);
        throw OptionRefused(
            fmt::format("'{}' is not one of {}", words.front(), fmt::join(names, ", ")));
    };
    option.text = [=](const Options& options) -> std::string {
        for (const auto& [word, choice] : choices)
            if (choice == member(options)) return word;
        return chosen_by_learner;
    };
    return option;
}

template <class Options, class Member>
LearnerOption<Options> switch_option(OptionText text, Member member) {
    return choice_option<Options, bool>(std::move(text), member, {{"on", true}, {"off", false}});
}

// The options of all learners, where they are made by a keyword or a program.
template <class Options>
LearnerOption<Options> seed_option() {
    return number_option<Options, std::uint64_t>(
        {"--seed", "seed", "S", "Seed of all random numbers (0)", {"random_state"}},
        [](auto& o) -> auto& { return o.seed; }, 0, std::numeric_limits<std::uint64_t>::max());
}
template <class Options>
LearnerOption<Options> memory_option() {
    return number_option<Options, std::int64_t>(
        {"--memory-limit",
         "memory_limit",
         "BYTES",
         fmt::format("Bytes that the learner may take ({})", default_memory_limit),
         {},
         false},
        [](auto& o) -> auto& { return o.memory_limit; }, 1,
        std::numeric_limits<std::int64_t>::max());
}

// ------------------------------------------------------------------------------ what tables do

// The settings that a resumed run keeps, as "--lr", "0.0003".
template <class Options>
std::vector<std::pair<std::string, std::string>> settings_of(const OptionTable<Options>& table,
                                                             const Options& options) {
    std::vector<std::pair<std::string, std::string>> settings;
    for (const LearnerOption<Options>& option : table)
        if (option.is_setting) settings.emplace_back(option.name, option.text(options));
    return settings;
}

// The words between commas.
std::vector<std::string> words_of_list(const std::string& text);

// Checks options that did not pass a parser. Throws a Failure.
template <class Options>
void require_ranges(const OptionTable<Options>& table, const Options& options) {
    Options copy = options;
    for (const LearnerOption<Options>& option : table) {
        const std::string text = option.text(options);
        if (text == chosen_by_learner) continue;
        try {
            option.set(copy, option.is_list ? words_of_list(text) : std::vector{text});
        } catch (const OptionRefused& refused) {
            throw Failure(fmt::format("{}: {}", option.name, refused.what()), {}, usage_error);
        }
    }
}

// The names by which a face knows its options.
enum class Face { CommandLine, Python };

// "there is no option 'minibach'; did you mean 'minibatch'?"
std::string unknown_option(const std::string& name, const std::vector<OptionText>& known,
                           Face face);

}  // namespace rddlc::solvers
