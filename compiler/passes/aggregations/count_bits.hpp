// What an aggregation counts of a table of bools, it counts in bits.
//
//     sum[entry in row(LINK-rows, c)](int(state.running[LINK-c2[entry]]))
//                                       =>
//     count_ones(bit_and(bits(state.running, 0), LINK-bits[c]))
//
//     exists[c in computer](state.running[c] & action.reboot[c])
//                                       =>
//     bit_and(bits(state.running, 0), bits(action.reboot, 0)) != 0
//
// Which elements count must be known, and all tables must be read at the same place. A place has one
// bit: where several entries of a row look at it, a sum does not count it once for each of them, so
// it stays; and so does a test if what is known differs between these entries. An int holds 64
// bits, so this is for tables of a few hundred elements; what is larger has sparse rows.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program count_bits(ir::Program program, Report& report);

}  // namespace rddlc::passes
