#include "load_simulator.hpp"

#include "compiled_simulator.hpp"
#include "interpreted_simulator.hpp"

#include <utility>

namespace rddlc::cli {

std::string_view name_of(Engine engine) {
    return engine == Engine::Compiled ? "compiled" : "interpreter";
}

Simulator load_simulator(CheckedProblem problem, const LoadOptions& options) {
    ir::Program program = ground_problem(problem);
    if (options.engine == Engine::Interpreter)
        return interpreted_simulator(std::move(program), std::move(problem.sources));
    return compiled_simulator(program, problem.sources,
                              {problem.files.name, options.ignore_cache, options.quiet});
}

LoadedProblem load_problem(const ProblemFiles& files, const LoadOptions& options) {
    CheckedProblem problem = check_problem(files);
    report(problem);
    return {files, load_simulator(std::move(problem), options)};
}

}  // namespace rddlc::cli
