// Cases that a step jumps over where an action chooses none of them
// (passes/aggregations/skip_unchosen_sums.hpp).
#pragma once

#include "ir/builder.hpp"
#include "ir/rewrite.hpp"

#include <functional>
#include <map>
#include <optional>

namespace rddlc::passes {

inline const ir::Select* jump_in(const ir::Program& program, ir::NodeId id) {
    const auto* select = std::get_if<ir::Select>(&program[id].form);
    return select && select->evaluated == ir::Evaluated::Jump ? select : nullptr;
}

// The value with others in place of what its outermost jumps may jump over. Those in aggregations
// and in branches, which are not always evaluated, stay as they are.
inline ir::NodeId replace_in_jumps(ir::Builder& builder, ir::NodeId value,
                                   const std::function<ir::NodeId(const ir::Select&)>& change) {
    std::map<ir::NodeId, ir::NodeId> known;
    return ir::replace_in(builder, value, known, [&](ir::NodeId id) -> std::optional<ir::NodeId> {
        const ir::Program& program = builder.program();
        const auto* jump = jump_in(program, id);
        if (!jump)
            return std::holds_alternative<ir::Select>(program[id].form) ||
                           std::holds_alternative<ir::Reduce>(program[id].form)
                       ? std::optional(id)
                       : std::nullopt;
        const ir::Select select = *jump;  // new nodes move the others
        return builder.select(select.condition, change(select), select.else_value,
                              ir::Evaluated::Jump);
    });
}

}  // namespace rddlc::passes
