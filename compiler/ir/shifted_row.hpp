// Loops whose elements become those one place behind them, and terms that an equality chooses.
//
//     for t in time, shifts
//         next.flow[u, t] = 0.0 + (select(TIME[t] == scratch.due[u], scratch.in[u], 0.0) +
//                                  select(IS-THERE[t], state.flow[u, AFTER[t]], 0.0))
//
// The constants say that AFTER[t] is t + 1, that IS-THERE is true except for the last t, and that
// each TIME[t] is greater by 1 than the one before.
#pragma once

#include "ir/ir.hpp"

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace rddlc::ir {

// A term of the element whose place is `value` - `first`; of none, if there is no such place.
struct PlacedTerm {
    NodeId value;
    std::int64_t first;
    NodeId term;
};
struct ShiftedRow {
    BufferId target;                // Next
    BufferId from;                  // State, of the same name
    std::vector<NodeId> indices;    // of the row, the same of both
    NodeId moved;                   // the element of `from`
    std::vector<PlacedTerm> terms;  // added in this order, before the element
};
// Nothing if it is a loop of another form.
std::optional<ShiftedRow> shifted_row(const Program& program, const Loop& loop);

// The loop with `shifts` of a definition; null if it has none.
const Loop* shifting_loop(const Definition& definition);
// The names of the tables of the state that the program's step for moderate values shifts; in packs
// they slide along buffers (rddl/values/sliding_tables.hpp). What a step has done there cannot be
// undone, so there are none where a step or a condition may fault.
std::set<std::string> sliding_tables(const Program& program);
// The tables of constants that only say how rows are shifted.
std::set<BufferId> read_by_shifts_alone(const Program& program);

}  // namespace rddlc::ir
