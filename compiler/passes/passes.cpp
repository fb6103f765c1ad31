#include "passes/passes.hpp"

#include "ir/analysis.hpp"
#include "ir/cost_model.hpp"
#include "ir/verify.hpp"
#include "passes/aggregations/compare_counts.hpp"
#include "passes/aggregations/count_bits.hpp"
#include "passes/aggregations/count_bools.hpp"
#include "passes/aggregations/factor_aggregations.hpp"
#include "passes/aggregations/fuse_interm_fluents.hpp"
#include "passes/aggregations/hoist_aggregations.hpp"
#include "passes/aggregations/index_directly.hpp"
#include "passes/aggregations/make_aggregations_sparse.hpp"
#include "passes/aggregations/merge_draws.hpp"
#include "passes/aggregations/search_intervals.hpp"
#include "passes/aggregations/skip_zero_terms.hpp"
#include "passes/aggregations/tabulate_counts.hpp"
#include "passes/arithmetic/compare_magnitudes.hpp"
#include "passes/arithmetic/fast_math.hpp"
#include "passes/arithmetic/find_ranges.hpp"
#include "passes/arithmetic/prove_invariants.hpp"
#include "passes/arithmetic/reduce_strength.hpp"
#include "passes/arithmetic/straighten_rows.hpp"
#include "passes/constants/fold_constant_expressions.hpp"
#include "passes/constants/fold_uniform_tables.hpp"
#include "passes/constants/tabulate_constant_fluents.hpp"
#include "passes/constants/tabulate_constants.hpp"
#include "passes/lanes/evaluate_together.hpp"
#include "passes/lanes/read_places.hpp"
#include "passes/lanes/separate_aggregations.hpp"
#include "passes/lanes/separate_counts.hpp"
#include "passes/lanes/separate_draws.hpp"
#include "passes/lanes/unroll_rows.hpp"
#include "passes/sharing/remove_unused_buffers.hpp"
#include "passes/sharing/share_across_definitions.hpp"
#include "passes/sharing/share_subexpressions.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rddlc {
namespace {

enum Trait : unsigned {
    only_fast_math = 1,
    leaves_out_zeros = 2,  // what is multiplied by zero, where it is finite
};

struct Pass {
    const char* name;
    const char* summary;
    ir::Program (*run)(ir::Program, passes::Report&);
    unsigned traits = 0;

    bool has(Trait trait) const { return (traits & trait) != 0; }
};

// A pass may stand here several times.
constexpr Pass in_order[] = {
    {"tabulate_constant_fluents", "interm-fluents that the instance fixes become tables",
     passes::tabulate_constant_fluents},
    {"fold_uniform_tables", "a table of equal entries becomes a scalar",
     passes::fold_uniform_tables},
    {"fold_constant_expressions", "what only tables decide is evaluated now",
     passes::fold_constant_expressions},
    {"find_ranges", "finds within which range a real lies, for the passes below",
     passes::find_ranges},
    {"fast_math", "only with --fast-math: what is right for real numbers, if not for floating ones",
     passes::fast_math, only_fast_math},
    {"reduce_strength", "operators with cheaper equals: products for divisions and powers",
     passes::reduce_strength},
    {"fuse_interm_fluents",
     "interm-fluents read once, or cheap ones, are computed where they are read",
     passes::fuse_interm_fluents},
    {"prove_invariants", "only with --fast-math: an invariant that every step keeps is not tested",
     passes::prove_invariants, only_fast_math},
    {"index_directly", "an aggregation to which one object contributes takes that object",
     passes::index_directly, leaves_out_zeros},
    {"search_intervals", "what depends on the interval of a number becomes a binary search",
     passes::search_intervals, leaves_out_zeros},
    {"count_bools", "sums of reals that only count, in steps of constants, count in ints",
     passes::count_bools},
    {"compare_counts", "an exists or forall of what is counted, too, compares the count",
     passes::compare_counts},
    {"merge_draws", "draws of two branches that have the same random numbers become one",
     passes::merge_draws},
    {"factor_aggregations", "aggregations leave out factors that they do not change",
     passes::factor_aggregations},
    {"hoist_aggregations", "what depends on few of the loops around it becomes a table",
     passes::hoist_aggregations},
    {"make_aggregations_sparse", "aggregations run over the entries of sparse tables",
     passes::make_aggregations_sparse, leaves_out_zeros},
    {"tabulate_counts", "what a count, or another small int, decides becomes a table",
     passes::tabulate_counts},
    {"straighten_rows", "only with --fast-math: rows of tables that are nearly lines become lines",
     passes::straighten_rows, only_fast_math},
    {"tabulate_constants", "what tables and loop variables decide becomes a table",
     passes::tabulate_constants},
    {"skip_zero_terms", "sums compute only the expensive terms that a bool lets count",
     passes::skip_zero_terms, leaves_out_zeros},
    {"count_bits", "sums and tests over tables of bools work on the bits of ints",
     passes::count_bits},
    {"compare_magnitudes", "two opposite bounds of a real become one of its absolute value",
     passes::compare_magnitudes},
    {"share_across_definitions", "what several CPFs compute is computed once",
     passes::share_across_definitions},
    {"separate_counts", "sums that count bools leave them to tables, whose bits are counted",
     passes::separate_counts},
    {"read_places",
     "bools that constants choose are read by their places, for several objects at once",
     passes::read_places},
    {"separate_draws", "loops over bools leave their draws to tables, to run over words of bools",
     passes::separate_draws},
    {"separate_aggregations",
     "loops and sums leave aggregations and terms to tables, to run over several objects at once",
     passes::separate_aggregations},
    {"unroll_rows", "small tables of sums over rows are filled without loops", passes::unroll_rows},
    {"remove_unused_buffers", "tables and interm-fluents that nobody reads go",
     passes::remove_unused_buffers},
    {"share_subexpressions", "what is used twice, or does not change in a loop, gets a name",
     passes::share_subexpressions},
    // Again, as what has a name is cheap now.
    {"reduce_strength", "operators with cheaper equals: products for divisions and powers",
     passes::reduce_strength},
    {"evaluate_together", "loops over several objects at once fill vector registers",
     passes::evaluate_together},
};

}  // namespace

std::vector<PassDescription> all_passes() {
    std::vector<PassDescription> passes;
    for (const Pass& pass : in_order) {
        const auto known = std::ranges::find(passes, pass.name, &PassDescription::name);
        if (known == passes.end())
            passes.push_back({pass.name, pass.summary, pass.has(only_fast_math)});
    }
    return passes;
}

ProgramSize size_of(const ir::Program& program) {
    const std::vector<bool> reachable = ir::reachable_nodes(program);
    return {.nodes = static_cast<std::size_t>(std::ranges::count(reachable, true)),
            .operations = ir::cost_of_step(program)};
}

namespace {

// Runs a pass on the program, which has `size`. The program stays as it was if a step of the result
// costs more, and the run says so.
PassRun run_pass(const Pass& pass, ir::Program& program, const ProgramSize& size) {
    PassRun run{
        .name = pass.name, .report = {}, .undone = false, .before = size, .after = {}, .time = {}};
    const auto begin = std::chrono::steady_clock::now();
    ir::Program made = pass.run(program, run.report);  // constant tables are shared
    run.time = std::chrono::steady_clock::now() - begin;
    run.after = size_of(made);
    run.undone = run.after.operations > size.operations;
    if (run.undone) {
        run.after = size;
        run.report.clear();
    } else {
        program = std::move(made);
    }
    return run;
}

// Adds what the passes did to `runs`.
ir::Program run_passes(ir::Program program, const PassOptions& options,
                       std::vector<PassRun>& runs) {
    ProgramSize size = size_of(program);
    for (const Pass& pass : in_order) {
        if (options.without.contains(pass.name)) continue;
        if (pass.has(only_fast_math) && !options.fast_math) continue;
        PassRun run = run_pass(pass, program, size);
        size = run.after;
        if (options.observe) options.observe(run, program);
        runs.push_back(std::move(run));
#ifndef NDEBUG
        ir::expect_valid(program, pass.name);
#endif
    }
    return program;
}

// How often passes left out what is multiplied by zero.
std::int64_t terms_left_out(const std::vector<PassRun>& runs) {
    std::int64_t count = 0;
    for (const PassRun& run : runs) {
        const auto pass = std::ranges::find(in_order, run.name, &Pass::name);
        if (!pass->has(leaves_out_zeros)) continue;
        for (const auto& [what, times] : run.report) count += times;
    }
    return count;
}

// The step and the reward, and the tables that they read.
ir::Program step_alone(ir::Program program) {
    program.preconditions.clear();
    program.invariants.clear();
    program.terminations.clear();
    program.reset.clear();
    passes::Report unused;
    return passes::remove_unused_buffers(std::move(program), unused);
}

}  // namespace

ir::Program optimise(ir::Program program, const PassOptions& options, std::vector<PassRun>* runs) {
    auto moderate = std::exchange(program.moderate, std::nullopt);
    // All values are taken to be moderate then.
    if (options.fast_math && moderate) {
        program = std::move(**moderate);
        moderate.reset();
    }
    std::vector<PassRun> made;
    program = run_passes(std::move(program), options, made);
    if (moderate) {
        std::vector<PassRun> made_of_moderate;
        ir::Program other = run_passes(std::move(**moderate), options, made_of_moderate);
        if (terms_left_out(made_of_moderate) > terms_left_out(made)) {
            program.moderate = step_alone(std::move(other));
            made = std::move(made_of_moderate);
        }
    }
    if (runs) std::ranges::move(made, std::back_inserter(*runs));
    return program;
}

}  // namespace rddlc
