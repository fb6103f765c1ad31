#include "passes/lanes/test_equalities_first.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// In operations (Properties::cost): what takes less is evaluated sooner than skipped.
constexpr double worth_a_jump = 4;

bool is_equality_of_reals(const ir::Program& program, ir::NodeId id) {
    const auto* apply = std::get_if<ir::Apply>(&program[id].form);
    return apply && apply->op == Operator::Equal &&
           program[apply->operands.front()].type == ir::Scalar::Real;
}

// An equality that is tested first already: with it, in place of it, what else has to hold.
std::optional<ir::Select> tested_already(const ir::Program& program, ir::NodeId id) {
    const auto* select = std::get_if<ir::Select>(&program[id].form);
    const bool is_tested = select && select->evaluated == ir::Evaluated::MostlyFirst &&
                           ir::constant<bool>(program, select->then_value) == false;
    return is_tested ? std::optional(*select) : std::nullopt;
}

// Where the equality that is one of the parts does not hold: the others are left in `parts`.
std::optional<ir::NodeId> take_equality(ir::Builder& builder, std::vector<ir::NodeId>& parts) {
    for (auto part = parts.begin(); part != parts.end(); ++part) {
        if (const auto tested = tested_already(builder.program(), *part)) {
            *part = tested->else_value;
            return tested->condition;
        }
        if (is_equality_of_reals(builder.program(), *part)) {
            const ir::NodeId equality = *part;
            parts.erase(part);
            return builder.apply(Operator::Not, {equality});
        }
    }
    return std::nullopt;
}

std::optional<ir::NodeId> tested_first(ir::Builder& builder, ir::NodeId id) {
    if (!ir::is_droppable(builder.properties(id))) return std::nullopt;
    std::vector<ir::NodeId> parts = ir::parts_of(builder.program(), id, Operator::And);
    const auto differs = take_equality(builder, parts);
    if (!differs || parts.empty()) return std::nullopt;
    const ir::NodeId rest = ir::joined(builder, Operator::And, parts);
    if (builder.properties(rest).cost < worth_a_jump) return std::nullopt;
    // Another equality is tested second.
    const ir::NodeId others = tested_first(builder, rest).value_or(rest);
    return builder.select(*differs, builder.constant(false), others, ir::Evaluated::MostlyFirst);
}

}  // namespace

ir::Program test_equalities_first(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* apply = std::get_if<ir::Apply>(&node.form);
            if (!apply || apply->op != Operator::And) return std::nullopt;
            const ir::NodeId whole = builder.rebuild(node);
            const auto tested = tested_first(builder, whole);
            if (tested) ++report["equalities tested first"];
            return tested.value_or(whole);
        });
}

}  // namespace rddlc::passes
