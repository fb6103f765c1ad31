// `rddl fit`: non-fluents from recorded steps.
#include "fitting/fit.hpp"

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "support/failure.hpp"
#include "support/program.hpp"

#include <fmt/format.h>

#include <memory>

namespace rddlc::cli {

namespace {

struct FitCommandOptions {
    ProblemArguments problem;
    LoadOptions load;
    FitOptions fit;
};

void print_fit(const Fit& found) {
    print("{:<24} {:>14} {:>14} {:>12}\n", "parameter", "was", "fitted", "+-");
    for (const FittedParameter& each : found.parameters)
        print("{:<24} {:>14.8g} {:>14.8g} {:>12.3g}\n", each.name, each.start, each.value,
              each.error);
    print("{} steps, {} iterations; error {:.4g}, before {:.4g}\n", found.steps, found.iterations,
          found.error_after, found.error_before);
    if (!found.has_converged)
        print("the search was ended by --iterations {}: more may fit better\n", found.iterations);
}

ExitStatus fit_problem(const FitCommandOptions& options) {
    if (options.fit.parameters.empty())
        throw Failure("say what is to be fitted: --parameters GAIN,DRAG", {}, usage_error);
    if (options.fit.traces.empty())
        throw Failure("there are no data: --data TRACE.jsonl", "'rddl run --trace FILE' makes them",
                      usage_error);
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    print_fit(fit(problem.files, options.load, *problem.simulator, options.fit));
    return success;
}

}  // namespace

Command fit_command() {
    const auto options = std::make_shared<FitCommandOptions>();
    Command command;
    command.name = "fit";
    command.summary = "Find real non-fluents from recorded steps";
    command.details =
        "Changes the non-fluents, each grounding by itself, until steps of the problem lead to\n"
        "what the traces say: nonlinear least squares with exact derivatives (docs/planning.md).\n"
        "Where a step draws at random, its mean over some draws counts. Values of the instance\n"
        "are where the search begins. +- is a standard error.\n\n"
        "Examples:\n"
        "  rddl run domain.rddl instance.rddl --episodes 5 --trace steps.jsonl\n"
        "  rddl fit domain.rddl guess.rddl --data steps.jsonl --parameters GAIN,DRAG";
    add_problem_arguments(command, options->problem);
    add_option(command, "--data", "TRACE,...", "Traces of the steps",
               [options](const std::string& list) {
                   for (const std::string& word : solvers::words_of_list(list))
                       options->fit.traces.emplace_back(word);
               });
    add_option(command, "--parameters", "NAME,...", "Real non-fluents",
               [options](const std::string& list) {
                   options->fit.parameters = solvers::words_of_list(list);
               });
    add_number_option(command, "--draws", "N",
                      "Draws whose mean a step is expected to lead to (16)", options->fit.draws, 1,
                      1'000'000);
    add_number_option(command, "--iterations", "N", "Steps of the search, at most (100)",
                      options->fit.iterations, 0, 1'000'000);
    options->load.engine = Engine::Interpreter;
    command.run = [options] {
        return fit_problem(*options);
    };
    return command;
}

}  // namespace rddlc::cli
