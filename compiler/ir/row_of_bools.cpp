#include "ir/row_of_bools.hpp"

#include "ir/fold.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace rddlc::ir {
namespace {

// The jump at the end of a loop over true elements takes as long as some terms.
constexpr std::int64_t fewest_in_row = 8;

bool is_zero(const Node& node) {
    const auto* constant = std::get_if<Constant>(&node.form);
    return constant && (node.type == Scalar::Int ? constant->value == Value(std::int64_t{0})
                                                 : identical(constant->value, Value(0.0)));
}

bool is_index_of(const Program& program, NodeId id, VariableId variable) {
    const auto* index = std::get_if<Index>(&program[id].form);
    return index && index->variable == variable;
}

// The bool of the state, the action or the step whose last indices are these variables, over all of
// its last dimensions; its other indices are those of loops, and constants.
bool is_element_at(const Program& program, NodeId id, std::span<const VariableId> variables) {
    const auto* load = std::get_if<Load>(&program[id].form);
    if (!load || load->indices.size() < variables.size() || load->gather != Gather::None)
        return false;
    const Buffer& buffer = program[load->buffer];
    if (buffer.scalar != Scalar::Bool || buffer.storage == Storage::Constant) return false;
    const std::size_t others = load->indices.size() - variables.size();
    for (std::size_t i = 0; i < variables.size(); ++i)
        if (!is_index_of(program, load->indices[others + i], variables[i]) ||
            buffer.shape[others + i] != program[variables[i]].size)
            return false;
    return std::ranges::all_of(std::span(load->indices).first(others), [&](NodeId index) {
        return std::holds_alternative<Constant>(program[index].form) ||
               (std::holds_alternative<Index>(program[index].form) &&
                std::ranges::none_of(variables, [&](VariableId variable) {
                    return is_index_of(program, index, variable);
                }));
    });
}

}  // namespace

bool is_in_row_of_bools(const Program& program, NodeId id, VariableId variable) {
    return program[variable].size >= fewest_in_row && is_element_at(program, id, {&variable, 1});
}

const Load* row_of_bools(const Program& program, const Reduce& reduce) {
    if (reduce.op != Reduction::Sum || reduce.bounds) return nullptr;
    const Node& body = program[reduce.body];
    std::optional<NodeId> element;
    if (const auto* convert = std::get_if<Convert>(&body.form))
        if (body.type == Scalar::Int) element = convert->operand;
    if (const auto* select = std::get_if<Select>(&body.form))
        if (is_zero(program[select->else_value])) element = select->condition;
    return element && is_in_row_of_bools(program, *element, reduce.variable)
               ? &std::get<Load>(program[*element].form)
               : nullptr;
}

const Load* table_of_bools(const Program& program, const Reduce& reduce) {
    const auto* inner = std::get_if<Reduce>(&program[reduce.body].form);
    if (reduce.op != Reduction::Sum || reduce.bounds || !inner || inner->op != Reduction::Sum ||
        inner->bounds ||
        program[reduce.variable].size * program[inner->variable].size < fewest_in_row)
        return nullptr;
    const auto* select = std::get_if<Select>(&program[inner->body].form);
    const std::array variables{reduce.variable, inner->variable};
    return select && is_zero(program[select->else_value]) &&
                   is_element_at(program, select->condition, variables)
               ? &std::get<Load>(program[select->condition].form)
               : nullptr;
}

}  // namespace rddlc::ir
