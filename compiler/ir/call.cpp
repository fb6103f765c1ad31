#include "ir/call.hpp"

#include "ir/analysis.hpp"
#include "support/failure.hpp"
#include "support/match.hpp"

namespace rddlc::ir {

CallSignature signature_of(MatrixOperator op) {
    switch (op) {
        case MatrixOperator::Determinant:
            return {{2}, true, 0, {}, 0, Scalar::Real};
        case MatrixOperator::Inverse:
            return {{2}, true, 0, {}, 2, Scalar::Real};
        case MatrixOperator::PseudoInverse:
            return {{2, 2}, true, 1, {}, 2, Scalar::Real};
        case MatrixOperator::Cholesky:
            return {{2}, false, 0, {}, 2, Scalar::Real};
    }
    own_mistake("a callee without a signature");
}

CallSignature signature_of(VectorDistribution distribution) {
    switch (distribution) {
        case VectorDistribution::MultivariateNormal:  // mean, Cholesky factor of the covariance
            return {{1, 2}, false, 0, {}, 1, Scalar::Real};
        case VectorDistribution::MultivariateStudent:  // the same, and degrees of freedom
            return {{1, 2}, false, 0, Scalar::Real, 1, Scalar::Real};
        case VectorDistribution::Dirichlet:  // weights
            return {{1}, false, 0, {}, 1, Scalar::Real};
        case VectorDistribution::Multinomial:  // probabilities, and trials
            return {{1}, false, 0, Scalar::Int, 1, Scalar::Int};
    }
    own_mistake("a callee without a signature");
}

bool is_external(const Callee& callee) {
    return std::holds_alternative<ExternalId>(callee);
}

std::string name_of(const Program& program, const Callee& callee) {
    return match(
        callee, [&](ExternalId id) { return "$" + program[id].name; },
        [](Together) { return std::string("together"); },
        [](auto which) { return std::string(rddlc::name_of(which)); });
}

bool is_draw(const Callee& callee) {
    return std::holds_alternative<VectorDistribution>(callee);
}

Extent extent_of(const Program& program, const Call& call) {
    const Buffer& buffer = program[call.inputs.front().buffer];
    return {buffer.shape.back(), buffer.types.back()};
}

bool overwrites_inputs(const Callee& callee) {
    return match(
        callee, [](ExternalId) { return false; }, [](Together) { return false; },
        [](auto which) { return signature_of(which).overwrites_inputs; });
}

std::vector<BufferId> written_buffers(const Call& call) {
    std::vector<BufferId> written = {call.output.buffer};
    if (!overwrites_inputs(call.callee)) return written;
    for (const TableView& input : call.inputs) written.push_back(input.buffer);
    return written;
}

std::set<BufferId> written_buffers(const Block& block) {
    std::set<BufferId> written;
    for_each_statement<Store>(block, [&](const Store& store) { written.insert(store.target); });
    for_each_statement<Spread>(block, [&](const Spread& spread) { written.insert(spread.target); });
    for_each_statement<Visit>(block, [&](const Visit& visit) {
        for (const Mark& mark : visit.marks) written.insert(mark.target);
    });
    for_each_statement<Call>(block, [&](const Call& call) {
        for (BufferId buffer : written_buffers(call)) written.insert(buffer);
    });
    return written;
}

std::span<const std::int64_t> axes_of(const Program& program, const TableView& view) {
    return std::span(program[view.buffer].shape).subspan(view.indices.size());
}

bool is_sine_or_cosine(const Node& node) {
    const auto* apply = std::get_if<Apply>(&node.form);
    return apply && (apply->op == Operator::Sin || apply->op == Operator::Cos);
}

bool is_known_before(const Program& program, NodeId id, const std::set<BufferId>& filled) {
    const Node& node = program[id];
    const auto buffer = buffer_read_by(node);
    if (std::holds_alternative<Local>(node.form) || (buffer && filled.contains(*buffer)))
        return false;
    return std::ranges::all_of(operands_of(node), [&](NodeId operand) {
        return is_known_before(program, operand, filled);
    });
}

}  // namespace rddlc::ir
