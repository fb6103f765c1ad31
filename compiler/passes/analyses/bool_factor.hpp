// Products with a bool as a number among their factors.
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <optional>

namespace rddlc::passes {

// Operations (Properties::cost) that cost more than a mispredicted branch around them.
inline constexpr double worth_a_branch = 20;

// A product as a bool and what it is where the bool holds: nothing stands for 1.
struct BoolFactor {
    ir::NodeId counts;
    std::optional<ir::NodeId> value;
};

// The bool is a factor of the term, or of one of its factors, also of a product of ints.
std::optional<BoolFactor> without_bool_factor(ir::Builder& builder, ir::NodeId term);

}  // namespace rddlc::passes
