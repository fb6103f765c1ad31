// rddl info: what a problem is made of, as someone who picks a solver asks.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "engines/interpreted_simulator.hpp"
#include "formats/description.hpp"
#include "problems/front_end.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"

#include <fmt/format.h>

namespace rddlc::cli {

namespace {

struct InfoOptions {
    ProblemArguments problem;
    std::string policy_file;
    bool json = false;
};

ExitStatus info(const InfoOptions& options) {
    ProblemDescription description;
    description.files = options.problem.files();
    if (!options.policy_file.empty()) description.files.policy = options.policy_file;
    Compilation compilation =
        compile_or_give_up(compile_options(description.files, Stage::Optimise));
    description.model = *std::move(compilation.model);
    description.characteristics = characteristics_of(description.model);
    description.simulator =
        interpreted_simulator(*std::move(compilation.program), std::move(compilation.sources));
    description.refusals = solvers::refusals(*description.simulator);
    if (options.json)
        print("{}", json_document(description_json(description)));
    else
        print("{}", description_text(description));
    return success;
}

}  // namespace

Command info_command() {
    const auto options = std::make_shared<InfoOptions>();
    Command command;
    command.name = "info";
    command.summary = "Show what a problem consists of, and which learners take it";
    command.details =
        "Examples:\n"
        "  rddl info domain.rddl instance.rddl\n"
        "  rddl info Reservoir_ippc2023 1 --json\n"
        "  rddl info domain.rddl instance.rddl --policy policy.rddl";
    add_problem_arguments(command, options->problem);
    add_text_option(command, "--policy", "FILE", "Also read the policy block of this file",
                    options->policy_file);
    add_flag(command, "--json", "Print everything as JSON, layouts and bounds included",
             options->json);
    command.run = [options] {
        return info(*options);
    };
    return command;
}

}  // namespace rddlc::cli
