#include "engines/load_simulator.hpp"

#include "cache/known_objects.hpp"
#include "driver/cpp_compiler.hpp"
#include "driver/extern_headers.hpp"
#include "driver/shared_object.hpp"
#include "engines/compiled_simulator.hpp"
#include "engines/external_library.hpp"
#include "engines/interpreted_simulator.hpp"
#include "engines/step_derivatives.hpp"
#include "engines/switching_simulator.hpp"
#include "problems/front_end.hpp"
#include "support/failure.hpp"
#include "support/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace rddlc::workbench {

namespace {

constexpr std::array<std::string_view, 3> engine_names = {"auto", "compiled", "interpreter"};

}  // namespace

std::string_view name_of(Engine engine) {
    return engine_names[static_cast<std::size_t>(engine)];
}
std::optional<Engine> engine_named(std::string_view name) {
    const auto found = std::ranges::find(engine_names, name);
    if (found == engine_names.end()) return std::nullopt;
    return static_cast<Engine>(found - engine_names.begin());
}

Engine engine_of(const LoadOptions& options) {
    if (options.engine != Engine::Auto) return options.engine;
    if (options.real == RealType::Float) return Engine::Compiled;
    const ExternFiles externs = extern_files(options.externs);
    if (!externs.shared_objects.empty()) return Engine::Interpreter;
    return externs.headers.empty() ? Engine::Auto : Engine::Compiled;
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

// The parts that emit_compilation uses of one that stopped before.
Compilation copy_to_emit(const Compilation& optimised) {
    Compilation copy({});
    copy.sources = optimised.sources;
    copy.program = optimised.program;
    copy.details = optimised.details;
    return copy;
}

// Nothing if the files alone do not determine the object.
std::optional<std::string> key_of(const ProblemFiles& files, const LoadOptions& options) {
    if (!options.remembers || options.engine == Engine::Interpreter || options.ignore_cache ||
        !options.externs.empty())
        return std::nullopt;
    const std::string told =
        fmt::format("{} {} {} {} {} {} {}", files.instance_name, static_cast<int>(files.standard),
                    static_cast<int>(options.real), options.lanes.value_or(0), options.details,
                    options.passes.fast_math, fmt::join(options.passes.without, ","));
    return key_of_files(files.all(), told);
}

CacheOptions cache_options(const ProblemFiles& files, const LoadOptions& options) {
    CacheOptions cache{.what = files.name,
                       .ignore_cache = options.ignore_cache,
                       .quiet = options.quiet,
                       .extern_headers = extern_files(options.externs).headers,
                       .on_begin = options.on_compiling};
    if (has_prepared_batches(options.lanes)) cache.linked_batches = options.real;
    return cache;
}

// The compiled simulator of an optimised program.
Simulator build_from(const Compilation& optimised, const ProblemFiles& files,
                     const LoadOptions& options, const std::stop_token& stop) {
    const Compilation emitted =
        emit_compilation(copy_to_emit(optimised), front_end_options(files, Stage::Emit, options));
    if (emitted.diagnostics.has_errors()) throw Failure(emitted.diagnostics.all().front().message);
    CacheOptions cache = cache_options(files, options);
    cache.quiet = true;
    cache.on_begin = {};
    cache.stop = stop;
    const CompiledSimulator compiled = compiled_simulator(emitted.text, cache);
    if (const auto key = key_of(files, options)) remember_object(*key, compiled.object.path);
    return compiled.simulator;
}

LoadedProblem switching(Compilation compilation, const ProblemFiles& files,
                        const LoadOptions& options) {
    if (!is_compiler_there()) {
        if (!options.quiet)
            tell(
                "warning: there is no C++ compiler '{}': the problem is interpreted, which is "
                "slower\n",
                cpp_compiler().front());
        return interpreted(std::move(compilation), files, options);
    }
    const auto to_emit = std::make_shared<const Compilation>(copy_to_emit(compilation));
    LoadedProblem problem = interpreted(std::move(compilation), files, options);
    const auto build = [to_emit, files, options](const std::stop_token& stop) {
        return build_from(*to_emit, files, options, stop);
    };
    const auto report = [name = files.name, quiet = options.quiet](const std::string& why) {
        if (!quiet) tell("warning: {} is interpreted, which is slower: {}\n", name, why);
    };
    problem.background = std::make_shared<BackgroundBuild>(build, report);
    problem.simulator = switching_simulator(problem.simulator, problem.background);
    return problem;
}

LoadedProblem built(const Compilation& compilation, const ProblemFiles& files,
                    const LoadOptions& options) {
    LoadCosts costs;
    const std::string& text = compilation.text;
    costs.emitted_lines = std::count(text.begin(), text.end(), '\n');
    costs.emitted_bytes = static_cast<std::int64_t>(text.size());
    const CompiledSimulator compiled = compiled_simulator(text, cache_options(files, options));
    costs.build_seconds = compiled.object.build_seconds;
    if (const auto key = key_of(files, options)) remember_object(*key, compiled.object.path);
    costs.object_bytes =
        static_cast<std::int64_t>(std::filesystem::file_size(compiled.object.path));
    LoadedProblem problem{files, compiled.simulator, costs};
    problem.is_compiled = true;
    return problem;
}

LoadedProblem loaded(Compilation compilation, const ProblemFiles& files,
                     const LoadOptions& options) {
    switch (engine_of(options)) {
        case Engine::Auto:
            return switching(std::move(compilation), files, options);
        case Engine::Compiled:
            return built(compilation, files, options);
        case Engine::Interpreter:
            break;
    }
    return interpreted(std::move(compilation), files, options);
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
    front_end.lane_count = options.lanes;
    return front_end;
}

Compilation compile_problem(const ProblemFiles& files, const LoadOptions& options) {
    return engine_of(options) == Engine::Compiled ? compile_to_build(files, options)
                                                  : compile_to_interpret(files, options);
}

LoadedProblem load_compilation(Compilation compilation, const ProblemFiles& files,
                               const LoadOptions& options) {
    LoadedProblem problem = loaded(std::move(compilation), files, options);
    problem.used = used_files(files, options);
    problem.derivatives = derivatives_of(files, options);
    return problem;
}

namespace {

// A cache that cannot be used is no reason for Engine::Auto not to start.
std::optional<std::filesystem::path> known_object_of(const ProblemFiles& files,
                                                     const LoadOptions& options) {
    try {
        const auto key = key_of(files, options);
        return key ? known_object(*key) : std::nullopt;
    } catch (const Failure&) {
        if (options.engine != Engine::Auto) throw;
        return std::nullopt;
    }
}

}  // namespace

std::optional<LoadedProblem> load_known(const ProblemFiles& files, const LoadOptions& options) {
    const auto object = known_object_of(files, options);
    Simulator simulator = object ? load_object(*object) : nullptr;
    if (!simulator) return std::nullopt;
    LoadedProblem problem{files, std::move(simulator), LoadCosts{}, used_files(files, options),
                          true};
    problem.derivatives = derivatives_of(files, options);
    return problem;
}

LoadedProblem load_problem(const ProblemFiles& files, const LoadOptions& options) {
    const Stopwatch watch;
    Compilation compilation = compile_problem(files, options);
    const double compile_seconds = watch.seconds();
    give_up_on_errors(compilation);
    print_policy_warnings(compilation, files);
    LoadedProblem problem = load_compilation(std::move(compilation), files, options);
    problem.costs.compile_seconds = compile_seconds;
    problem.costs.load_seconds = watch.seconds();
    return problem;
}

}  // namespace rddlc::workbench
