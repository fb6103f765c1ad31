// The same problem before and after optimisation, step by step.
#pragma once

#include "ir/ir.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace rddlc::fuzzing {

// Roughly the number of simple operations of one step.
double step_cost(const ir::Program& program);

// One episode of both under the same random actions (or the policy block, if there is one) and
// random numbers, at most that many steps.
// Says what differs first, if anything: states, observations, rewards and faults bit for bit (one
// nan is like another), and the conditions.
std::optional<std::string> compare(ir::Program plain, ir::Program optimised, std::uint64_t seed,
                                   int steps);

}  // namespace rddlc::fuzzing
