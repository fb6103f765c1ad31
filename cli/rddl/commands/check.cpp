// rddl check: diagnostics, of one problem or of the whole repository.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "engines/external_library.hpp"
#include "formats/table.hpp"
#include "problems/front_end.hpp"
#include "rollouts/parallel.hpp"
#include "support/program.hpp"
#include "support/render.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace rddlc::cli {

namespace {

struct CheckOptions {
    ProblemArguments problem;
    LoadOptions load;
    bool all = false;
    bool verbose = false;
};

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::size_t warning_count(const Diagnostics& diagnostics) {
    return diagnostics.all().size() - diagnostics.error_count();
}

// "no errors, 1 warning", and what was not checked.
std::string verdict(const Compilation& compilation) {
    const std::size_t warnings = warning_count(compilation.diagnostics);
    return fmt::format("no errors{}{}{}", compilation.is_domain_alone ? " in the domain" : "",
                       warnings == 0 ? "" : ", " + counted(warnings, "warning"),
                       compilation.is_domain_alone ? fmt::format("\n{}", no_instance_given) : "");
}

// External functions are only checked where somebody defines them.
ExitStatus check_one(const ProblemFiles& files, const LoadOptions& options) {
    const bool has_externs = !options.externs.empty();
    CompileOptions front_end = check_options(files, has_externs ? Stage::Verify : Stage::Ground);
    front_end.extern_headers = extern_files(options.externs).headers;
    const Compilation compilation = compile(front_end);
    print_diagnostics(compilation);
    if (compilation.diagnostics.has_errors()) return diagnosed;
    if (has_externs && compilation.program) external_library(*compilation.program, files, options);
    fmt::print("{}: {}\n", files.name, verdict(compilation));
    return success;
}

// ------------------------------------------------------------------ many problems at once

struct Outcome {
    bool done = false;
    std::size_t errors = 0, warnings = 0;
    std::string text;  // the rendered diagnostics
};

Outcome check_quietly(const ProblemFiles& files) {
    const Compilation compilation = compile(check_options(files, Stage::Ground));
    return {true, compilation.diagnostics.error_count(), warning_count(compilation.diagnostics),
            render(compilation.diagnostics, compilation.sources, {})};
}

// In parallel; outcomes in the order of the files. Stops early on an interrupt.
std::vector<Outcome> check_many(const std::vector<ProblemFiles>& files) {
    std::vector<Outcome> outcomes(files.size());
    for_each_in_parallel("checking", files.size(),
                         [&](std::size_t i) { outcomes[i] = check_quietly(files[i]); });
    return outcomes;
}

struct ProblemRow {
    std::size_t instances = 0, without_errors = 0, errors = 0, warnings = 0;

    void add(const Outcome& outcome) {
        instances += 1;
        without_errors += outcome.errors == 0;
        errors += outcome.errors;
        warnings += outcome.warnings;
    }
    std::vector<std::string> cells(std::string name) const {
        return {std::move(name), std::to_string(instances), std::to_string(without_errors),
                std::to_string(errors), std::to_string(warnings)};
    }
};

ExitStatus summarise(const std::vector<RepositoryProblem>& problems,
                     const std::vector<Outcome>& outcomes) {
    Table table({{"problem"},
                 {"instances", Align::Right},
                 {"without errors", Align::Right},
                 {"errors", Align::Right},
                 {"warnings", Align::Right}});
    ProblemRow total;
    std::size_t next = 0;
    for (const RepositoryProblem& problem : problems) {
        ProblemRow row;
        for (std::size_t i = 0; i < problem.instances.size(); ++i) {
            const Outcome& outcome = outcomes[next++];
            if (!outcome.done) continue;
            row.add(outcome);
            total.add(outcome);
        }
        table.add_row(row.cells(problem.name));
    }
    fmt::print("{}\n", table.text());
    fmt::print("{} of {} without errors, {}, {}\n", total.without_errors,
               counted(total.instances, "instance"), counted(total.errors, "error"),
               counted(total.warnings, "warning"));
    if (is_interrupted()) return interrupted_status();
    return total.errors == 0 ? success : diagnosed;
}

ExitStatus check_problems(const std::vector<RepositoryProblem>& problems,
                          const CheckOptions& options) {
    std::vector<ProblemFiles> files;
    for (const RepositoryProblem& problem : problems)
        for (const std::string& instance : problem.instances)
            files.push_back(options.problem.with_options(find_instance(problem, instance)));
    const std::vector<Outcome> outcomes = check_many(files);
    for (const Outcome& outcome : outcomes)
        if (outcome.errors > 0 || options.verbose) tell(outcome.text);
    return summarise(problems, outcomes);
}

ExitStatus check(const CheckOptions& options) {
    const ProblemArguments& problem = options.problem;
    if (options.all) {
        if (!problem.first.empty())
            throw UsageError("--all checks the whole repository; name no problem");
        return check_problems(require_repository().problems, options);
    }
    if (problem.first.empty()) throw UsageError("name a problem, or say --all");
    std::error_code ignored;
    if (problem.second.empty() && std::filesystem::is_directory(problem.first, ignored)) {
        const RepositoryProblem found = problem_in(problem.first);
        const std::filesystem::path domain = found.domain_file();
        if (found.instances.empty())
            return check_one(problem.with_options({domain.string(), domain, std::nullopt}),
                             options.load);
        return check_problems({found}, options);
    }
    if (problem.second.empty() && !is_path(problem.first)) {
        const Repository repository = require_repository();
        return check_problems({find_problem(repository, problem.first)}, options);
    }
    return check_one(problem.files(), options.load);
}

}  // namespace

Command check_command() {
    const auto options = std::make_shared<CheckOptions>();
    Command command;
    command.name = "check";
    command.summary = "Check problems and show diagnostics";
    command.details =
        "The exit status is 1 if there are errors. 'rddlc --explain E0203' explains a code.\n\n"
        "Examples:\n"
        "  rddl check domain.rddl instance.rddl\n"
        "  rddl check domain.rddl                what can be checked without an instance\n"
        "  rddl check Wildfire_MDP_ippc2014      all instances of a problem\n"
        "  rddl check my_problem/                all instances in a folder\n"
        "  rddl check --all                      the whole of rddlrepository";
    add_problem_arguments(command, options->problem, false);
    add_extern_option(command, options->load,
                      "Also check the external functions of FILE, a C++ header or .so");
    add_flag(command, "--all", "Check every instance of rddlrepository", options->all);
    add_flag(command, "-v,--verbose", "Show warnings, too, where many instances are checked",
             options->verbose);
    command.run = [options] {
        return check(*options);
    };
    return command;
}

}  // namespace rddlc::cli
