// Draws whose probabilities are shares of a total.
//
//     discrete@0[p over a](weight[a, p] / total)
//     discrete@0(x / total, y / total, z / total)
//
// Emitted code compares sums of weights with a part of the total, without the divisions.
#pragma once

#include "ir/analysis.hpp"
#include "ir/ir.hpp"

#include <cstddef>
#include <cstdint>
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

// The doubles of a register of AVX-512. One environment waits for masked stores of fewer.
inline constexpr std::int64_t weights_of_row = 8;

// A draw over objects whose weights are the elements of one axis of a table, and the total their
// sum:
//
//     discrete@0[p][c in area](weight[p, c] / sum[a in area](weight[p, a]))
struct SharesOfElements {
    Load weight;
    std::size_t axis;
    std::int64_t count;  // of weights
    NodeId total;

    // They lie beside each other and fill a register.
    bool is_row() const { return axis + 1 == weight.indices.size() && count == weights_of_row; }
};
std::optional<SharesOfElements> shares_of_elements(const Program& program, const Node& draw);

}  // namespace rddlc::ir
