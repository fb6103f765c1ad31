// Command lines as data: the options and arguments of a program and its subcommands. The parser,
// the help and all other descriptions of options read it. Only parse.cpp sees the library that
// parses.
#pragma once

#include "support/failure.hpp"

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace rddlc::cli {

// The command line does not say what the program needs. what() is a sentence.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

enum class OptionKind {
    Argument,  // identified by its place
    Flag,      // --json; "true" is taken, or what --json=WORD names
    Value,     // --seed 3
    Bytes      // --memory-limit 4G; the number of bytes is taken
};

struct Option {
    OptionKind kind = OptionKind::Value;
    std::string names;        // "-o,--output", or that of an argument: "DOMAIN"
    std::string value_name;   // "FILE"; empty for flags and arguments
    std::string explanation;  // begins with a noun or a verb
    // Where --help begins a new part of the list of options: "Pictures".
    std::string title = {};
    // Is called with each value, in the order of the options; may throw a UsageError.
    std::function<void(const std::string& value)> take;
    std::vector<std::string> choices;      // the only values; empty: any
    std::vector<std::string> suggestions;  // some of any, which shells offer
    std::vector<std::string> elsewhere;    // what other faces and programs call it
    bool is_required = false;
    bool is_list = false;  // an option may be repeated, an argument takes all words that are left
    bool has_commas = false;  // between values of a list
    bool is_enough = false;   // no argument and no command is required beside it
};

struct Command {
    std::string name;
    std::string summary;
    std::string details;  // below the options: what else there is to know, and examples
    std::vector<Option> options;
    std::function<ExitStatus()> run;  // after all values were taken
    // If there are some, one has to be named, unless an option of the program is enough.
    std::vector<Command> commands;
};

// Parses the words and runs the command that they name. Mistakes are reported on standard error,
// with what may have been meant; every command knows --help, --version and `help COMMAND`, and also
// --completions SHELL and --man-page, which print what is below.
ExitStatus run_command_line(const Command& program, const std::string& version, int argc,
                            char** argv);

// A name, and on its right the explanation, in lines that fit the page.
std::string help_entry(const std::string& name, const std::string& explanation);
// "rddl run" is the place of `command` in the program.
std::string help_text(const Command& command, const std::string& full_name);

// The completions for bash, zsh or fish; another shell is a UsageError.
std::string completions(const Command& program, const std::string& shell);

// The manual page in roff.
std::string man_page(const Command& program, const std::string& version);

// The options that every command knows, and those of a program, which run_command_line handles
// itself.
std::vector<Option> common_options(bool is_program);

// "-o" and "--output" of "-o,--output".
std::vector<std::string> names_of(const Option& option);

// Gives a title to the option of this name: --help lists under it the options from this one on, up
// to the next one with a title. A name that the command does not have is a std::logic_error.
void add_title(Command& command, const std::string& name, const std::string& title);

// Adders of the usual kinds. The returned option may be adjusted until the next one is added.
Option& add_argument(Command& command, const std::string& name, const std::string& explanation,
                     std::function<void(const std::string&)> take);
Option& add_option(Command& command, const std::string& names, const std::string& value_name,
                   const std::string& explanation, std::function<void(const std::string&)> take);
Option& add_flag(Command& command, const std::string& names, const std::string& explanation,
                 std::function<void(const std::string&)> take);
// These outlive the command.
Option& add_argument(Command& command, const std::string& name, const std::string& explanation,
                     std::string& target);
Option& add_flag(Command& command, const std::string& names, const std::string& explanation,
                 bool& target);
template <class Text>
Option& add_text_option(Command& command, const std::string& names, const std::string& value_name,
                        const std::string& explanation, Text& target) {
    return add_option(command, names, value_name, explanation,
                      [&target](const std::string& value) { target = value; });
}
template <class Texts>
Option& add_repeated_option(Command& command, const std::string& names,
                            const std::string& value_name, const std::string& explanation,
                            Texts& target) {
    Option& option =
        add_option(command, names, value_name, explanation,
                   [&target](const std::string& value) { target.emplace_back(value); });
    option.is_list = true;
    return option;
}
// Also takes VALUE,VALUE and repeated options.
Option& add_list_option(Command& command, const std::string& names, const std::string& value_name,
                        const std::string& explanation,
                        std::function<void(const std::string&)> take);

// The decimal number that a word is, such as -3, 0.5 or 1e6; a word that is not a number, or lies
// beyond the bounds, is a UsageError.
template <class Number>
Number number_of(const std::string& option, const std::string& word, Number least, Number most);
extern template int number_of(const std::string&, const std::string&, int, int);
extern template std::int64_t number_of(const std::string&, const std::string&, std::int64_t,
                                       std::int64_t);
extern template std::uint64_t number_of(const std::string&, const std::string&, std::uint64_t,
                                        std::uint64_t);
extern template double number_of(const std::string&, const std::string&, double, double);

// An option whose value is such a number; `target` may be a std::optional.
template <class Number, class Target>
Option& add_number_option(Command& command, const std::string& names, const std::string& value_name,
                          const std::string& explanation, Target& target, Number least,
                          Number most) {
    return add_option(command, names, value_name, explanation,
                      [=, &target](const std::string& word) {
                          target = number_of<Number>(names, word, least, most);
                      });
}

}  // namespace rddlc::cli
