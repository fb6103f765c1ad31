// Aggregations that several of the cases use that a step may jump over.
//
//     select by a jump(bits(action.a, 0) != 0,
//                      select(action.a[0], f(sum[d in die](...)),
//                             select(action.a[1], g(sum[d in die](...)), ...)), 0)
//
// Emitted code computes them once, before the first case. Packs take most of the cases, since some
// lane takes each. One environment takes one, so what this one does not need must be cheap.
#pragma once

#include "ir/analysis.hpp"
#include "ir/ir.hpp"

#include <span>
#include <vector>

namespace rddlc::ir {

// In the order of the pool: what others use comes first. Nothing if the step does not jump.
std::vector<NodeId> shared_in_cases(const Program& program, std::span<const Properties> properties,
                                    const Select& select);

}  // namespace rddlc::ir
