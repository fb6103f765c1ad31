#include "commands/options.hpp"

#include "driver/driver.hpp"
#include "learning/learned_policy.hpp"
#include "solvers/spaces/refusals.hpp"

#include <fmt/format.h>

namespace rddlc::cli {

ProblemFiles ProblemArguments::files() const {
    return with_options(find_files(first, second));
}

ProblemFiles ProblemArguments::with_options(ProblemFiles files) const {
    files.instance_name = instance_name;
    files.standard = standard;
    files.memory_limit = memory_limit;
    return files;
}

void add_problem_arguments(Command& command, ProblemArguments& arguments, bool required) {
    add_argument(
        command, "DOMAIN",
        "Domain file, or one that holds the instance, too; folder of a domain.rddl and its "
        "instances; or NAME of a problem of rddlrepository",
        arguments.first)
        .is_required = required;
    add_argument(command, "INSTANCE", "Instance file, or number of the instance", arguments.second);
    add_text_option(command, "--instance", "NAME",
                    "Take the instance of this name, where the files hold several",
                    arguments.instance_name);
    add_standard_option(command, arguments.standard);
    add_option(
        command, "--memory-limit", "SIZE",
        "Bytes that simulators and learners may take: 4G (default), 512M, 1e9, ...",
        [&arguments](const std::string& bytes) { arguments.memory_limit = std::stoll(bytes); })
        .kind = OptionKind::Bytes;
}

void require_an_end(const rddl_problem& problem, std::int64_t horizon) {
    if (solvers::is_endless(problem, horizon))
        throw Failure(solvers::endless, "give one with --horizon", usage_error);
}

void add_standard_option(Command& command, Standard& standard) {
    add_option(command, "--std", "STANDARD",
               "RDDL as pyrddlgym accepts it (default), or rddlc: with extensions",
               [&standard](const std::string& name) { standard = *standard_named(name); })
        .choices = {"pyrddlgym", "rddlc"};
}

void add_extern_option(Command& command, LoadOptions& options, const std::string& explanation) {
    add_repeated_option(command, "--extern", "FILE", explanation, options.externs);
}

void add_pass_options(Command& command, LoadOptions& options) {
    add_list_option(command, "--without", "PASS,...",
                    "Leave out optimisations; 'rddlc --help' lists them",
                    [&options](const std::string& name) {
                        if (const auto complaint = complaint_about_pass(name))
                            throw UsageError(*complaint);
                        options.passes.without.insert(name);
                    })
        .suggestions = pass_names();
    add_flag(command, "--fast-math",
             "Compute with reals as if they were not rounded, and never inf or nan",
             options.passes.fast_math);
}

void add_cache_option(Command& command, LoadOptions& options) {
    add_flag(command, "--no-cache", "Compile anew instead of using a simulator compiled before",
             options.ignore_cache);
}

void add_engine_options(Command& command, LoadOptions& options) {
    add_option(command, "--engine", "ENGINE",
               "compiled (default), or interpreter, which needs no C++ compiler",
               [&options](const std::string& name) {
                   options.engine = name == "compiled" ? Engine::Compiled : Engine::Interpreter;
               })
        .choices = {"compiled", "interpreter"};
    add_extern_option(command, options,
                      "C++ header of the external functions; the interpreter takes a .so, too");
    add_pass_options(command, options);
    add_option(command, "--real", "TYPE", "What reals are computed in: double (default) or float",
               [&options](const std::string& name) {
                   options.real = name == "float" ? RealType::Float : RealType::Double;
               })
        .choices = {"double", "float"};
    add_cache_option(command, options);
}

namespace {

void choose_policy(const std::string& name, Policy& policy,
                   std::optional<std::filesystem::path>& file, RolloutOptions* rollouts) {
    for (const Policy each : {Policy::Random, Policy::Noop, Policy::Rddl}) {
        if (name_of(each) != name) continue;
        policy = each;
        file.reset();
        return;
    }
    if (planners::is_planner(name) && rollouts) {
        planners::require_planner(name);
        policy = Policy::Planner;
        rollouts->planner = name;
        return;
    }
    if (!is_path(name))
        throw UsageError(
            fmt::format("--policy: '{}' is neither random, noop, rddl nor a file", name));
    if (is_learned_policy(name)) {
        if (!rollouts)
            throw UsageError(
                fmt::format("--policy: '{}' is a trace or what a solver has learned, which this "
                            "command does not "
                            "take; --states takes the states of a trace",
                            name));
        policy = Policy::Learned;
        rollouts->learned = name;
        return;
    }
    policy = Policy::Rddl;
    file = name;
}

}  // namespace

void add_planner_options(Command& command, PlannerSettings& planning) {
    add_flag(command, "--cheat", "Planners see the state of problems that are observed in part",
             planning.cheat);
    add_text_option(command, "--explain-decisions", "FILE",
                    "Write what planners' decisions were made by, a line of JSON each; - is stdout",
                    planning.explanations);
}

void add_policy_option(Command& command, Policy& policy, std::optional<std::filesystem::path>& file,
                       RolloutOptions* rollouts) {
    add_option(
        command, "--policy", "POLICY",
        std::string("random (default): legal random actions; noop: default actions; rddl: the "
                    "policy block of the problem; FILE: the policy block in it") +
            (rollouts
                 ? ", what a solver has learned, or the actions of a trace (.jsonl): episode 0 "
                   "plays those of its episode 0 and so on, and after its last episode comes "
                   "its first one again; plan:NAME: a planner ('rddl help evaluate' lists them)"
                 : ""),
        [&policy, &file, rollouts](const std::string& name) {
            choose_policy(name, policy, file, rollouts);
        })
        .suggestions = {"random", "noop", "rddl"};
}

void add_preconditions_option(Command& command, Preconditions& preconditions) {
    add_option(command, "--preconditions", "WHAT",
               "Illegal actions: ignore (default) and warn take them, error refuses, noop does "
               "nothing",
               [&preconditions](const std::string& name) {
                   preconditions = name == "warn"    ? Preconditions::Warn
                                   : name == "error" ? Preconditions::Error
                                   : name == "noop"  ? Preconditions::Noop
                                                     : Preconditions::Ignore;
               })
        .choices = {"ignore", "warn", "error", "noop"};
}

}  // namespace rddlc::cli
