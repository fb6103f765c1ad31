// Actions of many environments, made legal before a step.
#pragma once

#include "solvers/batches/batch.hpp"
#include "solvers/spaces/action_repair.hpp"
#include "solvers/spaces/actions.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::planners {

class LegalActions {
  public:
    // For batches of `lanes` environments. The arguments must outlive it.
    LegalActions(const rddl_simulator& simulator, const solvers::ActionSpace& space,
                 const solvers::ActionRecords& records, std::int64_t lanes);
    // Repairs the records that violate preconditions in the state of their environment.
    void make_legal(rddl_batch* batch, std::byte* actions);

  private:
    const rddl_simulator& simulator_;
    const solvers::ActionSpace& space_;
    const solvers::ActionRecords& records_;
    solvers::RepairBuffers repair_;
    std::vector<std::int32_t> violated_;
    std::vector<float> rows_;
};

}  // namespace rddlc::planners
