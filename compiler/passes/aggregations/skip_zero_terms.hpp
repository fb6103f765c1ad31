// A sum computes only the terms that a bool lets count.
//
//     sum[i in item](sqrt(state.far[i]) * real(action.recommend[i]))
//                                       =>
//     sum[i in item](select(action.recommend[i], sqrt(state.far[i]), 0.0))
//
// The other factors have to be finite and must neither draw nor fault; and they are expensive, or
// do not change in the sum, or the bools are a row (ir/row_of_bools.hpp), of which emitted code
// looks up the true ones. The bool may stand inside the product, as in real(int(action.buy[g, h]) *
// PRICE[g]) * state.factor[g]. The product may be -0.0, but a sum, which begins with 0.0, is the
// same with either zero as a term.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program skip_zero_terms(ir::Program program, Report& report);

}  // namespace rddlc::passes
