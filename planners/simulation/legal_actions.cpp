#include "planners/simulation/legal_actions.hpp"

#include <algorithm>

namespace rddlc::planners {

LegalActions::LegalActions(const rddl_simulator& simulator, const solvers::ActionSpace& space,
                           const solvers::ActionRecords& records, std::int64_t lanes)
    : simulator_(simulator),
      space_(space),
      records_(records),
      repair_(simulator, space, lanes),
      violated_(static_cast<std::size_t>(lanes)),
      rows_(violated_.size() * static_cast<std::size_t>(space.column_count)) {}

// Most actions are legal most of the time, so that rows of values are made only where some are not.
void LegalActions::make_legal(rddl_batch* batch, std::byte* actions) {
    if (!space_.may_be_illegal) return;
    solvers::require_done(simulator_,
                          simulator_.violated_preconditions(batch, actions, violated_.data()));
    if (std::ranges::all_of(violated_, [](std::int32_t first) { return first < 0; })) return;
    const auto columns = static_cast<std::size_t>(space_.column_count);
    for (std::size_t k = 0; k < violated_.size(); ++k)
        records_.read(actions + k * records_.record_size(), rows_.data() + k * columns);
    solvers::repair_actions(simulator_, space_, records_, batch, rows_.data(), actions, repair_);
}

}  // namespace rddlc::planners
