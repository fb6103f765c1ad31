// rddl info: what a problem is made of, as someone who picks a solver asks.
#include "commands.hpp"
#include "description.hpp"
#include "front_end.hpp"
#include "interpreted_simulator.hpp"
#include "options.hpp"

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
    Compilation compilation = compile_or_give_up(description.files, Stage::Optimise);
    description.model = *std::move(compilation.model);
    description.characteristics = characteristics_of(description.model);
    description.simulator =
        interpreted_simulator(*std::move(compilation.program), std::move(compilation.sources));
    if (options.json)
        fmt::print("{}\n", description_json(description).dump(2));
    else
        fmt::print("{}", description_text(description));
    return success;
}

}  // namespace

Command add_info_command(CLI::App& program) {
    CLI::App* const app =
        program.add_subcommand("info", "Show fluents, sizes and characteristics of a problem");
    app->footer(
        "Examples:\n"
        "  rddl info domain.rddl instance.rddl\n"
        "  rddl info Reservoir_ippc2023 1 --json\n"
        "  rddl info domain.rddl instance.rddl --policy policy.rddl");
    const auto options = std::make_shared<InfoOptions>();
    add_problem_arguments(*app, options->problem);
    app->add_option("--policy", options->policy_file, "Take the policy block of this file, too")
        ->type_name("FILE");
    app->add_flag("--json", options->json, "Print everything as JSON, layouts and bounds included");
    return {app, [options] {
                return info(*options);
            }};
}

}  // namespace rddlc::cli
