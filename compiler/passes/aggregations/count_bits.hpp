// An aggregation over a table of bools counts in bits.
//
//     sum[entry in row(LINK-rows, c)](int(state.running[LINK-c2[entry]]))
//                                       =>
//     count_ones(bit_and(bits(state.running, 0), LINK-bits[c]))
//
//     exists[c in computer](state.running[c] & action.reboot[c])
//                                       =>
//     bit_and(bits(state.running, 0), bits(action.reboot, 0)) != 0
//
// A forall over a conjunction, or an exists over a disjunction, is tested by its parts.
//
// Which elements count must be known, and all tables must be read at the same place. A place has
// one bit: if several entries of a row read it, a sum would not count it once for each of them, so
// the sum stays; and so does a test if its known conditions differ between these entries. An int
// holds 64 bits, so this is for tables of a few hundred elements; larger tables have sparse rows.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program count_bits(ir::Program program, Report& report);

}  // namespace rddlc::passes
