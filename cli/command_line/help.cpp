#include "command_line/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace rddlc::cli {

namespace {

constexpr std::size_t text_column = 28;
constexpr std::size_t page_width = 100;

std::string indented(std::size_t width) {
    return std::string(width, ' ');
}

std::string name_of(const Option& option) {
    std::string name = option.names;
    for (std::size_t at = name.find(','); at != std::string::npos; at = name.find(',', at + 2))
        name.insert(at + 1, " ");
    if (!option.value_name.empty()) name += " " + option.value_name;
    if (option.kind == OptionKind::Argument && option.is_list) name += " ...";
    return name;
}

std::string usage(const Command& command, const std::string& full_name) {
    std::string line = fmt::format("Usage: {} [OPTIONS]", full_name);
    for (const Option& option : command.options)
        if (option.kind == OptionKind::Argument)
            line += option.is_required ? " " + name_of(option) : " [" + name_of(option) + "]";
    return line + (command.commands.empty() ? "\n" : " COMMAND\n");
}

std::string arguments_text(const Command& command) {
    std::string text;
    for (const Option& option : command.options)
        if (option.kind == OptionKind::Argument)
            text += help_entry(name_of(option), option.explanation);
    return text.empty() ? text : "\nArguments:\n" + text;
}

// The options that every command has come last: among the others, or below a title of their own.
std::string options_text(const Command& command, bool is_program) {
    std::vector<Option> listed;
    for (const Option& option : command.options)
        if (option.kind != OptionKind::Argument) listed.push_back(option);
    const bool has_titles = std::any_of(listed.begin(), listed.end(),
                                        [](const Option& option) { return !option.title.empty(); });
    std::vector<Option> common = common_options(is_program);
    if (has_titles) common.front().title = "Other options";
    listed.insert(listed.end(), common.begin(), common.end());
    if (listed.front().title.empty()) listed.front().title = "Options";
    std::string text;
    for (const Option& option : listed) {
        if (!option.title.empty()) text += "\n" + option.title + ":\n";
        text += help_entry(name_of(option), option.explanation);
    }
    return text;
}

std::string commands_text(const Command& command) {
    if (command.commands.empty()) return "";
    std::string text = "\nCommands:\n";
    for (const Command& each : command.commands) text += help_entry(each.name, each.summary);
    return text;
}

}  // namespace

std::string help_entry(const std::string& name, const std::string& explanation) {
    std::string out = "  " + name;
    std::size_t column = out.size();
    if (column + 2 > text_column) {
        out += '\n';
        column = 0;
    }
    out += indented(text_column - column);
    column = text_column;
    std::istringstream words(explanation);
    for (std::string word; words >> word;) {
        if (column > text_column && column + 1 + word.size() > page_width) {
            out += '\n' + indented(text_column);
            column = text_column;
        }
        if (column > text_column) {
            out += ' ';
            ++column;
        }
        out += word;
        column += word.size();
    }
    return out + '\n';
}

std::string help_text(const Command& command, const std::string& full_name) {
    const bool is_program = command.name == full_name;
    std::string text = command.summary + "\n\n" + usage(command, full_name) +
                       commands_text(command) + arguments_text(command) +
                       options_text(command, is_program);
    return command.details.empty() ? text : text + "\n" + command.details + "\n";
}

}  // namespace rddlc::cli
