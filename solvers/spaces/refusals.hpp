// Finds which learner accepts a problem, without a step of it.
#pragma once

#include <rddl/simulator.h>

#include <cstdint>
#include <optional>
#include <string>

namespace rddlc::solvers {

// Why a learner does not take the problem, in the sentence by which it refuses to train; nothing
// where it does. Options that ask for more, as --compat does, may be refused nevertheless.
struct Refusals {
    std::optional<std::string> ppo, cgp;
};
Refusals refusals(const rddl_simulator& simulator);

// Whether nothing ends an episode of so many steps, 0 for no horizon; and the sentence that says
// so.
bool is_endless(const rddl_problem& problem, std::int64_t horizon);
inline constexpr const char* endless =
    "nothing ends an episode of this problem: it has no horizon, no termination and no invariant";

// An episode that nothing ends would never be learned from. Throws a Failure.
void require_an_end_to_learn(const rddl_problem& problem);

}  // namespace rddlc::solvers
