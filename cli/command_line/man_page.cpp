// The manual page of a program, made from its options as --help is, in the same parts.
#include "command_line/command_line.hpp"

#include <fmt/format.h>

#include <cctype>

namespace rddlc::cli {

namespace {

// Text as it stands: nothing in it is a request or an escape of roff.
std::string plain(const std::string& text) {
    std::string out;
    bool at_line_start = true;
    for (const char c : text) {
        if (at_line_start && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
        at_line_start = c == '\n';
    }
    return out;
}

std::string bold(const std::string& text) {
    return "\\fB" + plain(text) + "\\fR";
}

std::string italic(const std::string& text) {
    return text.empty() ? "" : "\\fI" + plain(text) + "\\fR";
}

std::string item(const std::string& head, const std::string& text) {
    return ".TP\n" + head + "\n" + plain(text) + "\n";
}

std::string as_it_stands(const std::string& text) {
    return text.empty() ? "" : ".PP\n.nf\n" + plain(text) + "\n.fi\n";
}

std::string head_of(const Option& option) {
    if (option.kind == OptionKind::Argument) return italic(option.names);
    std::string head;
    for (const std::string& name : names_of(option))
        head += (head.empty() ? "" : ", ") + bold(name);
    return option.value_name.empty() ? head : head + " " + italic(option.value_name);
}

std::string synopsis(const Command& command, const std::string& full_name) {
    std::string line = bold(full_name) + " [" + italic("OPTIONS") + "]";
    for (const Option& option : command.options) {
        if (option.kind != OptionKind::Argument) continue;
        const std::string name = italic(option.names) + (option.is_list ? " ..." : "");
        line += option.is_required ? " " + name : " [" + name + "]";
    }
    return line + (command.commands.empty() ? "" : " " + italic("COMMAND")) + "\n";
}

std::string options_text(const std::vector<Option>& options) {
    std::string text;
    for (const Option& option : options) {
        if (!option.title.empty()) text += ".PP\n" + bold(option.title + ":") + "\n";
        text += item(head_of(option), option.explanation);
    }
    return text;
}

std::string command_text(const Command& command, const std::string& program_name) {
    const std::string full_name = program_name + " " + command.name;
    std::string text = ".SS " + plain(full_name) + "\n" + plain(command.summary) + ".\n.PP\n" +
                       synopsis(command, full_name) + options_text(command.options) +
                       as_it_stands(command.details);
    for (const Command& inner : command.commands) text += command_text(inner, full_name);
    return text;
}

}  // namespace

std::string man_page(const Command& program, const std::string& version) {
    const std::string first_line = program.summary.substr(0, program.summary.find('\n'));
    std::string title = program.name;
    for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    std::string text = fmt::format(".TH {} 1 \"\" \"{} {}\"\n", title, program.name, version);
    text += ".SH NAME\n" + program.name + " \\- " +
            plain(first_line.substr(0, first_line.find_last_not_of('.') + 1)) + "\n";
    text += ".SH SYNOPSIS\n" + synopsis(program, program.name);
    text += ".SH DESCRIPTION\n" + plain(program.summary) + "\n" + as_it_stands(program.details);
    text += ".SH OPTIONS\n" + options_text(program.options) + options_text(common_options(true));
    if (!program.commands.empty()) text += ".SH COMMANDS\n";
    for (const Command& command : program.commands) text += command_text(command, program.name);
    return text;
}

}  // namespace rddlc::cli
