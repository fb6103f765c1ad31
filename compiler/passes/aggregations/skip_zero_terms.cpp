#include "passes/aggregations/skip_zero_terms.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"
#include "ir/row_of_bools.hpp"
#include "passes/analyses/bool_factor.hpp"
#include "passes/analyses/few_true.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Operations that are worth computing before a loop.
constexpr double worth_a_name = 4;

// Also cheap ones if emitted code need not even look at them, or computes them before the sum.
bool may_be_skipped(const ir::Properties& properties, bool is_by_row, bool is_invariant) {
    const bool is_worth_it = is_by_row || properties.cost >= worth_a_branch ||
                             (is_invariant && properties.cost >= worth_a_name);
    return is_worth_it && properties.finite && ir::is_droppable(properties);
}

// A bool of loop indices in a table of which few are true.
bool is_mostly_false(const ir::Program& program, ir::NodeId id) {
    const auto* load = std::get_if<ir::Load>(&program[id].form);
    return load && begins_with_few_true(program[load->buffer], least_per_visit) &&
           std::ranges::all_of(load->indices, [&](ir::NodeId index) {
               return std::holds_alternative<ir::Index>(program[index].form);
           });
}

// The term as a choice between itself and zero.
std::optional<ir::NodeId> chosen(ir::Builder& builder, const ir::Reduce& sum) {
    const auto choice = without_bool_factor(builder, sum.body);
    if (!choice || !choice->value) return std::nullopt;
    const ir::Properties& properties = builder.properties(*choice->value);
    const bool is_by_row =
        !sum.bounds && (ir::is_in_row_of_bools(builder.program(), choice->counts, sum.variable) ||
                        is_mostly_false(builder.program(), choice->counts));
    const bool is_invariant = !ir::depends_on_any(properties, {&sum.variable, 1});
    if (!may_be_skipped(properties, is_by_row, is_invariant)) return std::nullopt;
    return builder.select(choice->counts, *choice->value, builder.constant(0.0));
}

}  // namespace

ir::Program skip_zero_terms(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* sum = std::get_if<ir::Reduce>(&node.form);
            if (!sum || sum->op != Reduction::Sum || node.type != ir::Scalar::Real)
                return std::nullopt;
            const auto term = chosen(builder, *sum);
            if (!term) return std::nullopt;
            ++report["sums that skip terms"];
            return builder.reduce(sum->op, sum->variable, *term, sum->bounds);
        });
}

}  // namespace rddlc::passes
