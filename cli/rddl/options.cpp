#include "options.hpp"

#include "driver/driver.hpp"

namespace rddlc::cli {

ProblemFiles ProblemArguments::files() const {
    ProblemFiles files = find_files(first, second);
    files.standard = standard;
    files.memory_limit = memory_limit;
    return files;
}

void add_problem_arguments(CLI::App& command, ProblemArguments& arguments, bool required) {
    command
        .add_option("DOMAIN", arguments.first,
                    "Domain file, or NAME of a problem of rddlrepository")
        ->required(required);
    command.add_option("INSTANCE", arguments.second, "Instance file, or number of the instance");
    add_standard_option(command, arguments.standard);
    command
        .add_option("--memory-limit", arguments.memory_limit,
                    "Bytes that simulators may take: 4G (default), 512M, ...")
        ->transform(CLI::AsSizeValue(false).description(""))
        ->type_name("SIZE");
}

void add_standard_option(CLI::App& command, Standard& standard) {
    command
        .add_option_function<std::string>(
            "--std", [&standard](const std::string& name) { standard = *standard_named(name); },
            "RDDL as pyrddlgym accepts it (default), or rddlc: with extensions")
        ->check(CLI::IsMember({"pyrddlgym", "rddlc"}).description(""))
        ->type_name("STANDARD");
}

void add_extern_option(CLI::App& command, LoadOptions& options, const std::string& explanation) {
    command.add_option("--extern", options.externs, explanation)
        ->allow_extra_args(false)
        ->type_name("FILE");
}

void add_pass_options(CLI::App& command, LoadOptions& options) {
    command
        .add_option_function<std::vector<std::string>>(
            "--without",
            [&options](const std::vector<std::string>& names) {
                for (const std::string& name : names) {
                    if (const auto complaint = complaint_about_pass(name))
                        throw CLI::ValidationError(*complaint);
                    options.passes.without.insert(name);
                }
            },
            "Leave out optimisations; 'rddlc --help' lists them")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("PASS");
    command.add_flag("--fast-math", options.passes.fast_math,
                     "Compute with reals as if they were not rounded, and never inf or nan");
}

void add_cache_option(CLI::App& command, LoadOptions& options) {
    command.add_flag("--no-cache", options.ignore_cache,
                     "Compile anew instead of using a simulator compiled before");
}

void add_engine_options(CLI::App& command, LoadOptions& options) {
    command
        .add_option_function<std::string>(
            "--engine",
            [&options](const std::string& name) {
                options.engine = name == "compiled" ? Engine::Compiled : Engine::Interpreter;
            },
            "compiled (default), or interpreter, which needs no C++ compiler")
        ->check(CLI::IsMember({"compiled", "interpreter"}).description(""))
        ->type_name("ENGINE");
    add_extern_option(command, options,
                      "C++ header of the external functions; the interpreter takes a .so, too");
    add_pass_options(command, options);
    command
        .add_option_function<std::string>(
            "--real",
            [&options](const std::string& name) {
                options.real = name == "float" ? RealType::Float : RealType::Double;
            },
            "What reals are computed in: double (default) or float")
        ->check(CLI::IsMember({"double", "float"}).description(""))
        ->type_name("TYPE");
    add_cache_option(command, options);
}

void add_preconditions_option(CLI::App& command, Preconditions& preconditions) {
    command
        .add_option_function<std::string>(
            "--preconditions",
            [&preconditions](const std::string& name) {
                preconditions = name == "warn"    ? Preconditions::Warn
                                : name == "error" ? Preconditions::Error
                                : name == "noop"  ? Preconditions::Noop
                                                  : Preconditions::Ignore;
            },
            "Illegal actions: ignore (default) and warn take them, error refuses, noop does "
            "nothing")
        ->check(CLI::IsMember({"ignore", "warn", "error", "noop"}).description(""))
        ->type_name("WHAT");
}

}  // namespace rddlc::cli
