#include "load_simulator.hpp"

#include "compiled_simulator.hpp"
#include "driver/extern_headers.hpp"
#include "external_library.hpp"
#include "failure.hpp"
#include "front_end.hpp"
#include "interpreted_simulator.hpp"

#include <fmt/format.h>

#include <utility>

namespace rddlc::cli {

std::string_view name_of(Engine engine) {
    return engine == Engine::Compiled ? "compiled" : "interpreter";
}

namespace {

LoadedProblem interpreted(const ProblemFiles& files, const LoadOptions& options) {
    const ExternFiles externs = extern_files(options.externs);
    Compilation compilation =
        compile_or_give_up(files, Stage::Optimise, externs.headers, options.passes);
    if (options.externs.empty())
        report_undefined_externals(*compilation.program, {}, compilation.diagnostics);
    give_up_on_errors(compilation);
    ExternalLibrary library = external_library(*compilation.program, files, options);
    return {files, interpreted_simulator(*std::move(compilation.program),
                                         std::move(compilation.sources), std::move(library))};
}

LoadedProblem compiled(const ProblemFiles& files, const LoadOptions& options) {
    const ExternFiles externs = extern_files(options.externs);
    if (!externs.shared_objects.empty())
        throw Failure(fmt::format("the compiled engine takes external functions from a C++ header, "
                                  "not from '{}'",
                                  externs.shared_objects.front().string()),
                      "name the header, or use --engine=interpreter", usage_error);
    const Compilation compilation =
        compile_or_give_up(files, Stage::Emit, externs.headers, options.passes);
    return {files, compiled_simulator(compilation.text, {files.name, options.ignore_cache,
                                                         options.quiet, externs.headers})};
}

}  // namespace

LoadedProblem load_problem(const ProblemFiles& files, const LoadOptions& options) {
    return options.engine == Engine::Interpreter ? interpreted(files, options)
                                                 : compiled(files, options);
}

}  // namespace rddlc::cli
