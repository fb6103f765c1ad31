// rddl fmt: the canonical layout of RDDL files.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "format/format.hpp"
#include "formats/unified_diff.hpp"
#include "support/files.hpp"
#include "support/program.hpp"
#include "support/render.hpp"
#include "support/utf8.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

namespace rddlc::cli {

namespace {

namespace fs = std::filesystem;

struct FormatOptions {
    std::vector<std::string> files;
    std::string output;
    Standard standard = Standard::PyRddlGym;
    bool check = false;
    bool diff = false;
    bool to_stdout = false;
};

void require_consistent(const FormatOptions& options) {
    const int ways = options.check + options.diff + options.to_stdout + !options.output.empty();
    const bool is_check_with_diff = options.check && options.diff && ways == 2;
    if (ways > 1 && !is_check_with_diff)
        throw Failure("only --check and --diff can be combined; --stdout and -o stand alone", "",
                      usage_error);
    if (!options.output.empty() && options.files.size() != 1)
        throw Failure("-o takes the text of one file", "", usage_error);
}

std::optional<FileId> read(const std::string& path, Sources& sources) {
    if (path != "-") return sources.load(path);
    return sources.add("<stdin>", read_descriptor(STDIN_FILENO, "standard input", largest_text));
}

// A file is read as a whole before it is written.
void rewrite(const std::string& path, const std::string& text) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored))
        throw Failure(fmt::format("'{}' is not a regular file, so it cannot be rewritten", path),
                      "--stdout or -o FILE says where to write the text");
    UsedFiles none;
    write_file(path, text, none);
}

void write_to_other(const std::string& output, const std::string& input, const std::string& text) {
    UsedFiles used;
    used.add(input);
    write_file(output, text, used);
}

struct Formatted {
    const std::string& path;
    const std::string& before;
    const std::string& after;

    bool changes() const { return before != after; }
};

// Writes one file as the options say.
void deliver(const FormatOptions& options, const Formatted& file) {
    if (options.diff)
        print_data(unified_diff(printable_line(file.path), file.before, file.after));
    else if (options.check)
        print(file.changes() ? file.path + "\n" : "");
    else if (!options.output.empty())
        write_to_other(options.output, file.path, file.after);
    else if (options.to_stdout || file.path == "-")
        print_data(file.after);
    else if (file.changes())
        rewrite(file.path, file.after);
}

ExitStatus format_one(const FormatOptions& options, const std::string& path) {
    Sources sources;
    const std::optional<FileId> file = read(path, sources);
    if (!file) {
        tell("rddl: error: cannot read '{}': {}\n", path, std::strerror(errno));
        return diagnosed;
    }
    Diagnostics diagnostics;
    const std::optional<std::string> text =
        format_file(sources, *file, diagnostics, options.standard);
    if (!text) {
        tell_with_codes(render(diagnostics, sources, {.color = tells_in_color()}));
        tell(closing_lines(diagnostics, "rddl"));
        return diagnosed;
    }
    const Formatted formatted{path, sources[*file].text(), *text};
    deliver(options, formatted);
    return options.check && formatted.changes() ? diagnosed : success;
}

ExitStatus format(const FormatOptions& options) {
    require_consistent(options);
    ExitStatus status = success;
    for (const std::string& path : options.files)
        if (format_one(options, path) != success) status = diagnosed;
    return status;
}

}  // namespace

Command fmt_command() {
    const auto options = std::make_shared<FormatOptions>();
    Command command;
    command.name = "fmt";
    command.summary = "Lay out RDDL files, with all their comments";
    command.details =
        "Files are rewritten in place; those that are laid out well are not touched. Only\n"
        "blanks and line breaks change.\n\n"
        "Examples:\n"
        "  rddl fmt domain.rddl instance.rddl\n"
        "  rddl fmt --check *.rddl               list files that would change\n"
        "  rddl fmt --diff domain.rddl\n"
        "  rddl fmt - <old.rddl >new.rddl";
    Option& files =
        add_argument(command, "FILE", "RDDL files; - reads stdin and writes stdout",
                     [options](const std::string& file) { options->files.push_back(file); });
    files.is_required = files.is_list = true;
    add_flag(command, "--check",
             "Change nothing; list files that would change and end with status 1", options->check);
    add_flag(command, "--diff", "Change nothing; show what would change", options->diff);
    add_flag(command, "--stdout", "Write to stdout", options->to_stdout);
    add_text_option(command, "-o,--output", "FILE", "Write to another file", options->output);
    add_standard_option(command, options->standard);
    command.run = [options] {
        return format(*options);
    };
    return command;
}

}  // namespace rddlc::cli
