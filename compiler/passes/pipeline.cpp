// Over 400 lines: a row for each pass.
#include "passes/pipeline.hpp"

#include "passes/aggregations/compare_cases.hpp"
#include "passes/aggregations/count_bits.hpp"
#include "passes/aggregations/count_bools.hpp"
#include "passes/aggregations/count_factors.hpp"
#include "passes/aggregations/decide_draws.hpp"
#include "passes/aggregations/draw_over_objects.hpp"
#include "passes/aggregations/factor_aggregations.hpp"
#include "passes/aggregations/factor_quantifiers.hpp"
#include "passes/aggregations/fuse_interm_fluents.hpp"
#include "passes/aggregations/hoist_aggregations.hpp"
#include "passes/aggregations/index_directly.hpp"
#include "passes/aggregations/join_masks.hpp"
#include "passes/aggregations/keep_bools.hpp"
#include "passes/aggregations/make_aggregations_sparse.hpp"
#include "passes/aggregations/merge_draws.hpp"
#include "passes/aggregations/order_objects.hpp"
#include "passes/aggregations/search_intervals.hpp"
#include "passes/aggregations/set_bits.hpp"
#include "passes/aggregations/skip_added_zeros.hpp"
#include "passes/aggregations/skip_unchosen_sums.hpp"
#include "passes/aggregations/skip_zero_terms.hpp"
#include "passes/aggregations/tabulate_counts.hpp"
#include "passes/aggregations/tabulate_draws.hpp"
#include "passes/aggregations/tabulate_products.hpp"
#include "passes/aggregations/tabulate_sums.hpp"
#include "passes/aggregations/tabulate_thresholds.hpp"
#include "passes/aggregations/visit_true.hpp"
#include "passes/arithmetic/compare_magnitudes.hpp"
#include "passes/arithmetic/compare_roots.hpp"
#include "passes/arithmetic/fast_math.hpp"
#include "passes/arithmetic/find_ranges.hpp"
#include "passes/arithmetic/prove_invariants.hpp"
#include "passes/arithmetic/reduce_strength.hpp"
#include "passes/arithmetic/rule_out_ends.hpp"
#include "passes/arithmetic/shorten_invariants.hpp"
#include "passes/arithmetic/straighten_rows.hpp"
#include "passes/constants/fold_constant_expressions.hpp"
#include "passes/constants/fold_uniform_tables.hpp"
#include "passes/constants/tabulate_calls.hpp"
#include "passes/constants/tabulate_constant_fluents.hpp"
#include "passes/constants/tabulate_constants.hpp"
#include "passes/lanes/choose_evaluation.hpp"
#include "passes/lanes/evaluate_together.hpp"
#include "passes/lanes/group_angles.hpp"
#include "passes/lanes/keep_unchosen.hpp"
#include "passes/lanes/look_up_moves.hpp"
#include "passes/lanes/name_elements.hpp"
#include "passes/lanes/narrow_objects.hpp"
#include "passes/lanes/quantify_together.hpp"
#include "passes/lanes/read_places.hpp"
#include "passes/lanes/separate_aggregations.hpp"
#include "passes/lanes/separate_counts.hpp"
#include "passes/lanes/skip_unread.hpp"
#include "passes/lanes/tabulate_clearances.hpp"
#include "passes/lanes/test_cheap_first.hpp"
#include "passes/lanes/test_equalities_first.hpp"
#include "passes/lanes/unroll_rows.hpp"
#include "passes/lanes/visit_affected.hpp"
#include "passes/lanes/visit_chosen.hpp"
#include "passes/lanes/weigh_in_rows.hpp"
#include "passes/sharing/pair_angles.hpp"
#include "passes/sharing/remove_unused_buffers.hpp"
#include "passes/sharing/share_across_definitions.hpp"
#include "passes/sharing/share_subexpressions.hpp"

#include <algorithm>
#include <span>
#include <string_view>

namespace rddlc::passes {
namespace {

constexpr std::string_view strength_summary =
    "operators get cheaper equals: products replace divisions and powers";

constexpr std::string_view unused_summary = "unread tables and interm-fluents are removed";

constexpr std::string_view draws_summary =
    "draws of two branches that have the same random numbers become one";

constexpr Pass in_order[] = {
    {"tabulate_constant_fluents",
     Phase::Constants,
     tabulate_constant_fluents,
     "interm-fluents that the instance fixes become tables",
     {},
     "all passes below know more about a table than about a fluent"},
    {"tabulate_calls",
     Phase::Constants,
     tabulate_calls,
     "functions of tables that the instance fixes are called now",
     {"tabulate_constant_fluents"},
     "what they are given may come from constant fluents"},
    {"fold_uniform_tables",
     Phase::Constants,
     fold_uniform_tables,
     "a table of equal entries becomes a scalar",
     {"tabulate_constant_fluents"},
     "a fluent that has become a table may have equal entries"},
    {"fold_constant_expressions",
     Phase::Constants,
     fold_constant_expressions,
     "expressions that only tables decide are evaluated now",
     {"fold_uniform_tables"},
     "scalars in place of tables leave expressions of constants behind"},
    {"find_ranges",
     Phase::Arithmetic,
     find_ranges,
     "finds within which range a number lies",
     {"fold_constant_expressions"},
     "ranges come from the values of tables, and the passes below use them"},
    {"fast_math",
     Phase::Arithmetic,
     fast_math,
     "rewrites that are right for real numbers, if not for floating ones",
     {"fold_constant_expressions"},
     "divisors and exponents are literals now",
     only_fast_math},
    {"reduce_strength",
     Phase::Arithmetic,
     reduce_strength,
     strength_summary,
     {"fast_math"},
     "fast_math takes more divisions and powers, where it runs"},
    {"compare_cases",
     Phase::Aggregations,
     compare_cases,
     "ints that conditions choose, and that are only compared with constants, are conditions",
     {"fold_constant_expressions"},
     "whole definitions stand there, and fuse_interm_fluents finds cheap ones that only these "
     "read"},
    {"fuse_interm_fluents",
     Phase::Aggregations,
     fuse_interm_fluents,
     "interm-fluents that are cheap or read once are computed where they are read",
     {"tabulate_constant_fluents"},
     "constant fluents are tables, and the passes below see whole expressions",
     may_find_more},
    {"prove_invariants",
     Phase::Arithmetic,
     prove_invariants,
     "an invariant that every step keeps is not tested",
     {"fuse_interm_fluents"},
     "the min or max that keeps it stands in the CPF itself",
     only_fast_math},
    {"shorten_invariants",
     Phase::Arithmetic,
     shorten_invariants,
     "of two bounds of a number, one that every step keeps is not tested",
     {"prove_invariants"},
     "what is proved needs no bound"},
    {"rule_out_ends",
     Phase::Arithmetic,
     rule_out_ends,
     "conditions that end an episode do not hold in a step",
     {"fuse_interm_fluents"},
     "they may come from interm-fluents; and the passes below write conditions in other ways"},
    {"index_directly",
     Phase::Aggregations,
     index_directly,
     "an aggregation to which one object contributes takes that object",
     {"fuse_interm_fluents"},
     "the condition may come from an interm-fluent; and one object is better than a sparse row",
     leaves_out_zeros | may_find_more},
    {"search_intervals",
     Phase::Aggregations,
     search_intervals,
     "an expression of the interval in which a number lies becomes a binary search",
     {"index_directly"},
     "an equality is better than an interval",
     leaves_out_zeros | may_find_more},
    {"count_bools",
     Phase::Aggregations,
     count_bools,
     "sums of reals that only count, in steps of constants, count in ints",
     {"index_directly"},
     "sums of one term are gone"},
    {"tabulate_thresholds",
     Phase::Aggregations,
     tabulate_thresholds,
     "draws from weights that tables and small ints decide search a table",
     {"count_bools"},
     "the weights may depend on a count; merge_draws sees draws of one form"},
    {"merge_draws",
     Phase::Aggregations,
     merge_draws,
     draws_summary,
     {"tabulate_thresholds"},
     "draws that search a table have one form"},
    {"draw_over_objects",
     Phase::Aggregations,
     draw_over_objects,
     "a draw from weights that are one expression of different objects is one over the objects",
     {"tabulate_thresholds"},
     "weights that tables and small ints decide are gone"},
    {"join_masks",
     Phase::Aggregations,
     join_masks,
     "few true bools of a row look up masks of what they reach",
     {"index_directly"},
     "an equality is better than a mask; and the passes below take aggregations apart"},
    {"set_bits",
     Phase::Aggregations,
     set_bits,
     "rows of bools that few ints decide are ints, whose bits are set",
     {"index_directly"},
     "an equality inside the row is better; and the passes below take aggregations apart"},
    {"visit_true",
     Phase::Aggregations,
     visit_true,
     "where few bools are true, aggregations visit those",
     {"index_directly"},
     "an equality is better than a table; and the passes below take aggregations apart"},
    {"order_objects",
     Phase::Aggregations,
     order_objects,
     "an exists or forall visits objects that may change places in one order",
     {"index_directly", "visit_true"},
     "an equality is better than an order; and the passes below take aggregations apart"},
    {"factor_aggregations",
     Phase::Aggregations,
     factor_aggregations,
     "aggregations leave out factors that they do not change",
     {"index_directly"},
     "conditions on one object are no factors any more"},
    {"hoist_aggregations",
     Phase::Aggregations,
     hoist_aggregations,
     "an expression that depends on few of the loops around it becomes a table",
     {"factor_aggregations"},
     "without their factors aggregations depend on fewer loops"},
    {"make_aggregations_sparse",
     Phase::Aggregations,
     make_aggregations_sparse,
     "aggregations run over the entries of sparse tables",
     {"index_directly", "hoist_aggregations"},
     "the others need aggregations over all objects, and leave less to do",
     leaves_out_zeros | may_find_more},
    {"count_factors",
     Phase::Aggregations,
     count_factors,
     "products of one constant where bools are true look up its powers by a count",
     {"make_aggregations_sparse"},
     "it leaves out factors of 1, which it does not see in a table"},
    {"tabulate_products",
     Phase::Aggregations,
     tabulate_products,
     "products of constants that the bools of a row choose look up several bools at once",
     {"reduce_strength", "count_factors"},
     "sums of terms of one bool are selects; a power is one look-up"},
    {"tabulate_sums",
     Phase::Aggregations,
     tabulate_sums,
     "sums of constants that the bools of a few objects choose are looked up",
     {"set_bits", "make_aggregations_sparse"},
     "rows of bools are ints there, and terms that are always 0 are gone"},
    {"tabulate_counts",
     Phase::Aggregations,
     tabulate_counts,
     "an expression of a count, or of another small int, becomes a table",
     {"count_bools", "make_aggregations_sparse"},
     "a sparse row bounds its count, so that the table is small",
     may_find_more},
    {"tabulate_draws",
     Phase::Aggregations,
     tabulate_draws,
     "an expression of a draw and a table's element becomes a table of both",
     {"tabulate_counts"},
     "it has made such elements"},
    {"straighten_rows",
     Phase::Arithmetic,
     straighten_rows,
     "rows of tables that are nearly lines become lines",
     {"tabulate_counts"},
     "it has made the rows",
     only_fast_math},
    {"tabulate_constants",
     Phase::Constants,
     tabulate_constants,
     "an expression of tables and loop variables becomes a table",
     {"make_aggregations_sparse"},
     "a table of entries is smaller than one of all pairs"},
    {"merge_draws",
     Phase::Aggregations,
     merge_draws,
     draws_summary,
     {"tabulate_constants"},
     "a table shows that its elements are probabilities"},
    {"decide_draws",
     Phase::Aggregations,
     decide_draws,
     "draws with a probability that is always 0 or 1 become conditions",
     {"make_aggregations_sparse", "tabulate_constants"},
     "a table of entries shows that its elements are 0 or 1"},
    {"skip_zero_terms",
     Phase::Aggregations,
     skip_zero_terms,
     "sums compute only the expensive terms that a bool lets count",
     {"make_aggregations_sparse", "tabulate_constants"},
     "the terms that are still expensive are known",
     leaves_out_zeros},
    {"skip_added_zeros",
     Phase::Aggregations,
     skip_added_zeros,
     "additions compute only the expensive terms that constants let count",
     {"tabulate_constants"},
     "it has made tables of the bools that only constants decide"},
    {"keep_bools",
     Phase::Aggregations,
     keep_bools,
     "products of bools as numbers are bools",
     {"make_aggregations_sparse", "skip_zero_terms"},
     "tables of bools are factors there"},
    {"count_bits",
     Phase::Aggregations,
     count_bits,
     "sums and tests over tables of bools work on the bits of ints",
     {"count_bools", "make_aggregations_sparse"},
     "the rows of a sparse table become masks",
     may_find_more},
    {"compare_magnitudes",
     Phase::Arithmetic,
     compare_magnitudes,
     "two opposite bounds of a real become one of its absolute value",
     {"search_intervals"},
     "it looks for plain comparisons"},
    {"compare_roots",
     Phase::Arithmetic,
     compare_roots,
     "a root that is only compared with a constant is not taken",
     {"fuse_interm_fluents", "search_intervals"},
     "roots and their comparisons stand together, and it looks for plain comparisons"},
    {"factor_quantifiers",
     Phase::Aggregations,
     factor_quantifiers,
     "an exists or forall leaves out the conditions that it does not change",
     {"count_bits", "compare_roots"},
     "the passes above need whole conditions, and make their final form"},
    {"skip_unchosen_sums",
     Phase::Aggregations,
     skip_unchosen_sums,
     "expensive sums of the reward are skipped where the action chooses nothing",
     {"skip_zero_terms", "count_bits"},
     "the sums that are still expensive are known",
     adds_tests},
    {"pair_angles",
     Phase::Sharing,
     pair_angles,
     "the sine and the cosine of an angle are computed in one loop",
     {"factor_quantifiers"},
     "expressions have their final form, so that equal angles are equal"},
    {"share_across_definitions",
     Phase::Sharing,
     share_across_definitions,
     "expressions that several CPFs compute are computed once",
     {"factor_quantifiers", "pair_angles"},
     "expressions have their final form, so that equal ones are equal"},
    {"separate_counts",
     Phase::Lanes,
     separate_counts,
     "sums that count bools leave them to tables, whose bits are counted",
     {"count_bits", "share_across_definitions"},
     "the other sums of bools count bits already"},
    {"weigh_in_rows",
     Phase::Lanes,
     weigh_in_rows,
     "the weights of a draw over few objects lie in a row, which one register has",
     {"tabulate_counts", "share_across_definitions"},
     "draws over objects have tables of weights, with elements that counts choose"},
    {"read_places",
     Phase::Lanes,
     read_places,
     "bools that constants choose are read by their places, for several objects at once",
     {"share_across_definitions"},
     "a table of places has to serve all that read by it",
     may_find_more},
    {"narrow_objects",
     Phase::Lanes,
     narrow_objects,
     "constants that decide which objects reach an expression are known there",
     {"read_places"},
     "it has made tables of places, which may become fewer",
     may_find_more},
    {"separate_aggregations",
     Phase::Lanes,
     separate_aggregations,
     "loops and sums leave aggregations and terms to tables, to run over several objects at once",
     {"share_across_definitions"},
     "an aggregation that is shared is a table already"},
    {"unroll_rows",
     Phase::Lanes,
     unroll_rows,
     "small tables of sums over rows are filled without loops",
     {"separate_aggregations"},
     "it has made such tables"},
    {"test_equalities_first",
     Phase::Lanes,
     test_equalities_first,
     "what has to hold beside an equality of reals is evaluated where the equality holds",
     {"compare_magnitudes", "separate_aggregations"},
     "conditions have their final form"},
    {"test_cheap_first",
     Phase::Lanes,
     test_cheap_first,
     "conditions evaluate their aggregations where the rest does not decide them",
     {"test_equalities_first", "separate_aggregations"},
     "aggregations that are filled for several objects at once are tables already",
     may_find_more},
    {"group_angles",
     Phase::Lanes,
     group_angles,
     "sines and cosines of a step are computed together",
     {"share_across_definitions", "test_equalities_first"},
     "the values that every step needs, and those that are shared, are known"},
    {"remove_unused_buffers",
     Phase::Sharing,
     remove_unused_buffers,
     unused_summary,
     {"unroll_rows"},
     "all passes above leave tables unread"},
    {"share_subexpressions",
     Phase::Sharing,
     share_subexpressions,
     "an expression that is used twice, or does not change in a loop, gets a name",
     {"remove_unused_buffers"},
     "all passes above look for whole expressions, without names",
     may_find_more},
    {"reduce_strength",
     Phase::Arithmetic,
     reduce_strength,
     strength_summary,
     {"share_subexpressions"},
     "an expression that has a name is cheap enough for a product"},
    {"evaluate_together",
     Phase::Lanes,
     evaluate_together,
     "loops over several objects at once fill vector registers",
     {"share_subexpressions"},
     "the loops have their final bodies"},
    {"quantify_together",
     Phase::Lanes,
     quantify_together,
     "an exists or forall over bools of several objects finds them in registers",
     {"evaluate_together"},
     "it says which loops run over several objects, and not over words"},
    {"remove_unused_buffers",
     Phase::Sharing,
     remove_unused_buffers,
     unused_summary,
     {"quantify_together"},
     "it leaves tables of bools unread"},
    {"tabulate_clearances",
     Phase::Lanes,
     tabulate_clearances,
     "an exists over objects with constant places looks at them only where one may be near",
     {"quantify_together"},
     "it finds in registers whether there is such an object"},
    {"visit_affected",
     Phase::Lanes,
     visit_affected,
     "loops of draws know which objects a table of few true bools can make true",
     {"evaluate_together"},
     "it says which loops run over words of bools"},
    {"visit_chosen",
     Phase::Lanes,
     visit_chosen,
     "loops of draws know which objects an action leaves as they are",
     {"evaluate_together"},
     "it says which loops run over several objects, and not over words"},
    {"keep_unchosen",
     Phase::Lanes,
     keep_unchosen,
     "definitions know that the state stays as it is where an action chooses nothing",
     {"evaluate_together"},
     "loops have their final form, and what is shared stands before them"},
    {"skip_unread",
     Phase::Lanes,
     skip_unread,
     "what only definitions read that an action may skip is skipped with them",
     {"keep_unchosen"},
     "it says which definitions these are"},
    {"name_elements",
     Phase::Lanes,
     name_elements,
     "elements that several branches of a loop over words choose by place are chosen once",
     {"visit_affected", "visit_chosen"},
     "these look for loops of one statement"},
    {"choose_evaluation",
     Phase::Lanes,
     choose_evaluation,
     "selects, draws, loads and roundings are evaluated in the cheapest way",
     {"evaluate_together"},
     "loops over several objects load as suits them all; no pass below changes expressions",
     always_runs},
    {"look_up_moves",
     Phase::Lanes,
     look_up_moves,
     "loops of draws look up where the only true bool of a table goes",
     {"visit_affected", "choose_evaluation"},
     "these say which loops follow a table of few true bools, and which draws need no check"},
};

// Whether each pass stands behind those that it names.
consteval bool is_in_order(std::span<const Pass> passes) {
    for (const Pass& pass : passes)
        for (const char* const name : pass.after)
            if (name && std::find_if(passes.data(), &pass,
                                     [=](const Pass& each) { return each.name == name; }) == &pass)
                return false;
    return true;
}
static_assert(is_in_order(in_order));

}  // namespace

std::span<const Pass> pipeline() {
    return in_order;
}

}  // namespace rddlc::passes
