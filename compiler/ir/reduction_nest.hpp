// Reductions of one kind right inside each other: sum[a in x](sum[b in y](body)).
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <compare>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace rddlc::ir {

struct ReductionNest {
    Reduction op;
    std::vector<VariableId> variables;  // outermost first, at least one
    NodeId body;                        // of the innermost reduction
    auto operator<=>(const ReductionNest&) const = default;
};

// Takes a node apart, down to the first body that is no reduction by the same operator over a whole
// range, or that `enters` refuses. Nothing if the node itself is not one.
std::optional<ReductionNest> reduction_nest(
    const Program& program, NodeId id, const std::function<bool(const Reduce&)>& enters = nullptr);

// The same for a node that is a reduction by `op` and whose nest has a body that is no reduction.
std::optional<ReductionNest> whole_reduction_nest(const Program& program, NodeId id, Reduction op);

// The reverse: reductions over these variables, outermost first, around a body; without any, the
// body.
NodeId reduced(Builder& builder, Reduction op, std::span<const VariableId> variables, NodeId body);

}  // namespace rddlc::ir
