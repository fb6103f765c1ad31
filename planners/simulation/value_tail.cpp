#include "planners/simulation/value_tail.hpp"

#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace rddlc::planners {

ValueTail::ValueTail(const solvers::Policy& policy, std::int64_t lanes, const char* option)
    : policy_(policy),
      values_(static_cast<std::size_t>(lanes)),
      steps_(static_cast<std::size_t>(lanes)) {
    if (!policy_.values)
        throw Failure(
            fmt::format("{} needs a policy that estimates values, and '{}' does not", option,
                        policy_.name),
            "policies of 'rddl train ppo' without --recurrent do, where the problem is observed "
            "in full");
    values_of_ = policy_.values(lanes);
}

void ValueTail::add(Futures& futures, std::int64_t steps) {
    if (!futures.any_running()) return;
    std::ranges::fill(steps_, steps);
    values_of_(futures.batch(), steps_, values_.data());
    futures.add_to_running(values_);
}

}  // namespace rddlc::planners
