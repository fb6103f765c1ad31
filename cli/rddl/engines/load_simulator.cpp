#include "engines/load_simulator.hpp"

#include "driver/extern_headers.hpp"
#include "engines/compiled_simulator.hpp"
#include "engines/external_library.hpp"
#include "engines/interpreted_simulator.hpp"
#include "problems/front_end.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace rddlc::cli {

std::string_view name_of(Engine engine) {
    return engine == Engine::Compiled ? "compiled" : "interpreter";
}

namespace {

class Stopwatch {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

LoadedProblem interpreted(const ProblemFiles& files, const LoadOptions& options) {
    if (options.real != RealType::Double)
        throw Failure("the interpreter computes with doubles",
                      "leave out --real=float, or use --engine=compiled", usage_error);
    const ExternFiles externs = extern_files(options.externs);
    const Stopwatch watch;
    LoadCosts costs;
    Compilation compilation =
        compile_or_give_up(front_end_options(files, Stage::Optimise, options));
    costs.compile_seconds = watch.seconds();
    if (options.externs.empty())
        report_undefined_externals(*compilation.program, {}, compilation.diagnostics);
    give_up_on_errors(compilation);
    ExternalLibrary library = external_library(*compilation.program, files, options);
    Simulator simulator =
        interpreted_simulator(*std::move(compilation.program), std::move(compilation.sources),
                              std::move(library), std::move(compilation.details));
    costs.load_seconds = watch.seconds();
    return {files, std::move(simulator), costs};
}

LoadedProblem compiled(const ProblemFiles& files, const LoadOptions& options) {
    const ExternFiles externs = extern_files(options.externs);
    if (!externs.shared_objects.empty())
        throw Failure(fmt::format("the compiled engine takes external functions from a C++ header, "
                                  "not from '{}'",
                                  externs.shared_objects.front().string()),
                      "name the header, or use --engine=interpreter", usage_error);
    const Stopwatch watch;
    LoadCosts costs;
    CompileOptions emitting = front_end_options(files, Stage::Emit, options);
    emitting.real = options.real;
    const Compilation compilation = compile_or_give_up(emitting);
    costs.compile_seconds = watch.seconds();
    const std::string& text = compilation.text;
    costs.emitted_lines = std::count(text.begin(), text.end(), '\n');
    costs.emitted_bytes = static_cast<std::int64_t>(text.size());
    const CompiledSimulator compiled = compiled_simulator(
        text, {files.name, options.ignore_cache, options.quiet, externs.headers});
    costs.build_seconds = compiled.object.build_seconds;
    costs.object_bytes =
        static_cast<std::int64_t>(std::filesystem::file_size(compiled.object.path));
    costs.load_seconds = watch.seconds();
    return {files, compiled.simulator, costs};
}

UsedFiles used_files(const ProblemFiles& files, const LoadOptions& options) {
    const ExternFiles externs = extern_files(options.externs);
    UsedFiles used;
    for (const auto& all :
         {files.all(), with_included_files(externs.headers), externs.shared_objects})
        for (const std::filesystem::path& file : all) used.add(file);
    return used;
}

}  // namespace

CompileOptions front_end_options(const ProblemFiles& files, Stage last,
                                 const LoadOptions& options) {
    CompileOptions front_end = compile_options(files, last);
    front_end.extern_headers = extern_files(options.externs).headers;
    front_end.passes = options.passes;
    front_end.details = options.details;
    return front_end;
}

LoadedProblem load_problem(const ProblemFiles& files, const LoadOptions& options) {
    LoadedProblem problem = options.engine == Engine::Interpreter ? interpreted(files, options)
                                                                  : compiled(files, options);
    problem.used = used_files(files, options);
    return problem;
}

}  // namespace rddlc::cli
