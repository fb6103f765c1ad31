#include "command_line/command_line.hpp"
#include "support/number_word.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace rddlc::cli {

namespace {

Option& add(Command& command, OptionKind kind, const std::string& names,
            const std::string& value_name, const std::string& explanation,
            std::function<void(const std::string&)> take) {
    Option option;
    option.kind = kind;
    option.names = names;
    option.value_name = value_name;
    option.explanation = explanation;
    option.take = std::move(take);
    return command.options.emplace_back(std::move(option));
}

}  // namespace

std::vector<std::string> names_of(const Option& option) {
    std::vector<std::string> names;
    std::istringstream stream(option.names);
    for (std::string name; std::getline(stream, name, ',');) names.push_back(name);
    return names;
}

std::vector<Option> common_options(bool is_program) {
    Command command;
    const auto nothing = [](const std::string&) {
    };
    add_flag(command, "-h,--help", "Show the help", nothing);
    if (!is_program) return command.options;
    add_flag(command, "--version", "Show the version", nothing);
    add_option(command, "--completions", "SHELL", "Print what bash, zsh or fish completes", nothing)
        .choices = {"bash", "zsh", "fish"};
    add_flag(command, "--man-page", "Print the manual page", nothing);
    return command.options;
}

void add_title(Command& command, const std::string& name, const std::string& title) {
    for (Option& option : command.options)
        for (const std::string& each : names_of(option))
            if (each == name) {
                option.title = title;
                return;
            }
    throw std::logic_error("there is no option " + name + " to stand below '" + title + "'");
}

Option& add_argument(Command& command, const std::string& name, const std::string& explanation,
                     std::function<void(const std::string&)> take) {
    return add(command, OptionKind::Argument, name, "", explanation, std::move(take));
}

Option& add_option(Command& command, const std::string& names, const std::string& value_name,
                   const std::string& explanation, std::function<void(const std::string&)> take) {
    return add(command, OptionKind::Value, names, value_name, explanation, std::move(take));
}

Option& add_list_option(Command& command, const std::string& names, const std::string& value_name,
                        const std::string& explanation,
                        std::function<void(const std::string&)> take) {
    Option& option = add_option(command, names, value_name, explanation, std::move(take));
    option.is_list = option.has_commas = true;
    return option;
}

Option& add_flag(Command& command, const std::string& names, const std::string& explanation,
                 std::function<void(const std::string&)> take) {
    return add(command, OptionKind::Flag, names, "", explanation, std::move(take));
}

Option& add_argument(Command& command, const std::string& name, const std::string& explanation,
                     std::string& target) {
    return add_argument(command, name, explanation,
                        [&target](const std::string& value) { target = value; });
}

Option& add_flag(Command& command, const std::string& names, const std::string& explanation,
                 bool& target) {
    return add_flag(command, names, explanation, [names, &target](const std::string& word) {
        if (word != "true" && word != "false")
            throw UsageError(fmt::format("{}: '{}' is not true or false", names, word));
        target = word == "true";
    });
}

template <class Number>
Number number_of(const std::string& option, const std::string& word, Number least, Number most) {
    if (const auto value = number_in_word<Number>(word, least, most)) return *value;
    throw UsageError(fmt::format("{}: {}", option, no_number_in_word<Number>(word, least, most)));
}
template int number_of(const std::string&, const std::string&, int, int);
template std::int64_t number_of(const std::string&, const std::string&, std::int64_t, std::int64_t);
template std::uint64_t number_of(const std::string&, const std::string&, std::uint64_t,
                                 std::uint64_t);
template double number_of(const std::string&, const std::string&, double, double);

}  // namespace rddlc::cli
