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

}  // namespace rddlc::ir
