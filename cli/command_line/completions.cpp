// Completions for shells, made from the options of a program, so that they cannot differ from
// --help.
#include "command_line/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rddlc::cli {

namespace {

// The text with a backslash before each of the characters that a shell would take for its own.
std::string with_escapes(const std::string& text, std::string_view escaped) {
    std::string out;
    for (const char c : text) {
        if (escaped.find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

bool takes_a_value(const Option& option) {
    return option.kind == OptionKind::Value || option.kind == OptionKind::Bytes;
}

const std::vector<std::string>& offered_values(const Option& option) {
    return option.choices.empty() ? option.suggestions : option.choices;
}

// The command's options, and those that are known for every command.
std::vector<Option> options_of(const Command& command, bool is_program) {
    std::vector<Option> options;
    for (const Option& option : command.options)
        if (option.kind != OptionKind::Argument) options.push_back(option);
    const bool has_commands = is_program || !command.commands.empty();
    for (const Option& option : common_options(has_commands)) options.push_back(option);
    return options;
}

std::vector<std::string> names_of(const std::vector<Option>& options) {
    std::vector<std::string> names;
    for (const Option& option : options)
        for (const std::string& name : names_of(option)) names.push_back(name);
    return names;
}

std::vector<std::string> names_of_commands(const Command& command) {
    std::vector<std::string> names;
    for (const Command& inner : command.commands) names.push_back(inner.name);
    return names;
}

std::vector<std::string> first_words(const Command& program) {
    std::vector<std::string> names = names_of_commands(program);
    names.emplace_back("help");
    return names;
}

// The branches of a `case` over the commands, of what a shell does for one of them.
std::string branches(const Command& program, std::string text_of(const Command&, bool is_program,
                                                                 const std::string& margin)) {
    std::string text;
    for (const Command& command : program.commands)
        text += fmt::format("        {})\n{}            ;;\n", command.name,
                            text_of(command, false, "            "));
    return text;
}

// ---------------------------------------------------------------------------------------- bash

// `case` over the word before: the values of an option, otherwise the options. If no offer fits,
// bash completes names of files; so do the others, except for options that have choices.
std::string bash_case(const Command& command, bool is_program, const std::string& margin) {
    const std::vector<Option> options = options_of(command, is_program);
    std::string text = margin + "case $previous in\n";
    std::vector<std::string> others;
    for (const Option& option : options) {
        if (!takes_a_value(option)) continue;
        const std::vector<std::string> names = names_of(option);
        if (offered_values(option).empty())
            others.insert(others.end(), names.begin(), names.end());
        else
            text += fmt::format("{}{}) offered='{}' ;;\n", margin, fmt::join(names, " | "),
                                fmt::join(offered_values(option), " "));
    }
    if (!others.empty()) text += fmt::format("{}{}) ;;\n", margin, fmt::join(others, " | "));
    return text + fmt::format("{0}*) [[ $word == -* ]] && offered='{1}' ;;\n{0}esac\n", margin,
                              fmt::join(names_of(options), " "));
}

// The completions for a command of the program. If it has commands of its own, one of them is the
// next word.
std::string bash_command(const Command& command, bool is_program, const std::string& margin) {
    if (command.commands.empty()) return bash_case(command, is_program, margin);
    std::string text;
    for (const Command& inner : command.commands)
        text += fmt::format("{0}    {1})\n{2}{0}        ;;\n", margin, inner.name,
                            bash_case(inner, false, margin + "        "));
    return fmt::format(
        "{0}if ((COMP_CWORD == 2)); then\n"
        "{0}    offered='{1} {2}'\n"
        "{0}else\n"
        "{0}    case ${{COMP_WORDS[2]}} in\n"
        "{3}"
        "{0}    esac\n"
        "{0}fi\n",
        margin, fmt::join(names_of_commands(command), " "),
        fmt::join(names_of(options_of(command, false)), " "), text);
}

std::string bash_body(const Command& program) {
    if (program.commands.empty()) return bash_case(program, true, "    ");
    return fmt::format(
        "    if ((COMP_CWORD == 1)); then\n"
        "        offered='{0} {1}'\n"
        "    else\n"
        "        case ${{COMP_WORDS[1]}} in\n"
        "        help) offered='{0}' ;;\n"
        "{2}"
        "        *)\n"
        "{3}"
        "            ;;\n"
        "        esac\n"
        "    fi\n",
        fmt::join(first_words(program), " "), fmt::join(names_of(options_of(program, true)), " "),
        branches(program, bash_command), bash_case(program, true, "            "));
}

std::string bash(const Command& program) {
    return fmt::format(
        "# Completions of {0} for bash: source <({0} --completions bash)\n"
        "_{0}() {{\n"
        "    local word=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} "
        "offered=''\n"
        "    # --option=value is three words here.\n"
        "    if [[ $word == = ]]; then\n"
        "        word=''\n"
        "    elif [[ $previous == = ]]; then\n"
        "        previous=${{COMP_WORDS[COMP_CWORD - 2]}}\n"
        "    fi\n"
        "{1}"
        "    COMPREPLY=($(compgen -W \"$offered\" -- \"$word\"))\n"
        "}}\n"
        "complete -o bashdefault -o default -F _{0} {0}\n",
        program.name, bash_body(program));
}

// ----------------------------------------------------------------------------------------- zsh

// The text between single quotes, in a specification of _arguments.
std::string zsh_text(const std::string& text) {
    return replaced(with_escapes(text, "\\[]:"), "'", "'\\''");
}

std::string zsh_values(const Option& option) {
    if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
    if (option.suggestions.empty()) return "_files";
    return fmt::format("{{compadd {}; _files}}", fmt::join(option.suggestions, " "));
}

std::string zsh_option(const Option& option, const std::string& name) {
    if (!takes_a_value(option)) return fmt::format("'{}[{}]'", name, zsh_text(option.explanation));
    const bool is_long = name.starts_with("--");
    return fmt::format("'{}{}{}[{}]:{}:{}'", option.is_list ? "*" : "", name, is_long ? "=" : "",
                       zsh_text(option.explanation), zsh_text(option.value_name),
                       zsh_values(option));
}

std::string zsh_options(const Command& command, bool is_program, const std::string& margin) {
    std::string text;
    for (const Option& option : options_of(command, is_program))
        for (const std::string& name : names_of(option))
            text += fmt::format("{}    {} \\\n", margin, zsh_option(option, name));
    return text;
}

std::string zsh_arguments(const Command& command, bool is_program, const std::string& margin) {
    return fmt::format("{0}_arguments \\\n{1}{0}    '*:file:_files'\n", margin,
                       zsh_options(command, is_program, margin));
}

std::string zsh_command(const Command& command, bool is_program, const std::string& margin) {
    if (command.commands.empty()) return zsh_arguments(command, is_program, margin);
    std::string text;
    for (const Command& inner : command.commands)
        text += fmt::format("{0}{1})\n{2}{0}    ;;\n", margin, inner.name,
                            zsh_arguments(inner, false, margin + "    "));
    return fmt::format(
        "{0}_arguments -C \\\n{1}{0}    '1:command:({2})' '*::argument:->argument'\n"
        "{0}case $words[1] in\n{3}{0}esac\n",
        margin, zsh_options(command, false, margin), fmt::join(names_of_commands(command), " "),
        text);
}

std::string zsh_body(const Command& program) {
    if (program.commands.empty()) return zsh_arguments(program, true, "    ");
    std::string text =
        "    local context state state_descr line\n"
        "    typeset -A opt_args\n"
        "    local -a commands\n"
        "    commands=(\n";
    for (const Command& command : program.commands)
        text += fmt::format("        '{}:{}'\n", command.name, zsh_text(command.summary));
    text +=
        "        'help:Explain a command'\n"
        "    )\n"
        "    _arguments -C \\\n" +
        zsh_options(program, true, "    ") +
        "        '1:command:->command' '*::argument:->argument'\n"
        "    case $state in\n"
        "    command) _describe command commands ;;\n"
        "    argument)\n"
        "        case $words[1] in\n"
        "        help) _describe command commands ;;\n";
    return text + branches(program, zsh_command) + "        esac\n        ;;\n    esac\n";
}

std::string zsh(const Command& program) {
    return fmt::format(
        "#compdef {0}\n"
        "# Completions of {0} for zsh: a file _{0} in a folder of $fpath, or\n"
        "# source <({0} --completions zsh)\n"
        "_{0}() {{\n"
        "{1}"
        "}}\n"
        "if [[ $funcstack[1] == _{0} ]]; then _{0} \"$@\"; else compdef _{0} {0}; fi\n",
        program.name, zsh_body(program));
}

// ---------------------------------------------------------------------------------------- fish

std::string fish_text(const std::string& text) {
    return "'" + with_escapes(text, "\\'") + "'";
}

// -s x, -l long, or -o old, as compilers write long options with one dash.
std::string fish_name(const std::string& name) {
    if (name.starts_with("--")) return "-l " + name.substr(2);
    return fmt::format("-{} {}", name.size() == 2 ? 's' : 'o', name.substr(1));
}

std::string fish_option(const std::string& start, const Option& option) {
    std::string line = start;
    for (const std::string& name : names_of(option)) line += " " + fish_name(name);
    if (takes_a_value(option)) line += option.choices.empty() ? " -r" : " -x";
    if (const std::vector<std::string>& values = offered_values(option); !values.empty())
        line += fmt::format(" -a '{}'", fmt::join(values, " "));
    return line + fmt::format(" -d {}\n", fish_text(option.explanation));
}

// The condition that the words so far name the command, and what it takes.
std::string fish_options(const std::string& start, const std::string& condition,
                         const Command& command) {
    std::string text;
    for (const Option& option : options_of(command, false))
        text += fish_option(fmt::format("{} -n '{}'", start, condition), option);
    return text;
}

std::string fish_command(const std::string& start, const Command& command) {
    const std::string named = "__fish_seen_subcommand_from " + command.name;
    if (command.commands.empty()) return fish_options(start, named, command);
    const std::string unnamed = fmt::format("{}; and not __fish_seen_subcommand_from {}", named,
                                            fmt::join(names_of_commands(command), " "));
    std::string text = fish_options(start, unnamed, command);
    for (const Command& inner : command.commands) {
        text += fmt::format("{} -n '{}' -f -a {} -d {}\n", start, unnamed, inner.name,
                            fish_text(inner.summary));
        text += fish_options(
            start, fmt::format("{}; and __fish_seen_subcommand_from {}", named, inner.name), inner);
    }
    return text;
}

std::string fish(const Command& program) {
    std::string text = fmt::format(
        "# Completions of {0} for fish: {0} --completions fish | source\n", program.name);
    const std::string start = "complete -c " + program.name;
    const bool has_commands = !program.commands.empty();
    for (const Option& option : options_of(program, true))
        text += fish_option(start + (has_commands ? " -n __fish_use_subcommand" : ""), option);
    for (const Command& command : program.commands) {
        text += fmt::format("{} -n __fish_use_subcommand -f -a {} -d {}\n", start, command.name,
                            fish_text(command.summary));
        text += fish_command(start, command);
    }
    return text;
}

}  // namespace

std::string completions(const Command& program, const std::string& shell) {
    if (shell == "bash") return bash(program);
    if (shell == "zsh") return zsh(program);
    if (shell == "fish") return fish(program);
    throw UsageError(fmt::format("--completions: '{}' is not a known shell", shell));
}

}  // namespace rddlc::cli
