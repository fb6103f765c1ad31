// Expressions that read one number only to compare it with constants.
//
//     sum[s in segment](SLOPE[s] * real(state.x >= LEFT[s] && state.x < RIGHT[s]))
//
// is constant between the ends of the segments. `x <= c` changes behind c: at the next number,
// another one for floats.
#pragma once

#include "ir/builder.hpp"
#include "ir/evaluator.hpp"
#include "ir/ir.hpp"

#include <optional>
#include <vector>

namespace rddlc::passes {

struct PiecewiseConstant {
    ir::NodeId number;              // Int or Real; depends on no variable of the expression
    std::vector<ir::Value> breaks;  // where the expression may change; sorted, each once
    // The same for numbers that are Program::real, compared with constants that are: sorted.
    std::vector<ir::Value> entries;

    // A number below the first break, then each break: one for each piece.
    std::vector<ir::Value> representatives() const;
};

// Whether the expression reads nothing else that is not constant. Quick, since nothing is
// evaluated.
bool compares_one_number(const ir::Builder& builder, ir::NodeId id);

// Nothing if the expression reads anything else that is not constant, if it may fault or if there
// are no breaks or too many.
std::optional<PiecewiseConstant> piecewise_constant_of(const ir::Builder& builder,
                                                       const ir::Evaluator& evaluator,
                                                       ir::NodeId id);

}  // namespace rddlc::passes
