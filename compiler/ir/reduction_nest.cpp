#include "ir/reduction_nest.hpp"

namespace rddlc::ir {

std::optional<ReductionNest> reduction_nest(const Program& program, NodeId id,
                                            const std::function<bool(const Reduce&)>& enters) {
    const auto* outermost = std::get_if<Reduce>(&program[id].form);
    if (!outermost) return std::nullopt;
    ReductionNest nest{outermost->op, {}, id};
    while (const auto* reduce = std::get_if<Reduce>(&program[nest.body].form)) {
        if (reduce->op != nest.op || reduce->bounds || (enters && !enters(*reduce))) break;
        nest.variables.push_back(reduce->variable);
        nest.body = reduce->body;
    }
    if (nest.variables.empty()) return std::nullopt;
    return nest;
}

std::optional<ReductionNest> whole_reduction_nest(const Program& program, NodeId id, Reduction op) {
    auto nest = reduction_nest(program, id);
    if (!nest || nest->op != op || std::holds_alternative<Reduce>(program[nest->body].form))
        return std::nullopt;
    return nest;
}

NodeId reduced(Builder& builder, Reduction op, std::span<const VariableId> variables, NodeId body) {
    for (auto variable = variables.rbegin(); variable != variables.rend(); ++variable)
        body = builder.reduce(op, *variable, body);
    return body;
}

}  // namespace rddlc::ir
