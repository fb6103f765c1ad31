// rddl info: the characteristics of a problem that matter for the choice of a solver.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/description.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"

namespace rddlc::cli {

namespace {

struct InfoOptions {
    ProblemArguments problem;
    std::string policy_file;
    bool json = false;
};

ExitStatus info(const InfoOptions& options) {
    ProblemFiles files = options.problem.files();
    if (!options.policy_file.empty()) files.policy = options.policy_file;
    const ProblemDescription description = describe(files);
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
