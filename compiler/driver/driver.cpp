#include "driver/driver.hpp"

#include "ast/print.hpp"
#include "check/check.hpp"
#include "details/make_details.hpp"
#include "driver/codes.hpp"
#include "driver/extern_headers.hpp"
#include "driver/files.hpp"
#include "driver/given_blocks.hpp"
#include "driver/large_tables.hpp"
#include "driver/version.hpp"
#include "driver/write.hpp"
#include "emit/emit.hpp"
#include "ground/faults_in_domain.hpp"
#include "ground/ground.hpp"
#include "ground/memory.hpp"
#include "ir/analysis.hpp"
#include "ir/lane_count.hpp"
#include "ir/print.hpp"
#include "ir/verify.hpp"
#include "model/print.hpp"
#include "parse/parse.hpp"
#include "passes/arithmetic/byte_ints.hpp"
#include "passes/passes.hpp"
#include "support/match.hpp"
#include "support/render.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace rddlc {
namespace {

// Refuses --real=float where it is of no use: policies and functions of whole tables compute with
// doubles, and a register may hold more than 8 floats.
void refuse_float_reals(const CompileOptions& options, const ir::Program& program,
                        Diagnostics& diagnostics) {
    const auto refuse = [&](const std::string& why) {
        diagnostics.report({no_float_reals, {}, "--real=float is not possible " + why});
    };
    if (program.policy) refuse("with a policy block, which computes with doubles");
    if (std::ranges::any_of(ir::blocks_of(program),
                            [](const ir::Block* block) { return ir::calls_functions(*block); }))
        refuse("here: matrices, random vectors and external functions compute with doubles");
    if (options.lane_count == 8) refuse("with --lanes=8: a register may hold 16 floats");
}

void warn_of_idle_lanes(const CompileOptions& options, const ir::Program& program,
                        Diagnostics& diagnostics) {
    const std::string_view why = ir::why_without_packs(program);
    if (options.lane_count.value_or(1) == 1 || why.empty()) return;
    diagnostics.report(Diagnostic{
        idle_lanes, {}, fmt::format("--lanes={} has no effect {}", *options.lane_count, why)}
                           .with_hint("such a simulator computes one environment at a time"));
}

constexpr std::array<std::string_view, 8> stage_names = {"read",   "parse",    "check", "ground",
                                                         "verify", "optimise", "emit",  "write"};
constexpr std::array<std::string_view, 5> form_names = {"ast", "model", "ir", "ir-opt", "cpp"};

// The enumerator whose name it is.
template <class Enumeration, std::size_t n>
std::optional<Enumeration> named(const std::array<std::string_view, n>& names,
                                 std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return std::nullopt;
    return static_cast<Enumeration>(found - names.begin());
}

// One compilation under way: measures stages, prints forms, knows when to stop.
class Run {
  public:
    explicit Run(const CompileOptions& all) : options(all), result(all.diagnostics) {}

    template <class Work>
    auto measure(Stage stage, Work&& work) {
        const auto begin = std::chrono::steady_clock::now();
        auto value = work();
        result.times.push_back({stage, std::chrono::steady_clock::now() - begin});
        return value;
    }

    // Whether there is nothing to do after this stage.
    bool ends_after(Stage stage) const {
        return result.diagnostics.has_errors() || options.stop_after == stage;
    }

    template <class Print>
    void show(Form form, Print&& print) {
        if (options.print.contains(form)) result.printed += print();
    }

    const CompileOptions& options;
    Compilation result;
};

void set_real(ir::Program& program, RealType real) {
    program.real = real;
    if (program.moderate) set_real(**program.moderate, real);
}

// Behind the program the one that makes most steps, if there is one.
std::string both_printed(const ir::Program& program) {
    if (!program.moderate) return ir::print(program);
    return ir::print(program) + "\nsteps of moderate states and actions\n\n" +
           ir::print(**program.moderate);
}

ir::Program verified(ir::Program program) {
    std::string complaints;
    for (const std::string& complaint : ir::verify(program)) complaints += "\n  " + complaint;
    if (program.moderate) program.moderate = verified(std::move(**program.moderate));
    if (!complaints.empty()) throw std::logic_error("the IR is not valid:" + complaints);
    return program;
}

EmitOptions emit_options(const CompileOptions& options, const ir::Program& program) {
    const std::string name = options.output ? options.output->filename().string() : "simulator.cpp";
    return {.header = output_kind(name) == OutputKind::Header,
            .entry = options.entry,
            .line_directives = options.line_directives,
            .lane_count = options.lane_count.value_or(ir::suitable_lane_count(program)),
            .byte_ints = !options.lane_count && ir::suits_byte_ints(program) &&
                         passes::has_byte_ints(program),
            .output_name = name,
            .compiler_version = version,
            .extern_headers = include_paths(options)};
}

// With several inputs, one must be the instance.
bool may_stand_alone(const CompileOptions& options) {
    return options.domain_may_stand_alone && options.inputs.size() == 1;
}

// IR -> C++.
void run_emit(Run& run) {
    Compilation& result = run.result;
    Diagnostics& diagnostics = result.diagnostics;
    report_undefined_externals(*result.program, run.options, diagnostics);
    report_large_constant_tables(*result.program, diagnostics);
    if (run.options.real == RealType::Float)
        refuse_float_reals(run.options, *result.program, diagnostics);
    warn_of_idle_lanes(run.options, *result.program, diagnostics);
    if (diagnostics.has_errors()) return;
    const EmitOptions emitting = emit_options(run.options, *result.program);
    result.text = run.measure(Stage::Emit, [&] {
        return emit(*result.program, result.sources, emitting,
                    result.details ? &*result.details : nullptr);
    });
    result.declaration = emit_declaration(*result.program, emitting);
    run.show(Form::Cpp, [&] { return result.text; });
}

void run_stages(Run& run) {
    Compilation& result = run.result;
    Diagnostics& diagnostics = result.diagnostics;

    // The text of the files; the output must be a place to write to.
    const auto files = run.measure(Stage::Read, [&] {
        return read_inputs(run.options, result.sources, result.used, diagnostics);
    });
    if (run.ends_after(Stage::Read)) return;

    // Text -> what was written.
    const Standard standard = run.options.standard;
    auto tree = run.measure(Stage::Parse,
                            [&] { return parse(result.sources, files, diagnostics, standard); });
    if (diagnostics.has_errors()) return;
    if (run.options.policy) take_policy_alone(tree, files.back(), result.sources, diagnostics);
    if (!run.options.instance.empty()) take_instance(tree, run.options.instance, diagnostics);
    if (diagnostics.has_errors()) return;
    if (run.options.extend) run.options.extend(tree, result.sources, diagnostics);
    if (diagnostics.has_errors()) return;
    run.show(Form::Ast, [&] { return ast::print(tree); });
    if (run.ends_after(Stage::Parse)) return;

    // A problem without an instance has no model, but much to check.
    if (may_stand_alone(run.options) && is_domain_alone(tree)) {
        result.is_domain_alone = true;
        const auto domain = run.measure(Stage::Check, [&] {
            return check_domain(tree, result.sources, diagnostics, standard);
        });
        if (!domain || run.ends_after(Stage::Check)) return;
        run.measure(Stage::Ground, [&] {
            warn_of_faults_in_domain(*domain, diagnostics);
            return 0;
        });
        return;
    }

    // Text to meaning: names, types, casts, the order of the CPFs.
    result.model = run.measure(Stage::Check,
                               [&] { return check(tree, result.sources, diagnostics, standard); });
    if (diagnostics.has_errors()) return;
    run.show(Form::Model, [&] { return model::print(*result.model); });
    if (run.ends_after(Stage::Check)) return;

    // Model -> IR: objects become integers, non-fluents tables, CPFs loops.
    auto grounded = run.measure(Stage::Ground, [&] {
        return ground(*result.model, diagnostics, run.options.memory_limit);
    });
    if (diagnostics.has_errors()) return;
    set_real(*grounded, run.options.real);
    if (!grounded->externals.empty())
        grounded->fingerprint = with_extern_headers(grounded->fingerprint, run.options);
    run.show(Form::Ir, [&] { return ir::print(*grounded); });
    if (run.ends_after(Stage::Ground)) return;

    // The IR keeps its invariants, or else the compiler is wrong.
    result.program = run.measure(Stage::Verify, [&] { return verified(*std::move(grounded)); });
    // The program for --details, built from unoptimised IR.
    if (run.options.details) {
        result.details = make_details(*result.program);
        result.details->program = verified(std::move(result.details->program));
    }
    if (run.ends_after(Stage::Verify)) return;

    // IR -> IR that computes the same values with less work.
    result.program = run.measure(Stage::Optimise, [&] {
        return verified(optimise(*std::move(result.program), run.options.passes, &result.passes));
    });
    report_memory(*result.program, run.options.memory_limit, diagnostics);
    if (diagnostics.has_errors()) return;
    run.show(Form::OptimisedIr, [&] { return both_printed(*result.program); });
    if (run.ends_after(Stage::Optimise)) return;

    run_emit(run);
    if (run.ends_after(Stage::Emit)) return;

    // C++ -> the output file, through the C++ compiler if it is a shared object.
    run.measure(Stage::Write, [&] {
        write_outputs(run.options, {result.text, result.declaration}, result.used, diagnostics);
        return 0;
    });
}

}  // namespace

std::string_view name_of(Stage stage) {
    return stage_names[static_cast<std::size_t>(stage)];
}
std::optional<Stage> stage_named(std::string_view name) {
    return named<Stage>(stage_names, name);
}

std::string_view name_of(Form form) {
    return form_names[static_cast<std::size_t>(form)];
}
std::optional<Form> form_named(std::string_view name) {
    return named<Form>(form_names, name);
}

Stage stage_of(Form form) {
    switch (form) {
        case Form::Ast:
            return Stage::Parse;
        case Form::Model:
            return Stage::Check;
        case Form::Ir:
            return Stage::Ground;
        case Form::OptimisedIr:
            return Stage::Optimise;
        case Form::Cpp:
            break;
    }
    return Stage::Emit;
}

Compilation compile(const CompileOptions& options) {
    Run run(options);
    run_stages(run);
    run.result.diagnostics.sort_by_position();
    return std::move(run.result);
}

Compilation emit_compilation(Compilation optimised, const CompileOptions& options) {
    Run run(options);
    run.result.sources = std::move(optimised.sources);
    run.result.program = std::move(optimised.program);
    run.result.details = std::move(optimised.details);
    run_emit(run);
    return std::move(run.result);
}

std::vector<std::string> pass_names() {
    std::vector<std::string> names;
    for (const PassDescription& pass : all_passes()) names.emplace_back(pass.name);
    return names;
}

std::optional<std::string> complaint_about_pass(std::string_view name) {
    const std::vector<std::string> known = pass_names();
    if (std::ranges::find(known, name) != known.end()) return std::nullopt;
    std::string complaint = "there is no pass '" + std::string(name) + "'";
    if (const auto near = did_you_mean(name, known)) complaint += "; did you mean '" + *near + "'?";
    return complaint;
}

const std::string_view no_instance_given =
    "no instance was given: objects, values and what depends on them were not checked";

std::string closing_lines(const Compilation& compilation, std::string_view program) {
    std::string lines = closing_lines(compilation.diagnostics, program);
    if (compilation.is_domain_alone) lines += fmt::format("{}\n", no_instance_given);
    return lines;
}

}  // namespace rddlc
