#include "passes/aggregations/skip_zero_terms.hpp"

#include "ir/rewrite.hpp"
#include "ir/row_of_bools.hpp"

#include <utility>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) that cost more than a mispredicted branch.
constexpr double expensive = 20;

// The bool that a number is made of; nothing if it is another number.
std::optional<ir::NodeId> bool_of(const ir::Program& program, ir::NodeId id) {
    const auto* convert = std::get_if<ir::Convert>(&program[id].form);
    if (!convert || program[convert->operand].type != ir::Scalar::Bool) return std::nullopt;
    return convert->operand;
}

// Also cheap ones if emitted code need not even look at them.
bool may_be_skipped(const ir::Properties& properties, bool is_by_row) {
    return (is_by_row || properties.cost >= expensive) && properties.finite &&
           ir::is_droppable(properties);
}

// The term as a choice between itself and zero.
std::optional<ir::NodeId> chosen(ir::Builder& builder, const ir::Reduce& sum) {
    const ir::NodeId term = sum.body;
    const auto* product = std::get_if<ir::Apply>(&builder.program()[term].form);
    if (!product || product->op != Operator::Multiply) return std::nullopt;
    const std::vector<ir::NodeId> factors = product->operands;
    for (const std::size_t k : {0, 1}) {
        const auto counts = bool_of(builder.program(), factors[k]);
        if (!counts) continue;
        const bool is_by_row =
            !sum.bounds && ir::is_in_row_of_bools(builder.program(), *counts, sum.variable);
        if (may_be_skipped(builder.properties(factors[1 - k]), is_by_row))
            return builder.select(*counts, factors[1 - k], builder.constant(0.0));
    }
    return std::nullopt;
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
