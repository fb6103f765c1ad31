#include "options.hpp"

#include "cache/cache_folder.hpp"
#include "cache/prepared_runtime.hpp"
#include "command_line/explain_option.hpp"
#include "driver/explain.hpp"
#include "driver/files.hpp"
#include "driver/shared_object.hpp"
#include "support/failure.hpp"
#include "support/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace rddlc::cli {
namespace {

constexpr const char* overview =
    "Compiles an RDDL problem, a domain and an instance, into a simulator in C++.";

constexpr const char* examples =
    "Examples:\n"
    "  rddlc domain.rddl instance.rddl -o sim.cpp    a source file to compile and link\n"
    "  rddlc domain.rddl instance.rddl -o sim.so     a shared object to load\n"
    "  rddlc domain.rddl instance.rddl --check       only check for errors\n"
    "  rddlc domain.rddl --check                     those of a domain, without an instance\n"
    "  rddlc --explain E0203                         what a diagnostic means\n\n"
    "Exit status: 0; 1 if errors were found; 2 for a wrong command line; 70 if rddlc itself is\n"
    "wrong, which please report.";

// The arguments of the command line, unchecked.
struct Arguments {
    std::vector<std::string> inputs;
    std::string policy;
    std::string instance;
    std::string output;
    bool portable = false;
    std::vector<std::string> extern_headers;
    std::vector<std::string> print;
    std::string stop_after;
    bool check_only = false;
    bool line_directives = false;
    bool dependencies = false;
    std::string dependency_file;
    std::string declaration_file;
    std::string entry;
    std::vector<std::string> warnings;  // behind -W
    bool no_warnings = false;
    std::string format = "text";
    std::string color = "auto";
    std::string standard = "pyrddlgym";
    bool details = false;
    std::string lanes;
    std::string real = "double";
    std::int64_t memory_limit = default_memory_limit;
    std::string explanation;
    bool list_passes = false;
    std::vector<std::string> without;
    bool fast_math = false;
    std::string statistics;  // "true" without a format
    bool verbose = false;
};

// The list of passes for --help.
std::string list_of_passes() {
    std::string text = "Optimisations, in their order (--passes gives the reasons):\n";
    for (const PassDescription& pass : all_passes())
        text += fmt::format("  {:30}  {}\n", pass.name, pass.summary);
    return text;
}

// A mistake in how rddlc was called.
UsageError usage(const std::string& message) {
    return UsageError(message);
}

void add_input(Command& command, const std::string& name, const std::string& explanation,
               Arguments& arguments) {
    add_argument(command, name, explanation,
                 [&arguments](const std::string& file) { arguments.inputs.push_back(file); });
}

// The inputs, and the output files.
void add_file_options(Command& command, Arguments& arguments) {
    add_input(command, "DOMAIN", "domain file, or one that also holds the instance", arguments);
    command.options.back().is_required = true;
    add_input(command, "INSTANCE", "instance file", arguments);
    add_argument(command, "POLICY", "file with a policy block, which alone is taken from it",
                 arguments.policy);
    add_text_option(command, "--instance", "NAME",
                    "compile the instance of this name, if the files hold several",
                    arguments.instance);
    add_text_option(
        command, "-o,--output", "FILE",
        "write FILE: its extension .cpp, .hpp or .so selects the output format; without it the "
        "C++ text goes to standard output",
        arguments.output);
    add_flag(command, "--portable",
             "make the .so for any processor of the architecture; otherwise it needs the vector "
             "registers of this one",
             arguments.portable);
    add_repeated_option(command, "--extern", "FILE",
                        "include FILE, a C++ header that defines the external functions; may be "
                        "repeated",
                        arguments.extern_headers);
    add_text_option(command, "--declare", "FILE",
                    "also write FILE, a header for C and C++ that declares the function which the "
                    ".cpp exports",
                    arguments.declaration_file);
    add_text_option(command, "--entry", "NAME",
                    "name the function that the .cpp exports, for two simulators of the same "
                    "problem in one program",
                    arguments.entry);
    add_flag(command, "-MD", "write a rule for make and ninja beside the output: FILE.d",
             arguments.dependencies);
    add_text_option(command, "-MF", "FILE", "name the file of -MD", arguments.dependency_file);
}

void add_stage_options(Command& command, Arguments& arguments) {
    add_list_option(command, "--print", "FORM,...",
                    "print an intermediate form of the problem: ast, model, ir, ir-opt, cpp",
                    [&arguments](const std::string& form) { arguments.print.push_back(form); })
        .choices = {"ast", "model", "ir", "ir-opt", "cpp"};
    add_text_option(command, "--stop-after", "STAGE",
                    "stop after a stage: read, parse, check, ground, verify, optimise, emit",
                    arguments.stop_after)
        .choices = {"read", "parse", "check", "ground", "verify", "optimise", "emit"};
    add_flag(command, "--check",
             "only check: the same as --stop-after=check; a domain may stand alone",
             arguments.check_only);
    add_text_option(command, "--std", "STANDARD",
                    "RDDL as pyrddlgym accepts it (default), or rddlc: with extensions",
                    arguments.standard)
        .choices = {"pyrddlgym", "rddlc"};
}

void add_diagnostic_options(Command& command, Arguments& arguments) {
    add_repeated_option(command, "-W", "...",
                        "-Wno-W0210: silence a warning; -Werror=W0210: make it an error; -Werror: "
                        "make all of them errors",
                        arguments.warnings);
    add_flag(command, "-w", "silence all warnings", arguments.no_warnings);
    add_text_option(command, "--diagnostics-format", "FORMAT", "text (default) or json",
                    arguments.format)
        .choices = {"text", "json"};
    add_text_option(command, "--color", "WHEN", "auto (default), always or never", arguments.color)
        .choices = {"auto", "always", "never"};
    add_explain_option(command, arguments.explanation);
    add_flag(command, "--passes",
             "print the optimisations in their order, with the reasons, and exit",
             arguments.list_passes)
        .is_enough = true;
    add_flag(command, "-v,--verbose", "report how long each stage takes", arguments.verbose);
}

void add_code_options(Command& command, Arguments& arguments) {
    add_flag(command, "--details",
             "the simulator can also report interm-fluents of the last step, and which objects "
             "violate a precondition",
             arguments.details);
    add_flag(command, "--emit-lines", "#line in the C++ text, for debuggers and profilers",
             arguments.line_directives);
    add_text_option(
        command, "--lanes", "N",
        "environments that a step of a batch computes at once: 8, 16, 32, 64, or 1; the "
        "default depends on the problem",
        arguments.lanes)
        .choices = {"1", "8", "16", "32", "64"};
    add_text_option(command, "--real", "TYPE",
                    "type of reals in computations: double (the default), or float, which "
                    "is about twice as fast in batches and less exact",
                    arguments.real)
        .choices = {"double", "float"};
    add_option(
        command, "--memory-limit", "SIZE",
        "bytes that one environment may take: 4G (the default), 512M, ...",
        [&arguments](const std::string& bytes) { arguments.memory_limit = std::stoll(bytes); })
        .kind = OptionKind::Bytes;
    add_list_option(command, "--without", "PASS,...",
                    "leave out optimisations, which are listed below; may be repeated",
                    [&arguments](const std::string& pass) { arguments.without.push_back(pass); })
        .suggestions = pass_names();
    add_flag(command, "--fast-math",
             "compute with reals as if they were not rounded, and never inf or nan",
             arguments.fast_math);
    add_flag(command, "--stats", "report what each optimisation did; --stats=json as JSON",
             [&arguments](const std::string& format) { arguments.statistics = format; });
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
    return when == "auto" ? tells_in_color() : when == "always";
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
    if (!arguments.stop_after.empty()) last = *stage_named(arguments.stop_after);
    if (arguments.check_only) last = std::min(last, Stage::Check);
    // A user who only wants a form does not wait for the stages after it.
    if (!arguments.output.empty()) return last;
    const std::optional<Stage> wanted = last_wanted_stage(arguments, print);
    return wanted ? std::min(last, *wanted) : last;
}

std::set<Form> printed_forms(const Arguments& arguments) {
    std::set<Form> forms;
    for (const std::string& name : arguments.print) forms.insert(*form_named(name));
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

// Only a .cpp exports a function of its own name.
std::optional<std::filesystem::path> declaration_file(const Arguments& arguments) {
    if (arguments.declaration_file.empty()) return std::nullopt;
    if (output_kind(arguments.output) != OutputKind::Source)
        throw usage("--declare needs an output that exports a function: -o FILE.cpp");
    return arguments.declaration_file;
}

std::string entry(const Arguments& arguments) {
    if (arguments.entry.empty()) return "";
    if (!arguments.output.empty() && output_kind(arguments.output) != OutputKind::Source)
        throw usage("--entry needs an output that exports a function of its own name: -o FILE.cpp");
    if (!can_be_entry(arguments.entry))
        throw usage(
            fmt::format("--entry: '{}' cannot be the name of a C function", arguments.entry));
    return arguments.entry;
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

bool portable(const Arguments& arguments) {
    if (arguments.portable &&
        (arguments.output.empty() || output_kind(arguments.output) != OutputKind::SharedObject))
        throw usage("--portable needs a shared object as output: -o FILE.so");
    return arguments.portable;
}

// The code that all shared objects have in common, from the cache that rddl also uses. All of it is
// compiled again if there is no such folder.
std::optional<std::filesystem::path> runtime_in_cache(RealType real) {
    try {
        return workbench::prepared_runtime(workbench::cache_folder(), workbench::toolchain_text(),
                                           real);
    } catch (const Failure&) {
        return std::nullopt;
    }
}

CompileOptions compile_options(const Arguments& arguments) {
    CompileOptions options;
    options.inputs.assign(arguments.inputs.begin(), arguments.inputs.end());
    if (!arguments.policy.empty()) options.policy = arguments.policy;
    options.instance = arguments.instance;
    if (!arguments.output.empty()) options.output = arguments.output;
    options.extern_headers = extern_headers(arguments);
    options.print = printed_forms(arguments);
    options.stop_after = last_stage(arguments, options.print);
    options.domain_may_stand_alone =
        options.stop_after <= Stage::Check && !options.print.contains(Form::Model);
    options.entry = entry(arguments);
    options.line_directives = arguments.line_directives;
    options.details = arguments.details;
    if (!arguments.lanes.empty()) options.lane_count = std::stoi(arguments.lanes);
    options.real = arguments.real == "float" ? RealType::Float : RealType::Double;
    options.memory_limit = arguments.memory_limit;
    options.portable = portable(arguments);
    if (has_prepared_batches(options.lane_count))
        options.prepared_runtime = [real = options.real] {
            return runtime_in_cache(real);
        };
    options.dependency_file = dependency_file(arguments);
    options.declaration_file = declaration_file(arguments);
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
    if (arguments.list_passes && !arguments.inputs.empty())
        throw usage(fmt::format("--passes takes no file, such as '{}'", arguments.inputs.front()));
    options.explanation = arguments.list_passes ? pipeline_text() : arguments.explanation;
    if (!options.explanation.empty()) return options;
    options.statistics = statistics_format(arguments.statistics);
    options.compile = compile_options(arguments);
    return options;
}

}  // namespace

Command rddlc_command(std::function<ExitStatus(const Options&)> run) {
    const auto arguments = std::make_shared<Arguments>();
    Command command;
    command.name = "rddlc";
    command.summary = overview;
    command.details = list_of_passes() + "\n" + examples;
    add_file_options(command, *arguments);
    add_stage_options(command, *arguments);
    add_code_options(command, *arguments);
    add_diagnostic_options(command, *arguments);
    command.run = [arguments, run = std::move(run)] {
        return run(options_of(*arguments));
    };
    return command;
}

}  // namespace rddlc::cli
