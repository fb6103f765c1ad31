// Draws whose probabilities are shares of a total.
//
//     discrete@0[p over a](weight[a, p] / total)
//     discrete@0(x / total, y / total, z / total)
//
// Emitted code compares sums of weights with a part of the total, without the divisions.
#pragma once

#include "ir/analysis.hpp"
#include "ir/ir.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rddlc::ir {

struct Shares {
    std::vector<NodeId> weights;  // of DiscreteOver one, which depends on its variable
    NodeId total;
};

// Nothing if some weight may be negative, or if the draw is of another form.
std::optional<Shares> shares_of(const Program& program, std::span<const Properties> properties,
                                const Node& draw);

}  // namespace rddlc::ir
