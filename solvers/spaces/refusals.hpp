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
    std::optional<std::string> ppo, cgp, drp;
};
// `no_derivatives` is why there are no derivatives of a step, which drp needs.
Refusals refusals(const rddl_simulator& simulator,
                  const std::optional<std::string>& no_derivatives = {});

// Whether nothing ends an episode of so many steps, 0 for no horizon; and the sentence that says
// so.
bool is_endless(const rddl_problem& problem, std::int64_t horizon);
inline constexpr const char* endless =
    "nothing ends an episode of this problem: it has no horizon, no termination and no invariant";

// An episode that nothing ends would never be learned from. Throws a Failure.
void require_an_end_to_learn(const rddl_problem& problem);

// Gradients of a return go back from the horizon, by states that are seen and actions that are not
// all objects. `horizon` is that of episodes; 0: none. Throws a Failure.
void require_a_gradient_to_learn(const rddl_simulator& simulator, std::int64_t horizon);

}  // namespace rddlc::solvers
