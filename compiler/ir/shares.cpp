#include "ir/shares.hpp"

#include <variant>

namespace rddlc::ir {
namespace {

// More weights round so often that sums of them and of their shares may differ by too much.
constexpr std::int64_t most_weights = 64;

// Adds the weight of which the probability is a share.
bool add_weight(const Program& program, std::span<const Properties> properties, NodeId probability,
                std::vector<NodeId>& weights, std::optional<NodeId>& total) {
    const auto* share = std::get_if<Apply>(&program[probability].form);
    if (!share || share->op != Operator::Divide) return false;
    const NodeId weight = share->operands.front(), divisor = share->operands.back();
    const auto& range = properties[weight.index].range;
    if (!range || range->lower < 0 || (total && *total != divisor)) return false;
    weights.push_back(weight);
    total = divisor;
    return true;
}

// The only axis in which two loads of a table have different indices.
std::optional<std::size_t> only_difference(const Load& a, const Load& b) {
    std::optional<std::size_t> axis;
    for (std::size_t k = 0; k < a.indices.size(); ++k) {
        if (a.indices[k] == b.indices[k]) continue;
        if (axis) return std::nullopt;
        axis = k;
    }
    return axis;
}

}  // namespace

std::optional<Shares> shares_of(const Program& program, std::span<const Properties> properties,
                                const Node& draw) {
    std::vector<NodeId> weights;
    std::optional<NodeId> total;
    if (const auto* discrete = std::get_if<Discrete>(&draw.form)) {
        if (discrete->normalise || std::ssize(discrete->weights) > most_weights)
            return std::nullopt;
        for (const NodeId probability : discrete->weights)
            if (!add_weight(program, properties, probability, weights, total)) return std::nullopt;
    } else {
        const auto* over = std::get_if<DiscreteOver>(&draw.form);
        if (!over || over->normalise || program[over->variable].size > most_weights ||
            !add_weight(program, properties, over->weight, weights, total) ||
            depends_on_any(properties[total->index], {&over->variable, 1}))
            return std::nullopt;
    }
    return Shares{std::move(weights), *total};
}

std::optional<SharesOfElements> shares_of_elements(const Program& program, const Node& draw) {
    const auto* const over = std::get_if<DiscreteOver>(&draw.form);
    if (!over || over->normalise || program[over->variable].size > most_weights)
        return std::nullopt;
    const auto* const share = std::get_if<Apply>(&program[over->weight].form);
    if (!share || share->op != Operator::Divide) return std::nullopt;
    const NodeId total = share->operands.back();
    const auto* const weight = std::get_if<Load>(&program[share->operands.front()].form);
    const auto* const sum = std::get_if<Reduce>(&program[total].form);
    if (!weight || !sum || sum->op != Reduction::Sum || sum->bounds ||
        program[sum->variable].size != program[over->variable].size)
        return std::nullopt;
    const auto* const term = std::get_if<Load>(&program[sum->body].form);
    const auto& range = program[weight->buffer].range;
    if (!term || term->buffer != weight->buffer || !range || range->lower < 0) return std::nullopt;
    const auto axis = only_difference(*weight, *term);
    if (!axis || program[weight->buffer].shape[*axis] != program[over->variable].size ||
        !is_index_of(program, weight->indices[*axis], over->variable) ||
        !is_index_of(program, term->indices[*axis], sum->variable))
        return std::nullopt;
    return SharesOfElements{*weight, *axis, program[over->variable].size, total};
}

}  // namespace rddlc::ir
