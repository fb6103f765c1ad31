#include "command_line/command_line.hpp"
#include "command_line/value_of.hpp"
#include "support/diagnostic.hpp"
#include "support/option_names.hpp"
#include "support/program.hpp"
#include "support/suggestion.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <span>
#include <sstream>

namespace rddlc::cli {

namespace {

// Compilers write long options with one dash, such as -MD; CLI11 wants two.
bool has_one_dash(const std::string& name) {
    return name.size() > 2 && name[0] == '-' && name[1] != '-';
}

std::string respelled_names(const Option& option) {
    std::string all;
    for (const std::string& name : names_of(option))
        all += fmt::format("{}{}{}", all.empty() ? "" : ",", has_one_dash(name) ? "-" : "", name);
    return all;
}

// -MD, and -MFfile as much as -MF file.
std::string respelled_word(const Command& command, const std::string& word) {
    for (const Option& option : command.options)
        for (const std::string& name : names_of(option)) {
            if (!has_one_dash(name) || !word.starts_with(name)) continue;
            if (word.size() == name.size()) return "-" + word;
            if (option.kind != OptionKind::Flag) return "-" + name + "=" + word.substr(name.size());
        }
    return word;
}

// The words that were given for an option. CLI11 splits them; their meaning is found here, so that
// all complaints have one form.
struct Answer {
    const Option* option;
    CLI::Option* handle;

    void pass_on() const {
        const std::vector<std::string>& words = handle->results();
        if (words.empty()) return;
        if (option->kind == OptionKind::Flag) return option->take(words.back());
        if (!option->is_list && words.size() > 1)
            throw UsageError(
                fmt::format("{} is given twice: '{}' and '{}'", option->names, words[0], words[1]));
        for (const std::string& word : words) {
            if (option->has_commas)
                pass_on_parts(word);
            else
                option->take(value_of(*option, word));
        }
    }

    void pass_on_parts(const std::string& word) const {
        for (std::size_t begin = 0; begin <= word.size();) {
            const std::size_t end = std::min(word.find(',', begin), word.size());
            if (end == begin) throw no_value_for(*option, word);
            option->take(value_of(*option, word.substr(begin, end - begin)));
            begin = end + 1;
        }
    }
};

// A command as CLI11 sees it.
struct Declared {
    const Command* command;
    CLI::App* app;
    std::vector<Answer> answers;
};

void declare(Declared& declared, const Option& option) {
    const std::string names = respelled_names(option);
    const bool is_flag = option.kind == OptionKind::Flag;
    CLI::Option* const handle =
        is_flag ? declared.app->add_flag(names) : declared.app->add_option(names);
    handle->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    if (option.kind == OptionKind::Argument && option.is_list) handle->expected(-1);
    declared.answers.push_back({&option, handle});
}

void declare(Declared& declared) {
    for (const Option& option : declared.command->options) declare(declared, option);
}

std::string did_you_mean_text(const std::string& name, const std::vector<std::string>& known) {
    return ending_with_name(did_you_mean(name, known));
}

std::vector<KnownOption> known_options(const Command& command) {
    std::vector<KnownOption> known;
    for (const auto& options : {common_options(!command.commands.empty()), command.options})
        for (const Option& option : options)
            if (option.kind != OptionKind::Argument)
                for (const std::string& name : names_of(option))
                    known.push_back({name, option.elsewhere});
    return known;
}

std::vector<std::string> command_names(const Command& program) {
    std::vector<std::string> names;
    for (const Command& command : program.commands) names.push_back(command.name);
    names.emplace_back("help");
    return names;
}

// A handful of commands are listed, if no similar name exists.
std::string unknown_command(const std::string& name, const Command& program) {
    constexpr std::size_t handful = 4;
    std::string end = did_you_mean_text(name, command_names(program));
    if (end.empty() && program.commands.size() <= handful) {
        std::vector<std::string> names;
        for (const Command& command : program.commands) names.push_back(command.name);
        end = fmt::format("; '{}' has {}", program.name, fmt::join(names, " and "));
    }
    return fmt::format("no command is called '{}'{}", name, end);
}

const Option* option_named(const Command& command, const std::string& name) {
    for (const Option& option : command.options)
        for (const std::string& each : names_of(option))
            if (option.kind != OptionKind::Argument && each == name) return &option;
    return nullptr;
}

// The word may belong to the list before it, as in `--policies noop random`.
std::string too_many_arguments(const std::string& extra, std::span<char* const> words,
                               const Command* chosen) {
    const auto at = std::ranges::find(words, extra, [](const char* word) { return word; });
    const auto place = static_cast<std::size_t>(at - words.begin());
    const Option* const before = chosen && place >= 2 && place < words.size()
                                     ? option_named(*chosen, words[place - 2])
                                     : nullptr;
    return fmt::format(
        "too many arguments: '{}'{}", extra,
        before && before->kind != OptionKind::Flag
            ? fmt::format("; {} takes one word, with commas and without blanks", words[place - 2])
            : "");
}

// A helpful message for words that CLI11 does not take.
std::string message_of(const CLI::ParseError& error, const std::vector<std::string>& left,
                       std::span<char* const> words, const Command& program,
                       const Command* chosen) {
    const auto is_option = [](const std::string& word) {
        return word.starts_with('-');
    };
    if (!chosen && !left.empty() && !is_option(left.front()))
        return unknown_command(left.front(), program);
    const auto unknown = std::find_if(left.begin(), left.end(), is_option);
    if (unknown != left.end()) {
        const std::string name = unknown->substr(0, unknown->find('='));
        return fmt::format("unknown option '{}'{}", name,
                           option_meant_text(name, known_options(chosen ? *chosen : program)));
    }
    if (!left.empty()) return too_many_arguments(left.front(), words, chosen);
    return error.what();
}

bool was_given(const Answer& answer) {
    return answer.handle->count() > 0;
}

bool has_enough(const Declared& declared) {
    return std::ranges::any_of(declared.answers, [](const Answer& answer) {
        return answer.option->is_enough && was_given(answer);
    });
}

// Is not left to CLI11, which knows no options that are enough.
void require_arguments(const Declared& declared) {
    if (has_enough(declared)) return;
    for (const Answer& answer : declared.answers)
        if (answer.option->is_required && !was_given(answer))
            throw UsageError(answer.option->names + " is required");
}

// A program that has commands is run itself if it has enough arguments.
void require_command(const Declared& program, const Declared* chosen) {
    if (chosen || has_enough(program)) return;
    throw UsageError(fmt::format("name a command, such as '{} {}'", program.command->name,
                                 program.command->commands.front().name));
}

// The one that the words name, or else the program.
const Command& command_in(const Command& program, std::span<char* const> words) {
    if (words.empty()) return program;
    const auto found = std::ranges::find(program.commands, words.front(), &Command::name);
    return found == program.commands.end() ? program : *found;
}

// `--trace=$FILE` without a FILE would take the next word for its value, and the last word would
// have no value.
void require_values(const Command& command, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        if (!word.ends_with('=')) continue;
        const Option* const option = option_named(command, word.substr(0, word.size() - 1));
        if (option) throw no_value_for(*option);
    }
    const Option* const last = words.empty() ? nullptr : option_named(command, words.back());
    if (last && last->kind != OptionKind::Flag) throw no_value_for(*last);
}

// `help run` is `run --help`, as -h is; CLI11 takes the words from the back.
std::vector<std::string> words_of(const Command& program, std::span<char* const> given) {
    std::vector<std::string> words(given.begin(), given.end());
    require_values(command_in(program, given), words);
    for (std::string& word : words) word = respelled_word(program, word);
    if (!program.commands.empty() && !words.empty() && words.front() == "help") {
        words.erase(words.begin());
        const bool names_one = !words.empty() && !words.front().starts_with('-');
        if (names_one && &command_in(program, given.subspan(1)) == &program)
            throw UsageError(unknown_command(words.front(), program));
        words.push_back("--help");
    }
    std::ranges::reverse(words);
    return words;
}

Option completions_option() {
    for (Option& option : common_options(true))
        if (option.names == "--completions") return option;
    throw std::logic_error("no program has --completions");
}

// The page that --completions and --man-page ask for.
std::optional<std::string> page_asked_for(const Command& program, const std::string& version,
                                          int argc, char** argv) {
    const std::string word = argc > 1 ? argv[1] : "";
    if (word == "--man-page") return man_page(program, version);
    const bool has_equals = word.starts_with("--completions=");
    if (word != "--completions" && !has_equals) return std::nullopt;
    const std::string next = argc > 2 ? argv[2] : "";
    return completions(program,
                       value_of(completions_option(), has_equals ? word.substr(14) : next));
}

ExitStatus run_declared(const Declared& declared) {
    require_arguments(declared);
    for (const Answer& answer : declared.answers) answer.pass_on();
    return declared.command->run();
}

// `rddl train ppo ...`, or `rddl help train ppo`: a command with commands of its own is a program
// by itself. Returns nothing if the words name no such command.
std::optional<ExitStatus> run_inner_program(const Command& program, const std::string& version,
                                            int argc, char** argv) {
    const bool helps = argc > 2 && std::string_view(argv[1]) == "help";
    const std::span<char* const> words(argv + 1, static_cast<std::size_t>(std::max(argc - 1, 0)));
    const Command& found = command_in(program, words.subspan(helps ? 1 : 0));
    if (&found == &program || found.commands.empty()) return std::nullopt;
    Command inner = found;
    inner.name = program.name + " " + found.name;
    std::vector<char*> rest(argv + 1, argv + argc);
    if (helps) std::swap(rest[0], rest[1]);
    if (helps && rest.size() == 2) rest[1] = const_cast<char*>("--help");
    return run_command_line(inner, version, static_cast<int>(rest.size()), rest.data());
}

}  // namespace

ExitStatus run_command_line(const Command& program, const std::string& version, int argc,
                            char** argv) {
    if (const auto status = run_inner_program(program, version, argc, argv)) return *status;
    CLI::App app("", program.name);
    app.set_version_flag("--version", "");
    std::deque<Declared> all;
    declare(all.emplace_back(Declared{&program, &app, {}}));
    for (const Command& command : program.commands)
        declare(all.emplace_back(Declared{&command, app.add_subcommand(command.name), {}}));
    app.require_subcommand(0, 1);

    const auto chosen = [&]() -> const Declared* {
        if (program.commands.empty()) return &all.front();
        for (const Declared& declared : all)
            if (declared.app != &app && declared.app->parsed()) return &declared;
        return nullptr;
    };
    const std::span<char* const> words(argv + std::min(argc, 1), argv + argc);
    const auto full_name = [&] {
        const Declared* const known = chosen();
        const Command& command = known ? *known->command : command_in(program, words);
        return &command == &program ? program.name : program.name + " " + command.name;
    };
    const auto complain = [&](const std::string& message) {
        tell("{}: error: {}\n'{} --help' shows the usage\n", program.name, message, full_name());
        return usage_error;
    };
    try {
        if (const auto page = page_asked_for(program, version, argc, argv)) {
            print("{}", *page);
            return success;
        }
        app.parse(words_of(program, words));
        const Declared* const command = chosen();
        require_command(all.front(), command);
        return run_declared(has_enough(all.front()) ? all.front() : *command);
    } catch (const CLI::CallForHelp&) {
        const Declared* const command = chosen();
        print("{}", help_text(command ? *command->command : program, full_name()));
        return success;
    } catch (const CLI::CallForVersion&) {
        print("{} {}\n", program.name, version);
        return success;
    } catch (const CLI::ParseError& error) {
        const Declared* const command = chosen();
        return complain(message_of(error, app.remaining(true), words, program,
                                   command ? command->command : nullptr));
    } catch (const UsageError& error) {
        return complain(error.what());
    }
}

}  // namespace rddlc::cli
