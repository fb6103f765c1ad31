#include "ir/common_rows.hpp"

#include "ir/analysis.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

namespace rddlc::ir {
namespace {

// Shorter rows have as many bytes as a test of them has instructions.
constexpr std::int64_t least_in_row = 4;

bool depends_on_index(const Program& program, NodeId id, VariableId variable) {
    return any_node_of(program, id,
                       [&](NodeId each) { return is_index_of(program, each, variable); });
}

// The element at the variable, its last index, of a row of the state or the action.
const Load* element_of_row(const Program& program, NodeId id, VariableId variable) {
    const auto* load = std::get_if<Load>(&program[id].form);
    if (!load || load->gather != Gather::None || load->indices.empty()) return nullptr;
    const Buffer& table = program[load->buffer];
    const bool is_stored_before =
        table.storage == Storage::State || table.storage == Storage::Action;
    const auto row = std::span(load->indices).first(load->indices.size() - 1);
    return is_stored_before && table.shape.back() == program[variable].size &&
                   is_index_of(program, load->indices.back(), variable) &&
                   std::ranges::none_of(
                       row,
                       [&](NodeId index) { return depends_on_index(program, index, variable); })
               ? load
               : nullptr;
}

}  // namespace

std::optional<CommonRows> common_rows(const Program& program, const Reduce& reduce) {
    if (reduce.op != Reduction::Exists || reduce.bounds ||
        program[reduce.variable].size < least_in_row)
        return std::nullopt;
    CommonRows found;
    for (const NodeId part : parts_of(program, reduce.body, Operator::And)) {
        if (!depends_on_index(program, part, reduce.variable))
            found.others.push_back(part);
        else if (const Load* row = element_of_row(program, part, reduce.variable))
            found.rows.push_back(row);
        else
            return std::nullopt;
    }
    return found;
}

}  // namespace rddlc::ir
