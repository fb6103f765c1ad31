#include "ir/row_of_bools.hpp"

#include "ir/fold.hpp"
#include "ir/nest.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rddlc::ir {
namespace {

// The jump at the end of a loop over true elements takes as long as some terms.
constexpr std::int64_t fewest_in_row = 8;
// Packs find the place of the only true bool in a word.
constexpr std::int64_t most_in_word = 64;

bool is_zero(const Node& node) {
    const auto* constant = std::get_if<Constant>(&node.form);
    return constant && (node.type == Scalar::Int ? constant->value == Value(std::int64_t{0})
                                                 : identical(constant->value, Value(0.0)));
}

// Whether the last indices of an element are these variables, over all of its table's last
// dimensions, and the other ones those of loops, and constants.
bool is_at(const Program& program, const Load& load, std::span<const VariableId> variables) {
    if (load.indices.size() < variables.size() || load.gather != Gather::None) return false;
    const Buffer& buffer = program[load.buffer];
    const std::size_t others = load.indices.size() - variables.size();
    for (std::size_t i = 0; i < variables.size(); ++i)
        if (!is_index_of(program, load.indices[others + i], variables[i]) ||
            buffer.shape[others + i] != program[variables[i]].size)
            return false;
    return std::ranges::all_of(std::span(load.indices).first(others), [&](NodeId index) {
        return std::holds_alternative<Constant>(program[index].form) ||
               (std::holds_alternative<Index>(program[index].form) &&
                std::ranges::none_of(variables, [&](VariableId variable) {
                    return is_index_of(program, index, variable);
                }));
    });
}

// The bool of the state, the action or the step that is there.
bool is_element_at(const Program& program, NodeId id, std::span<const VariableId> variables) {
    const auto* load = std::get_if<Load>(&program[id].form);
    if (!load) return false;
    const Buffer& buffer = program[load->buffer];
    return buffer.scalar == Scalar::Bool && buffer.storage != Storage::Constant &&
           is_at(program, *load, variables);
}

// Whether a part of a table of the state over these variables says where something is: it begins
// with one true bool in each of them.
bool holds_places(const Program& program, const Load& load, std::span<const VariableId> variables) {
    const Buffer& buffer = program[load.buffer];
    const std::int64_t size = combinations(program, variables);
    if (buffer.storage != Storage::State || size > most_in_word) return false;
    const std::vector<Value> values = buffer.values.dense();
    for (auto part = values.begin(); part != values.end(); part += size)
        if (std::count(part, part + size, Value(true)) != 1) return false;
    return true;
}

// The term of a sum over true bools, if it is an element of a table of real constants that is
// there.
const Load* constant_at(const Program& program, NodeId term,
                        std::span<const VariableId> variables) {
    const auto* select = std::get_if<Select>(&program[term].form);
    if (!select || select->evaluated == Evaluated::Branch ||
        !holds_places(program, std::get<Load>(program[select->condition].form), variables))
        return nullptr;
    const auto* load = std::get_if<Load>(&program[select->then_value].form);
    if (!load) return nullptr;
    const Buffer& buffer = program[load->buffer];
    return buffer.scalar == Scalar::Real && buffer.storage == Storage::Constant &&
                   is_at(program, *load, variables)
               ? load
               : nullptr;
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

const Load* constants_over_true(const Program& program, const Reduce& reduce) {
    if (table_of_bools(program, reduce)) {
        const auto& inner = std::get<Reduce>(program[reduce.body].form);
        return constant_at(program, inner.body, std::array{reduce.variable, inner.variable});
    }
    return row_of_bools(program, reduce) ? constant_at(program, reduce.body, {&reduce.variable, 1})
                                         : nullptr;
}

}  // namespace rddlc::ir
