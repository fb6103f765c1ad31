// A product of constants that the bools of a row choose looks up the product of a few of them at
// once, by their bits.
//
//     select(state.seen[0], 0.5, 1.0) * select(state.seen[1], 0.75, 1.0) * ...
//         * select(state.seen[9], 2.75, 1.0) * real(!state.seen[10])
//                                       =>
//     select(bit_and(bits(state.seen, 0), 1024) == 0,
//            seen-products[bit_and(bits(state.seen, 0), 31)]
//                * seen-products-2[bit_and(shift_right(bits(state.seen, 0), 5), 31)],
//            0.0)
//
// Only products that never round are taken, since they are the same in any order: factors are
// positive, and their odd parts have no more bits together than a real.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program tabulate_products(ir::Program program, Report& report);

}  // namespace rddlc::passes
