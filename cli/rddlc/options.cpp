#include "options.hpp"

#include "driver/explain.hpp"
#include "driver/version.hpp"
#include "support/program.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace rddlc::cli {
namespace {

constexpr const char* overview =
    "Compiles an RDDL problem, a domain and an instance, into a simulator in C++.";

constexpr const char* examples =
    "Examples:\n"
    "  rddlc domain.rddl instance.rddl -o sim.cpp    a source file to compile and link\n"
    "  rddlc domain.rddl instance.rddl -o sim.so     a shared object to load\n"
    "  rddlc domain.rddl instance.rddl --check       only look for mistakes\n"
    "  rddlc --explain E0203                         what a diagnostic means\n\n"
    "Exit status: 0; 1 if errors were found; 2 for a wrong command line; 70 if rddlc itself is\n"
    "wrong, which please report.";

// What the command line says, as it says it.
struct Arguments {
    std::vector<std::string> inputs;
    std::string output;
    std::vector<std::string> extern_headers;
    std::vector<std::string> print;
    std::string stop_after;
    bool check_only = false;
    bool line_directives = false;
    bool dependencies = false;
    std::string dependency_file;
    std::vector<std::string> warnings;  // behind -W
    bool no_warnings = false;
    std::string format = "text";
    std::string color = "auto";
    std::string standard = "pyrddlgym";
    std::string lanes = "16";
    std::string real = "double";
    std::int64_t memory_limit = default_memory_limit;
    std::string explained;
    std::vector<std::string> without;
    bool fast_math = false;
    std::string statistics;  // "true" without a format
    bool verbose = false;
};

// For --help.
std::string list_of_passes() {
    std::string text = "Optimisations, in their order:\n";
    for (const PassDescription& pass : all_passes())
        text += fmt::format("  {:30}  {}\n", pass.name, pass.summary);
    return text;
}

// A mistake in how rddlc was called.
CLI::ValidationError usage(const std::string& message) {
    return CLI::ValidationError(message);
}

void declare(CLI::App& program, Arguments& arguments) {
    program.set_version_flag("--version", fmt::format("rddlc {}", version));
    program
        .add_option("files", arguments.inputs,
                    "DOMAIN and INSTANCE, or one file that holds both; POLICY, a file with a "
                    "policy block")
        ->type_name("DOMAIN INSTANCE [POLICY]")
        ->expected(1, 3);
    program
        .add_option("-o", arguments.output,
                    "write FILE: .cpp, .hpp or .so tells what it shall be; without it the C++ "
                    "text goes to standard output")
        ->type_name("FILE");
    program
        .add_option(
            "--extern", arguments.extern_headers,
            "include FILE, a C++ header that defines the external functions; may be repeated")
        ->allow_extra_args(false)
        ->type_name("FILE");
    program
        .add_option("--print", arguments.print,
                    "print a form that the problem takes on its way: ast, model, ir, ir-opt, cpp")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("FORM");
    program
        .add_option("--stop-after", arguments.stop_after,
                    "stop after a stage: read, parse, check, ground, verify, optimise, emit")
        ->type_name("STAGE");
    program.add_flag("--check", arguments.check_only, "only check: the same as --stop-after=check");
    program
        .add_option("--std", arguments.standard,
                    "RDDL as pyrddlgym accepts it (default), or rddlc: with extensions")
        ->check(CLI::IsMember({"pyrddlgym", "rddlc"}))
        ->type_name("STANDARD");
    program.add_flag("--emit-lines", arguments.line_directives,
                     "#line in the C++ text, for debuggers and profilers");
    program.add_flag("--MD", arguments.dependencies,
                     "write a rule for make and ninja beside the output: FILE.d");
    program.add_option("--MF", arguments.dependency_file, "name the file of --MD")
        ->type_name("FILE");
    program
        .add_option("-W", arguments.warnings,
                    "-Wno-W0210: silence a warning; -Werror=W0210: make it an error; -Werror: "
                    "make all of them errors")
        ->allow_extra_args(false)
        ->type_name("WARNING");
    program.add_flag("-w", arguments.no_warnings, "silence all warnings");
    program.add_option("--diagnostics-format", arguments.format, "text or json")
        ->check(CLI::IsMember({"text", "json"}))
        ->type_name("FORMAT");
    program.add_option("--color", arguments.color, "auto, always or never")
        ->check(CLI::IsMember({"auto", "always", "never"}))
        ->type_name("WHEN");
    program
        .add_option("--lanes", arguments.lanes,
                    "environments that a step of a batch computes at once: 8, 16 (the default), "
                    "32, 64, or 1")
        ->check(CLI::IsMember({"1", "8", "16", "32", "64"}).description(""))
        ->type_name("N");
    program
        .add_option("--real", arguments.real,
                    "what the simulator computes reals in: double (the default), or float, which "
                    "is about twice as fast in batches and less exact")
        ->check(CLI::IsMember({"double", "float"}))
        ->type_name("TYPE");
    program
        .add_option("--memory-limit", arguments.memory_limit,
                    "bytes that one environment may take: 4G (the default), 512M, ...")
        ->transform(CLI::AsSizeValue(false).description(""))
        ->type_name("SIZE");
    program
        .add_option("--without", arguments.without,
                    "leave out optimisations: PASS[,PASS...], listed below; may be repeated")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("PASS");
    program.add_flag("--fast-math", arguments.fast_math,
                     "compute with reals as if they were not rounded, and never inf or nan");
    program.add_flag("--stats", arguments.statistics,
                     "tell what each optimisation did; --stats=json as JSON");
    program.add_option("--explain", arguments.explained, "explain a diagnostic and exit")
        ->type_name("CODE");
    program.add_flag("-v,--verbose", arguments.verbose, "tell how long each stage takes");
    program.get_formatter()->column_width(34);
    program.footer(list_of_passes() + "\n" + examples);
}

// Compilers write -MD, -MF FILE and -Wx with one dash; CLI11 wants -M D or --MD.
std::vector<std::string> with_compiler_spelling(int argc, char** argv) {
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool dependency = word == "-MD" || word.starts_with("-MF");
        words.push_back(dependency ? "-" + word : word);
        if (word.starts_with("-MF") && word.size() > 3) {
            words.back() = "--MF=" + word.substr(3);
        }
    }
    return words;
}

void replace(std::string& text, const std::string& part, const std::string& by) {
    const std::size_t at = text.find(part);
    if (at != std::string::npos) text.replace(at, part.size(), by);
}

// CLI11's help, with the spellings that it does not know.
std::string help_text(const CLI::App& program) {
    std::string help = program.help();
    replace(help, "[OPTIONS] [files(1x)]", "[OPTIONS] DOMAIN [INSTANCE] [POLICY]");
    replace(help, "files DOMAIN INSTANCE [POLICY]", "DOMAIN INSTANCE [POLICY]");
    replace(help, "--MD ", "-MD  ");
    replace(help, "--MF FILE ", "-MF FILE  ");
    replace(help, "--MD", "-MD");
    replace(help, "-W WARNING ...", "-W...         ");
    return help;
}

Code warning_named(const std::string& name) {
    const auto code = parse_code(name);
    if (!code || code->letter != 'W' || !explain(*code)) {
        throw usage(fmt::format("there is no warning '{}'", name));
    }
    return *code;
}

DiagnosticOptions diagnostic_options(const Arguments& arguments) {
    DiagnosticOptions options;
    options.all_warnings_disabled = arguments.no_warnings;
    for (const std::string& word : arguments.warnings) {
        if (word == "error") {
            options.warnings_as_errors = true;
        } else if (word.starts_with("error=")) {
            options.codes_as_errors.insert(warning_named(word.substr(6)));
        } else if (word.starts_with("no-")) {
            options.disabled_warnings.insert(warning_named(word.substr(3)));
        } else {
            throw usage(
                fmt::format("-W{} is not known; -Wno-CODE, -Werror and -Werror=CODE are", word));
        }
    }
    return options;
}

bool use_color(const std::string& when) {
    if (when != "auto") return when == "always";
    const char* no_color = std::getenv("NO_COLOR");
    return ::isatty(STDERR_FILENO) != 0 && (!no_color || *no_color == '\0');
}

// The last one that something to be printed needs.
std::optional<Stage> last_wanted_stage(const Arguments& arguments, const std::set<Form>& print) {
    std::optional<Stage> last;
    if (!print.empty()) last = stage_of(*print.rbegin());
    if (!arguments.statistics.empty()) last = std::max(last.value_or(Stage::Read), Stage::Optimise);
    return last;
}

Stage last_stage(const Arguments& arguments, const std::set<Form>& print) {
    Stage last = Stage::Write;
    if (!arguments.stop_after.empty()) {
        const auto stage = stage_named(arguments.stop_after);
        if (!stage) throw usage(fmt::format("there is no stage '{}'", arguments.stop_after));
        last = *stage;
    }
    if (arguments.check_only) last = std::min(last, Stage::Check);
    // Who only wants to see a form does not wait for the stages after it.
    if (!arguments.output.empty()) return last;
    const std::optional<Stage> wanted = last_wanted_stage(arguments, print);
    return wanted ? std::min(last, *wanted) : last;
}

std::set<Form> printed_forms(const Arguments& arguments) {
    std::set<Form> forms;
    for (const std::string& name : arguments.print) {
        const auto form = form_named(name);
        if (!form) throw usage(fmt::format("there is no form '{}' to print", name));
        forms.insert(*form);
    }
    const bool anything_else = !arguments.output.empty() || !arguments.stop_after.empty() ||
                               arguments.check_only || !arguments.statistics.empty();
    if (forms.empty() && !anything_else) forms.insert(Form::Cpp);
    return forms;
}

std::optional<std::filesystem::path> dependency_file(const Arguments& arguments) {
    if (!arguments.dependencies && arguments.dependency_file.empty()) return std::nullopt;
    if (arguments.output.empty()) throw usage("-MD needs an output: -o FILE");
    if (!arguments.dependency_file.empty()) return arguments.dependency_file;
    return arguments.output + ".d";
}

std::vector<std::filesystem::path> extern_headers(const Arguments& arguments) {
    std::vector<std::filesystem::path> headers;
    for (const std::string& file : arguments.extern_headers) {
        if (file.ends_with(".so")) {
            throw usage(
                fmt::format("--extern {}: a simulator needs the C++ header; shared objects "
                            "are for 'rddl run --engine=interpreter'",
                            file));
        }
        headers.emplace_back(file);
    }
    return headers;
}

PassOptions pass_options(const Arguments& arguments) {
    PassOptions options;
    options.fast_math = arguments.fast_math;
    for (const std::string& name : arguments.without) {
        if (const auto complaint = complaint_about_pass(name)) throw usage(*complaint);
        options.without.insert(name);
    }
    return options;
}

Statistics statistics_format(const std::string& word) {
    if (word.empty()) return Statistics::None;
    if (word == "true" || word == "text") return Statistics::Text;
    if (word == "json") return Statistics::Json;
    throw usage(fmt::format("--stats={} is not known; --stats and --stats=json are", word));
}

CompileOptions compile_options(const Arguments& arguments) {
    if (arguments.inputs.empty()) throw usage("which problem? Name DOMAIN and INSTANCE");
    CompileOptions options;
    options.inputs.assign(arguments.inputs.begin(), arguments.inputs.end());
    if (!arguments.output.empty()) options.output = arguments.output;
    options.extern_headers = extern_headers(arguments);
    options.print = printed_forms(arguments);
    options.stop_after = last_stage(arguments, options.print);
    options.line_directives = arguments.line_directives;
    options.lane_count = std::stoi(arguments.lanes);
    options.real = arguments.real == "float" ? RealType::Float : RealType::Double;
    options.memory_limit = arguments.memory_limit;
    options.dependency_file = dependency_file(arguments);
    options.diagnostics = diagnostic_options(arguments);
    options.standard = *standard_named(arguments.standard);
    options.passes = pass_options(arguments);
    return options;
}

Options options_of(const Arguments& arguments) {
    Options options;
    options.verbose = arguments.verbose;
    options.render.format =
        arguments.format == "json" ? DiagnosticsFormat::Json : DiagnosticsFormat::Text;
    options.render.color = use_color(arguments.color);
    if (!arguments.explained.empty()) {
        options.explained = parse_code(arguments.explained);
        if (!options.explained || !explain(*options.explained)) {
            throw usage(fmt::format("there is no diagnostic '{}'", arguments.explained));
        }
        return options;
    }
    options.statistics = statistics_format(arguments.statistics);
    options.compile = compile_options(arguments);
    return options;
}

}  // namespace

CommandLine parse_command_line(int argc, char** argv) {
    CLI::App program(overview, "rddlc");
    Arguments arguments;
    declare(program, arguments);
    try {
        std::vector<std::string> words = with_compiler_spelling(argc, argv);
        std::ranges::reverse(words);  // as CLI11 takes them
        program.parse(words);
        return {options_of(arguments)};
    } catch (const CLI::ParseError& error) {
        if (error.get_name() == "CallForHelp") {
            fmt::print("{}", help_text(program));
            return {std::nullopt, success};
        }
        if (error.get_exit_code() == 0) {
            std::ostringstream text;
            program.exit(error, text, text);
            fmt::print("{}", text.str());
            return {std::nullopt, success};
        }
        tell("rddlc: error: {}\n'rddlc --help' shows the usage\n", error.what());
        return {std::nullopt, usage_error};
    }
}

}  // namespace rddlc::cli
