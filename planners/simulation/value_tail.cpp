#include "planners/simulation/value_tail.hpp"

#include <algorithm>
#include <cstddef>

namespace rddlc::planners {

ValueTail::ValueTail(const solvers::Policy& policy, std::int64_t lanes)
    : policy_(policy),
      values_of_(policy_.values(lanes)),
      values_(static_cast<std::size_t>(lanes)),
      steps_(static_cast<std::size_t>(lanes)) {}

void ValueTail::add(Futures& futures, std::int64_t steps) {
    if (!futures.any_running()) return;
    std::ranges::fill(steps_, steps);
    values_of_(futures.batch(), steps_, values_.data());
    futures.add_to_running(values_);
}

}  // namespace rddlc::planners
