// An expression of constants and one count, or another int of a small range, becomes a table.
//
//     1.0 / (1.0 + exp(4.5 - real(sum[e in row](int(state.burning[e])))))
//                                       =>
//     burning-by-count[sum[e in row](int(state.burning[e]))]
//
// Constants that differ between the objects of a loop make a row of the table each, or each kind of
// objects where these are few:
//
//     burning-by-count[burning-kind[x], sum[e in row[x]](int(state.burning[e]))]
//
// So does a chain of choices by one int, as domains write that have enumerations:
//
//     select(state.phase == 0, 1, select(state.phase == 1, 2, ...)) => phase-by-phase[state.phase]
//     int(state.die == 0) + 2 * int(state.die == 1) + ...           => value-by-die[state.die]
//
// Only where no entry faults and enough work is saved for the size of the table. A bool becomes a
// comparison instead, if the counts for which it is true lie beside each other.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program tabulate_counts(ir::Program program, Report& report);

}  // namespace rddlc::passes
