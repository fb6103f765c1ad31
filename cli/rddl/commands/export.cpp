// rddl export: learned policies for readers and for other programs.
#include "learning/export.hpp"

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "learning/learned_policy.hpp"
#include "support/files.hpp"
#include "support/program.hpp"

#include <fmt/format.h>

#include <memory>

namespace rddlc::cli {

namespace {

struct ExportOptions {
    ProblemArguments problem;
    LoadOptions load;
    std::string policy, form, output;
};

ExitStatus export_policy(const ExportOptions& options) {
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    const std::filesystem::path file = policy_file(options.policy);
    const std::string text = policy_text(options.policy);
    std::string result;
    try {
        result =
            exported_policy(*problem.simulator, text, options.form, options.problem.memory_limit);
    } catch (const Failure& failure) {
        throw Failure(fmt::format("cannot export '{}': {}", file.string(), failure.what()),
                      failure.hint, failure.status);
    }
    if (options.output.empty()) {
        print_data(result);
        return success;
    }
    UsedFiles used = problem.used;
    used.add(file);
    write_file(options.output, result, used);
    return success;
}

}  // namespace

Command export_command() {
    const auto options = std::make_shared<ExportOptions>();
    Command command;
    command.name = "export";
    command.summary = "Write a learned policy as a formula, code or a network";
    command.details =
        "Examples:\n"
        "  rddl export MountainCar_ippc2023 1 --policy runs/c\n"
        "  rddl export MountainCar_ippc2023 1 --policy runs/a --as cpp -o policy.hpp";
    add_problem_arguments(command, options->problem);
    add_text_option(command, "--policy", "POLICY", "A policy file, or the folder of a run",
                    options->policy)
        .is_required = true;
    add_option(
        command, "--as", "FORM",
        "For CGP: formula (default), cpp, dot, svg, py, latex; for PPO and DRP: json (default), "
        "cpp, onnx",
        [options](const std::string& form) { options->form = form; })
        .choices = {"formula", "json", "cpp", "dot", "svg", "py", "latex", "onnx"};
    add_text_option(command, "-o,--output", "FILE", "Output file (standard output)",
                    options->output);
    add_engine_options(command, options->load);
    command.run = [options] {
        return export_policy(*options);
    };
    return command;
}

}  // namespace rddlc::cli
