// rddl export: learned policies for people and for other programs.
#include "solvers/ppo/export.hpp"

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "learning/learned_policy.hpp"
#include "solvers/cgp/formula.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/ppo/policy_file.hpp"
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

std::string exported_program(const rddl_simulator& simulator, const std::string& text,
                             const std::string& form) {
    const auto found = solvers::read_program(simulator, text);
    if (form == "formula") return solvers::program_formula(found->scope, found->genome);
    if (found->genome.delayed)
        throw Failure(fmt::format("it remembers the step before, as programs of scikit-decide do, "
                                  "and such programs are not written as {}",
                                  form),
                      "--as formula explains it", usage_error);
    const solvers::Formula formula = solvers::simplified(found->genome);
    if (form == "cpp") return solvers::formula_cpp(formula, found->scope);
    if (form == "dot") return solvers::formula_dot(formula, found->scope);
    if (form == "svg") return solvers::formula_svg(formula, found->scope);
    if (form == "py") return solvers::formula_python(formula, found->scope);
    if (form == "latex") return solvers::formula_latex(formula, found->scope);
    throw Failure(fmt::format("programs of CGP are not written as {}", form),
                  "formula, cpp, dot, svg, py and latex are", usage_error);
}

std::string exported_network(const rddl_simulator& simulator, const std::string& text,
                             const std::string& form, std::int64_t memory_limit) {
    const auto model = solvers::read_ppo_policy(simulator, text, memory_limit);
    if (form == "json") return solvers::ppo_policy_text(simulator, *model);
    if (form == "cpp") return solvers::ppo_policy_cpp(*model);
    if (form == "onnx") return solvers::ppo_policy_onnx(*model);
    throw Failure(fmt::format("networks of PPO are not written as {}", form),
                  "json, cpp and onnx are", usage_error);
}

ExitStatus export_policy(const ExportOptions& options) {
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    const std::filesystem::path file = policy_file(options.policy);
    const std::string text = policy_text(options.policy);
    const bool program = solvers::is_program(text);
    const std::string form = !options.form.empty() ? options.form : program ? "formula" : "json";
    std::string result;
    try {
        result = program ? exported_program(*problem.simulator, text, form)
                         : exported_network(*problem.simulator, text, form,
                                            options.problem.memory_limit);
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
    command.summary = "Write a learned policy for people or other programs";
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
        "For CGP: formula (default), cpp, dot, svg, py, latex; for PPO: json (default), cpp, onnx",
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
