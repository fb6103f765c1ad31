// `rddl fit`: non-fluents from recorded steps.
#include "fitting/fit.hpp"

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "support/failure.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace rddlc::cli {

namespace {

struct FitCommandOptions {
    ProblemArguments problem;
    LoadOptions load;
    FitOptions fit;
};

// Says where the search was when the signal came, which is not a result.
void tell_where_it_stopped(const Fit& found) {
    std::string values;
    for (const FittedParameter& each : found.parameters)
        values += fmt::format("{}{} = {:.8g}", values.empty() ? ": " : ", ", each.name, each.value);
    tell("rddl: interrupted after {} iterations; the values are not fitted yet{}\n",
         found.iterations, values);
}

void warn(const Fit& found, const FitCommandOptions& options, bool is_stochastic) {
    if (found.faulted > 0)
        tell("rddl: warning: {} recorded steps faulted, and are left out\n", found.faulted);
    if (is_stochastic)
        tell(
            "rddl: warning: the problem draws at random, and each step is compared with the mean "
            "of {} draws: a fit is biased where noise depends on the parameters, and +- does not "
            "cover this; more --draws lessen it (docs/planning.md)\n",
            options.fit.draws);
    constexpr double huge = 1e6;
    for (const FittedParameter& each : found.parameters)
        if (each.error > huge * std::abs(each.value))
            tell(
                "rddl: warning: the error of '{}' is more than {:g} times its value: the recorded "
                "steps hardly depend on it, or it is 0\n",
                each.name, huge);
}

void print_fit(const Fit& found) {
    print("{:<24} {:>14} {:>14} {:>12}\n", "parameter", "was", "fitted", "+-");
    for (const FittedParameter& each : found.parameters)
        print("{:<24} {:>14.8g} {:>14.8g} {:>12.3g}\n", each.name, each.start, each.value,
              each.error);
    print("{} steps, {} iteration{}; error {:.4g}, before {:.4g}\n", found.steps, found.iterations,
          found.iterations == 1 ? "" : "s", found.error_after, found.error_before);
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
    FitOptions fitting = options.fit;
    fitting.stops = is_interrupted;
    const Fit found = fit(problem.files, options.load, *problem.simulator, fitting);
    if (found.interrupted) {
        tell_where_it_stopped(found);
        return interrupted_status();
    }
    print_fit(found);
    warn(found, options, problem.simulator->problem->stochastic);
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
        "Each line of a trace counts by itself. Where a step draws at random, its mean over some\n"
        "draws counts. Values of the instance are where the search begins. +- is a standard\n"
        "error.\n\n"
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
    add_seed_option(command, options->fit.seed, "Seed of these draws (0)");
    add_number_option(command, "--iterations", "N", "Steps of the search, at most (100)",
                      options->fit.iterations, 0, 1'000'000);
    options->load.engine = Engine::Interpreter;
    command.run = [options] {
        return fit_problem(*options);
    };
    return command;
}

}  // namespace rddlc::cli
