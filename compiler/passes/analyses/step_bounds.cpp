#include "passes/analyses/step_bounds.hpp"

#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/readers.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace rddlc::passes {

bool StepBounds::is_kept_at_most(ir::NodeId a, ir::NodeId b) {
    const auto lower = in_next_state(a), upper = in_next_state(b);
    return lower && upper &&
           (is_bounded(*lower, Side::AtMost, *upper) || is_bounded(*upper, Side::AtLeast, *lower));
}

// The value of an element of the state, or of a constant, after a step. The choice of the
// element must not depend on the state, since that is another one after the step.
std::optional<ir::NodeId> StepBounds::in_next_state(ir::NodeId id) {
    const ir::Program& program = builder_.program();
    if (builder_.properties(id).uniform) return id;
    const auto form = program[id].form;
    const auto* load = std::get_if<ir::Load>(&form);
    if (!load || program[load->buffer].storage != ir::Storage::State) return std::nullopt;
    const auto is_fixed = [&](ir::NodeId index) {
        return builder_.properties(index).uniform;
    };
    if (!std::ranges::all_of(load->indices, is_fixed)) return std::nullopt;
    const ir::Definition* definition = definition_of_next(load->buffer);
    return definition ? element(*definition, load->indices) : std::nullopt;
}
const ir::Definition* StepBounds::definition_of_next(ir::BufferId state) const {
    const ir::Program& program = builder_.program();
    const auto fills = [&](const ir::Definition& definition) {
        const ir::Buffer& target = program[definition.target];
        return target.storage == ir::Storage::Next && target.name == program[state].name;
    };
    if (std::ranges::count_if(program.step, fills) != 1) return nullptr;
    return &*std::ranges::find_if(program.step, fills);
}
// The definition consists of loops around one statement.
std::optional<ir::NodeId> StepBounds::element(const ir::Definition& definition,
                                              const std::vector<ir::NodeId>& indices) {
    const ir::Program& program = builder_.program();
    const ir::Block* body = &definition.body;
    std::vector<ir::VariableId> variables;
    if (const auto* loop = ir::only_statement<ir::Loop>(*body)) {
        ir::Nest nest = ir::nest_of(*loop);
        variables = std::move(nest.variables);
        body = nest.body;
    }
    const auto* store = ir::only_statement<ir::Store>(*body);
    if (!store || variables.size() != indices.size()) return std::nullopt;
    const std::set<ir::VariableId> bound = bound_variables(program, store->value);
    const auto is_bound_there = [&](ir::VariableId variable) {
        return bound.contains(variable);
    };
    std::map<ir::NodeId, ir::NodeId> known;
    for (std::size_t k = 0; k < indices.size(); ++k) {
        if (store->indices[k] != builder_.index(variables[k])) return std::nullopt;
        if (std::ranges::any_of(builder_.properties(indices[k]).free_variables, is_bound_there))
            return std::nullopt;
        known[store->indices[k]] = indices[k];
    }
    return ir::replace_in(builder_, store->value, known);
}

// Where no value is nan.
bool StepBounds::is_bounded(ir::NodeId value, Side side, ir::NodeId limit) const {
    const ir::Program& program = builder_.program();
    if (value == limit || is_within_range(value, side, limit)) return true;
    const auto* apply = std::get_if<ir::Apply>(&program[value].form);
    if (!apply) return false;
    const auto is_operand_bounded = [&](ir::NodeId operand) {
        return is_bounded(operand, side, limit);
    };
    const bool is_upper = side == Side::AtMost;
    if (apply->op == (is_upper ? Operator::Minimum : Operator::Maximum))
        return std::ranges::any_of(apply->operands, is_operand_bounded);
    if (apply->op == (is_upper ? Operator::Maximum : Operator::Minimum))
        return std::ranges::all_of(apply->operands, is_operand_bounded);
    return false;
}
bool StepBounds::is_within_range(ir::NodeId value, Side side, ir::NodeId limit) const {
    if (ranges_ == Ranges::OfConstants && !builder_.properties(value).uniform) return false;
    const auto &range = builder_.properties(value).range,
               &limits = builder_.properties(limit).range;
    if (!range || !limits) return false;
    return side == Side::AtMost ? range->upper <= limits->lower : range->lower >= limits->upper;
}

}  // namespace rddlc::passes
