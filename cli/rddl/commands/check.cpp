// rddl check: diagnostics, of one problem or of the whole repository.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "engines/external_library.hpp"
#include "formats/table.hpp"
#include "problems/check_many.hpp"
#include "problems/front_end.hpp"
#include "support/files.hpp"
#include "support/program.hpp"
#include "support/render.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <span>

namespace rddlc::cli {

namespace {

struct CheckOptions {
    ProblemArguments problem;
    LoadOptions load;
    bool all = false;
    bool verbose = false;
};

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

// External functions are only checked if files define them.
ExitStatus check_one(const ProblemFiles& files, const LoadOptions& options) {
    const bool has_externs = !options.externs.empty();
    CompileOptions front_end = check_options(files, has_externs ? Stage::Verify : Stage::Ground);
    front_end.extern_headers = extern_files(options.externs).headers;
    const Compilation compilation = compile(front_end);
    print_diagnostics(compilation);
    if (compilation.diagnostics.has_errors()) return diagnosed;
    if (has_externs && compilation.program) external_library(*compilation.program, files, options);
    print("{}: {}\n", files.name, verdict(compilation));
    return success;
}

// ------------------------------------------------------------------ many problems at once

std::vector<std::string> cells(std::string name, const CheckedInstances& row) {
    return {std::move(name), std::to_string(row.instances), std::to_string(row.without_errors),
            std::to_string(row.errors), std::to_string(row.warnings)};
}

void print_table(const std::vector<RepositoryProblem>& problems,
                 const std::vector<CheckedInstances>& rows) {
    TextTable table({{"problem"},
                     {"instances", Align::Right},
                     {"without errors", Align::Right},
                     {"errors", Align::Right},
                     {"warnings", Align::Right}});
    for (std::size_t i = 0; i < rows.size(); ++i) table.add_row(cells(problems[i].name, rows[i]));
    print("{}\n", table.text());
}

ExitStatus summarise(const CheckedInstances& total, bool shows_warnings) {
    const bool hides_some = total.warnings > 0 && !shows_warnings;
    print("{} of {} without errors, {}, {}{}\n", total.without_errors,
          counted(total.instances, "instance"), counted(total.errors, "error"),
          counted(total.warnings, "warning"),
          hides_some
              ? fmt::format("; --verbose shows the warning{}", total.warnings == 1 ? "" : "s")
              : "");
    std::fflush(stdout);
    const auto first = std::ranges::find_if(
        total.different, [](const RenderedDiagnostic* each) { return each->is_error; });
    if (first != total.different.end()) tell(pointer_to_explanation((*first)->code, "rddl"));
    if (is_interrupted()) return interrupted_status();
    return total.errors == 0 ? success : diagnosed;
}

ExitStatus check_problems(const std::vector<RepositoryProblem>& problems,
                          const CheckOptions& options) {
    std::vector<ProblemFiles> files;
    for (const RepositoryProblem& problem : problems)
        for (const std::string& instance : problem.instances)
            files.push_back(options.problem.with_options(find_instance(problem, instance)));
    const std::vector<CheckOutcome> outcomes = check_many(files);

    std::vector<CheckedInstances> rows;
    CheckedInstances total;
    std::span<const CheckOutcome> left(outcomes);
    for (const RepositoryProblem& problem : problems) {
        rows.emplace_back(left.first(problem.instances.size()));
        left = left.subspan(problem.instances.size());
        total.add(rows.back());
    }
    for (const RenderedDiagnostic* each : total.different)
        if (each->is_error || options.verbose) tell(each->text);
    print_table(problems, rows);
    return summarise(total, options.verbose);
}

ExitStatus check(const CheckOptions& options) {
    const ProblemArguments& problem = options.problem;
    if (options.all) {
        if (!problem.first.empty())
            throw UsageError("--all checks the whole repository; name no problem");
        return check_problems(require_repository().problems, options);
    }
    if (problem.first.empty()) throw UsageError("name a problem, or say --all");
    if (problem.second.empty() && is_folder(problem.first)) {
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
        "The exit status is 1 if there are errors. 'rddl --explain E0203' explains a code.\n\n"
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
    add_flag(command, "-v,--verbose", "Also show warnings when many instances are checked",
             options->verbose);
    command.run = [options] {
        return check(*options);
    };
    return command;
}

}  // namespace rddlc::cli
