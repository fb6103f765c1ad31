#include "options.hpp"

#include <map>

namespace rddlc::cli {

void add_problem_arguments(CLI::App& command, ProblemArguments& arguments, bool required) {
    command
        .add_option("DOMAIN", arguments.first,
                    "Domain file, or NAME of a problem of rddlrepository")
        ->required(required);
    command.add_option("INSTANCE", arguments.second, "Instance file, or number of the instance");
}

void add_engine_options(CLI::App& command, LoadOptions& options) {
    const std::map<std::string, Engine> engines{{"compiled", Engine::Compiled},
                                                {"interpreter", Engine::Interpreter}};
    command.add_option("--engine", options.engine, "compiled (default) or interpreter")
        ->transform(CLI::CheckedTransformer(engines).description(""))
        ->type_name("ENGINE");
    command.add_flag("--no-cache", options.ignore_cache,
                     "Compile anew instead of using a simulator compiled before");
}

}  // namespace rddlc::cli
