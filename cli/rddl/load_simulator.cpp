#include "load_simulator.hpp"

#include "compiled_simulator.hpp"
#include "front_end.hpp"
#include "interpreted_simulator.hpp"

#include <utility>

namespace rddlc::cli {

std::string_view name_of(Engine engine) {
    return engine == Engine::Compiled ? "compiled" : "interpreter";
}

LoadedProblem load_problem(const ProblemFiles& files, const LoadOptions& options) {
    if (options.engine == Engine::Interpreter) {
        Compilation compilation = compile_or_give_up(files, Stage::Optimise);
        return {files, interpreted_simulator(*std::move(compilation.program),
                                             std::move(compilation.sources))};
    }
    const Compilation compilation = compile_or_give_up(files, Stage::Emit);
    return {files, compiled_simulator(compilation.text,
                                      {files.name, options.ignore_cache, options.quiet})};
}

}  // namespace rddlc::cli
