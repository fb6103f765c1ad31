// The return after the last step of futures, by the values that a policy has learned.
#pragma once

#include "planners/simulation/futures.hpp"
#include "solvers/policies/policy.hpp"

#include <cstdint>
#include <vector>

namespace rddlc::planners {

class ValueTail {
  public:
    // For futures of so many lanes. The policy must have values.
    ValueTail(const solvers::Policy& policy, std::int64_t lanes);

    // Adds the discounted value of its state to each lane that still runs, after so many steps of
    // the episode.
    void add(Futures& futures, std::int64_t steps);

  private:
    solvers::Policy policy_;  // outlives its values
    solvers::StateValues values_of_;
    std::vector<double> values_;
    std::vector<std::int64_t> steps_;
};

}  // namespace rddlc::planners
