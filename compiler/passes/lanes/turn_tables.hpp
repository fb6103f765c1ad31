// Tables of bools that loops read by columns are stored by columns, so that registers load and
// store them in rows (read_rows.hpp).
//
//     for y in row                                        for z in row
//         for z in row                                        for y in row, several at once
//             moves[y, z] = FROM[z] - FROM[y] == n[z]  =>         moves-turned[z, y] = ...
//     for y in row                                        for y in row
//         next.full[y] = exists[z in row](                    next.full[y] = exists[z in row](
//             moves[y, z] && state.full[z])                       moves-turned[z, y] &&
//             state.full[z])
//
// Only if all that reads the table does so, and if its own loop can be evaluated for several
// objects at once then.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program turn_tables(ir::Program program, Report& report);

}  // namespace rddlc::passes
