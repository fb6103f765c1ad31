#include "passes/passes.hpp"

#include "ir/analysis.hpp"
#include "ir/verify.hpp"
#include "passes/compare_counts.hpp"
#include "passes/compare_magnitudes.hpp"
#include "passes/count_bits.hpp"
#include "passes/count_bools.hpp"
#include "passes/evaluate_together.hpp"
#include "passes/factor_aggregations.hpp"
#include "passes/fast_math.hpp"
#include "passes/find_finite_fluents.hpp"
#include "passes/fold_constant_expressions.hpp"
#include "passes/fold_uniform_tables.hpp"
#include "passes/fuse_interm_fluents.hpp"
#include "passes/hoist_aggregations.hpp"
#include "passes/index_directly.hpp"
#include "passes/make_aggregations_sparse.hpp"
#include "passes/merge_draws.hpp"
#include "passes/prove_invariants.hpp"
#include "passes/reduce_strength.hpp"
#include "passes/remove_unused_buffers.hpp"
#include "passes/search_intervals.hpp"
#include "passes/separate_aggregations.hpp"
#include "passes/share_across_definitions.hpp"
#include "passes/share_subexpressions.hpp"
#include "passes/skip_zero_terms.hpp"
#include "passes/straighten_rows.hpp"
#include "passes/tabulate_constant_fluents.hpp"
#include "passes/tabulate_constants.hpp"
#include "passes/tabulate_counts.hpp"
#include "passes/unroll_rows.hpp"

#include <algorithm>
#include <utility>

namespace rddlc {
namespace {

struct Pass {
    const char* name;
    const char* summary;
    ir::Program (*run)(ir::Program, passes::Report&);
    bool only_fast_math = false;
    bool rounds_sums = false;
};

// A pass may stand here several times.
constexpr Pass in_order[] = {
    {"tabulate_constant_fluents", "interm-fluents that the instance fixes become tables",
     passes::tabulate_constant_fluents},
    {"fold_uniform_tables", "a table of equal entries becomes a scalar",
     passes::fold_uniform_tables},
    {"fold_constant_expressions", "what only tables decide is evaluated now",
     passes::fold_constant_expressions},
    {"find_finite_fluents", "tells which fluents are never inf or nan, for the passes below",
     passes::find_finite_fluents},
    {"fast_math", "only with --fast-math: what is right for real numbers, if not for floating ones",
     passes::fast_math, true},
    {"reduce_strength", "operators with cheaper equals: products for divisions and powers",
     passes::reduce_strength},
    {"fuse_interm_fluents",
     "interm-fluents read once, or cheap ones, are computed where they are read",
     passes::fuse_interm_fluents},
    {"prove_invariants", "only with --fast-math: an invariant that every step keeps is not tested",
     passes::prove_invariants, true},
    {"index_directly", "an aggregation to which one object contributes takes that object",
     passes::index_directly},
    {"search_intervals", "what depends on the interval of a number becomes a binary search",
     passes::search_intervals},
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
     passes::make_aggregations_sparse, false, true},
    {"tabulate_counts", "what a count, or another small int, decides becomes a table",
     passes::tabulate_counts},
    {"straighten_rows", "only with --fast-math: rows of tables that are nearly lines become lines",
     passes::straighten_rows, true},
    {"tabulate_constants", "what tables and loop variables decide becomes a table",
     passes::tabulate_constants},
    {"skip_zero_terms", "sums compute only the expensive terms that a bool lets count",
     passes::skip_zero_terms},
    {"count_bits", "sums and tests over tables of bools work on the bits of ints",
     passes::count_bits},
    {"compare_magnitudes", "two opposite bounds of a real become one of its absolute value",
     passes::compare_magnitudes},
    {"share_across_definitions", "what several CPFs compute is computed once",
     passes::share_across_definitions},
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

PassRun measured(const Pass& pass, ir::Program& program) {
    const auto begin = std::chrono::steady_clock::now();
    PassRun run{.name = pass.name, .report = {}, .before = {}, .after = {}, .time = {}};
    program = pass.run(std::move(program), run.report);
    run.time = std::chrono::steady_clock::now() - begin;
    return run;
}

}  // namespace

std::vector<PassDescription> all_passes() {
    std::vector<PassDescription> passes;
    for (const Pass& pass : in_order) {
        const auto known = std::ranges::find(passes, pass.name, &PassDescription::name);
        if (known == passes.end())
            passes.push_back({pass.name, pass.summary, pass.only_fast_math, pass.rounds_sums});
    }
    return passes;
}

ProgramSize size_of(const ir::Program& program) {
    const std::vector<bool> reachable = ir::reachable_nodes(program);
    return {.nodes = static_cast<std::size_t>(std::ranges::count(reachable, true)),
            .operations = ir::cost_of_step(program)};
}

ir::Program optimise(ir::Program program, const PassOptions& options, std::vector<PassRun>* runs) {
    for (const Pass& pass : in_order) {
        if (options.without.contains(pass.name)) continue;
        if (pass.only_fast_math && !options.fast_math) continue;
        const ProgramSize before = runs ? size_of(program) : ProgramSize{};
        PassRun run = measured(pass, program);
        if (runs) {
            run.before = before;
            run.after = size_of(program);
        }
        if (options.observe) options.observe(run, program);
        if (runs) runs->push_back(std::move(run));
#ifndef NDEBUG
        ir::expect_valid(program, pass.name);
#endif
    }
    return program;
}

}  // namespace rddlc
