#include "passes/lanes/test_cheap_first.hpp"

#include "ir/analysis.hpp"
#include "ir/cost_model.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/few_true.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// The operator if it is And or Or.
std::optional<Operator> connective_of(const ir::Node& node) {
    const auto* apply = std::get_if<ir::Apply>(&node.form);
    if (apply && (apply->op == Operator::And || apply->op == Operator::Or)) return apply->op;
    return std::nullopt;
}

// Whether each node, by NodeId::index, is an operand of a node with the same connective.
std::vector<bool> parts_of_conditions(const ir::Program& program) {
    std::vector<bool> is_part(program.nodes.size());
    for (const ir::Node& node : program.nodes) {
        const auto op = connective_of(node);
        if (!op) continue;
        for (const ir::NodeId operand : ir::operands_of(node))
            if (connective_of(program[operand]) == op) is_part[operand.index] = true;
    }
    return is_part;
}

// Whether it has an aggregation that depends on all of these variables. Another one does not
// change in some loop around the condition, and is computed before that loop.
bool has_loop(const ir::Builder& builder, ir::NodeId id,
              const std::vector<ir::VariableId>& variables) {
    return ir::any_node_of(builder.program(), id, [&](ir::NodeId each) {
        return std::holds_alternative<ir::Reduce>(builder.program()[each].form) &&
               std::ranges::includes(builder.properties(each).free_variables, variables);
    });
}

// A conjunction whose draws wait for the action; nothing if it has none.
std::optional<ir::NodeId> drawn_where_chosen(ir::Builder& builder, std::vector<ir::NodeId> parts) {
    const ir::Program& program = builder.program();
    const auto is_chosen = [&](ir::NodeId part) {
        const auto* load = std::get_if<ir::Load>(&program[part].form);
        return load && acts_with_few_true(program[load->buffer], least_per_draw);
    };
    const auto draws = std::stable_partition(parts.begin(), parts.end(), is_chosen);
    const auto is_random = [&](ir::NodeId part) {
        return builder.properties(part).random;
    };
    if (draws == parts.begin() || !std::any_of(draws, parts.end(), is_random)) return std::nullopt;
    const ir::NodeId test = ir::joined(builder, Operator::And, std::span(parts.begin(), draws));
    const ir::NodeId rest = ir::joined(builder, Operator::And, std::span(draws, parts.end()));
    return builder.select(test, rest, builder.constant(false));
}

std::optional<ir::NodeId> tested_first(ir::Builder& builder, ir::NodeId id, Operator op) {
    std::vector<ir::NodeId> parts = ir::parts_of(builder.program(), id, op);
    const auto may_fault = [&](ir::NodeId part) {
        return builder.properties(part).may_fault;
    };
    if (std::ranges::any_of(parts, may_fault)) return std::nullopt;
    if (op == Operator::And)
        if (const auto drawn = drawn_where_chosen(builder, parts)) return drawn;
    const auto dear = std::stable_partition(parts.begin(), parts.end(), [&](ir::NodeId part) {
        return ir::is_cheap(builder.properties(part));
    });
    if (dear == parts.begin() || dear == parts.end()) return std::nullopt;
    const ir::NodeId test = ir::joined(builder, op, std::span(parts.begin(), dear));
    const ir::NodeId rest = ir::joined(builder, op, std::span(dear, parts.end()));
    if (builder.properties(rest).cost < ir::mispredicted_jump_cost ||
        !has_loop(builder, rest, builder.properties(test).free_variables))
        return std::nullopt;
    const ir::NodeId decided = builder.constant(op == Operator::Or);
    return op == Operator::Or ? builder.select(test, decided, rest)
                              : builder.select(test, rest, decided);
}

}  // namespace

ir::Program test_cheap_first(ir::Program program, Report& report) {
    const std::vector<bool> is_part = parts_of_conditions(program);
    return ir::rewrite(std::move(program),
                       [&](ir::Builder& builder, ir::NodeId id,
                           const ir::Node& node) -> std::optional<ir::NodeId> {
                           const auto op = connective_of(node);
                           if (!op || is_part[id.index]) return std::nullopt;
                           const ir::NodeId whole = builder.rebuild(node);
                           const auto tested = tested_first(builder, whole, *op);
                           if (tested) ++report["cheap conditions tested first"];
                           return tested.value_or(whole);
                       });
}

}  // namespace rddlc::passes
