#include "ir/row_of_bools.hpp"

#include "ir/fold.hpp"

#include <algorithm>
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

}  // namespace

bool is_in_row_of_bools(const Program& program, NodeId id, VariableId variable) {
    const auto* load = std::get_if<Load>(&program[id].form);
    if (!load || load->indices.empty() || load->gather != Gather::None) return false;
    const Buffer& buffer = program[load->buffer];
    const auto is_index = [&](NodeId index) {
        const auto* form = std::get_if<Index>(&program[index].form);
        return form && form->variable == variable;
    };
    const std::span<const NodeId> others = std::span(load->indices).first(load->indices.size() - 1);
    return buffer.scalar == Scalar::Bool && buffer.storage != Storage::Constant &&
           buffer.shape.back() >= fewest_in_row && buffer.shape.back() == program[variable].size &&
           is_index(load->indices.back()) && std::ranges::all_of(others, [&](NodeId index) {
               return !is_index(index) && (std::holds_alternative<Index>(program[index].form) ||
                                           std::holds_alternative<Constant>(program[index].form));
           });
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

}  // namespace rddlc::ir
