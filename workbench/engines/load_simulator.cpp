#include "engines/load_simulator.hpp"

#include "cache/known_objects.hpp"
#include "driver/extern_headers.hpp"
#include "engines/compiled_simulator.hpp"
#include "engines/external_library.hpp"
#include "engines/interpreted_simulator.hpp"
#include "problems/front_end.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace rddlc::workbench {

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

Compilation compile_to_interpret(const ProblemFiles& files, const LoadOptions& options) {
    if (options.real != RealType::Double)
        throw Failure("the interpreter computes with doubles",
                      "leave out --real=float, or use --engine=compiled", usage_error);
    Compilation compilation = compile(front_end_options(files, Stage::Optimise, options));
    if (options.externs.empty() && compilation.program)
        report_undefined_externals(*compilation.program, {}, compilation.diagnostics);
    return compilation;
}

Compilation compile_to_build(const ProblemFiles& files, const LoadOptions& options) {
    const ExternFiles externs = extern_files(options.externs);
    if (!externs.shared_objects.empty())
        throw Failure(fmt::format("the compiled engine takes external functions from a C++ header, "
                                  "not from '{}'",
                                  externs.shared_objects.front().string()),
                      "name the header, or use --engine=interpreter", usage_error);
    CompileOptions emitting = front_end_options(files, Stage::Emit, options);
    emitting.real = options.real;
    return compile(emitting);
}

LoadedProblem interpreted(Compilation compilation, const ProblemFiles& files,
                          const LoadOptions& options) {
    ExternalLibrary library = external_library(*compilation.program, files, options);
    return {files,
            interpreted_simulator(*std::move(compilation.program), std::move(compilation.sources),
                                  std::move(library), std::move(compilation.details)),
            LoadCosts{}};
}

// Nothing if the files alone do not determine the object.
std::optional<std::string> key_of(const ProblemFiles& files, const LoadOptions& options) {
    if (!options.remembers || options.engine != Engine::Compiled || options.ignore_cache ||
        !options.externs.empty())
        return std::nullopt;
    const std::string told =
        fmt::format("{} {} {} {} {} {}", files.instance_name, static_cast<int>(files.standard),
                    static_cast<int>(options.real), options.details, options.passes.fast_math,
                    fmt::join(options.passes.without, ","));
    return key_of_files(files.all(), told);
}

LoadedProblem built(const Compilation& compilation, const ProblemFiles& files,
                    const LoadOptions& options) {
    LoadCosts costs;
    const std::string& text = compilation.text;
    costs.emitted_lines = std::count(text.begin(), text.end(), '\n');
    costs.emitted_bytes = static_cast<std::int64_t>(text.size());
    const CompiledSimulator compiled =
        compiled_simulator(text, {files.name, options.ignore_cache, options.quiet,
                                  extern_files(options.externs).headers, options.real});
    costs.build_seconds = compiled.object.build_seconds;
    if (const auto key = key_of(files, options)) remember_object(*key, compiled.object.path);
    costs.object_bytes =
        static_cast<std::int64_t>(std::filesystem::file_size(compiled.object.path));
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

Compilation compile_problem(const ProblemFiles& files, const LoadOptions& options) {
    return options.engine == Engine::Interpreter ? compile_to_interpret(files, options)
                                                 : compile_to_build(files, options);
}

LoadedProblem load_compilation(Compilation compilation, const ProblemFiles& files,
                               const LoadOptions& options) {
    LoadedProblem problem = options.engine == Engine::Interpreter
                                ? interpreted(std::move(compilation), files, options)
                                : built(compilation, files, options);
    problem.used = used_files(files, options);
    return problem;
}

std::optional<LoadedProblem> load_known(const ProblemFiles& files, const LoadOptions& options) {
    const auto key = key_of(files, options);
    const auto object = key ? known_object(*key) : std::nullopt;
    Simulator simulator = object ? load_object(*object) : nullptr;
    if (!simulator) return std::nullopt;
    return LoadedProblem{files, std::move(simulator), LoadCosts{}, used_files(files, options)};
}

LoadedProblem load_problem(const ProblemFiles& files, const LoadOptions& options) {
    const Stopwatch watch;
    Compilation compilation = compile_problem(files, options);
    const double compile_seconds = watch.seconds();
    give_up_on_errors(compilation);
    LoadedProblem problem = load_compilation(std::move(compilation), files, options);
    problem.costs.compile_seconds = compile_seconds;
    problem.costs.load_seconds = watch.seconds();
    return problem;
}

}  // namespace rddlc::workbench
