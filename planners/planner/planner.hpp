// The one interface of all planners: they search before each action.
#pragma once

#include "planners/simulation/origin.hpp"
#include "solvers/batches/stops.hpp"
#include "solvers/gradients/step_derivatives.hpp"
#include "solvers/policies/policy.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::planners {

inline constexpr std::int64_t no_end = std::numeric_limits<std::int64_t>::max();

// The environment that an action is wanted for.
struct DecisionPoint {
    Origin origin;       // of its futures
    std::int64_t place;  // its number among the environments that the planner acts in
    std::int64_t episode;
    std::int64_t step;
    std::int64_t left;     // steps until the horizon, at least 1; no_end: there is none
    std::int64_t horizon;  // that batches of the planner take
    const solvers::Stops* stops = nullptr;
    std::uint64_t history = 0;  // of actions and observations, where the state is hidden
    // The action of the base policy, which knows the episode from its beginning; NULL: there is no
    // such policy.
    const std::byte* base_action = nullptr;
    // The part of the budget that may be used, of what these steps have left.
    double share = 1;
    std::int64_t steps_spent = 0;
};

// The reasons for a decision.
struct Explanation {
    struct Candidate {
        std::string name;  // "mean", "noop", ...
        std::vector<std::byte> action;
        double value = 0;  // the mean return that was found, discounted
        double error = 0;  // of the mean: a standard error
        std::int64_t trials = 0;
    };
    std::int64_t episode = 0, step = 0;
    std::int64_t depth = 0;  // steps that were looked ahead
    std::int64_t iterations = 0, steps = 0;
    // Different states among the particles, where the state is hidden.
    std::optional<std::int64_t> particles = {};
    std::string note = {};  // why there was no search
    std::vector<Candidate> candidates = {};
    std::size_t chosen = 0;  // of the candidates
};

class Planner {
  public:
    virtual ~Planner() = default;
    // Writes the action record. Where the episode is another one than in the place's decision
    // before, or the step is not a later one, the planner begins without a memory. Reasons are
    // added to `explanation`, unless it is NULL.
    virtual void decide(const DecisionPoint& point, std::byte* action,
                        Explanation* explanation) = 0;
};

// The arguments of every planner's constructor.
struct PlannerContext {
    const rddl_simulator& simulator;
    std::int64_t environments;  // that it acts in
    std::int64_t horizon;       // of batches: 0: the instance's; RDDL_NO_HORIZON: none
    std::int64_t memory_limit;
    // The policy that roll-outs follow; nothing: the user names none.
    std::optional<solvers::Policy> base = {};
    // Empty where the text of the problem is not at hand.
    solvers::DerivativesSource derivatives = {};
    bool sees_state = true;  // else the origins of decisions are particles
};

}  // namespace rddlc::planners
