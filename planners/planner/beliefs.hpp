// The knowledge that a planner has of episodes whose states are hidden: particles that have met the
// same observations after the same actions.
#pragma once

#include "planners/planner/planner.hpp"
#include "planners/simulation/particles.hpp"
#include "solvers/policies/policy.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::planners {

class Beliefs {
  public:
    // So many particles of each environment that the planner acts in. The horizon is that of
    // batches.
    Beliefs(const rddl_simulator& simulator, std::int64_t particles, std::int64_t environments,
            std::int64_t horizon, std::uint64_t seed);

    // Takes the observation that environment `place` of the decision has made. Throws a Failure
    // where its episode has steps that it was not told of.
    const Particles& after(const solvers::Decision& decision, std::size_t place);
    // A number of all actions and observations of the episode.
    std::uint64_t history(std::size_t place) const { return beliefs_[place].history; }
    // The action that environment `place` takes.
    void note_action(std::size_t place, const std::byte* action);

  private:
    struct Belief {
        std::optional<Particles> particles;
        std::int64_t episode = -1, step = 0;
        std::vector<std::byte> action;
        std::uint64_t history = 0;
    };

    const rddl_simulator& simulator_;
    std::int64_t particles_, horizon_;
    std::uint64_t seed_;
    std::vector<std::byte> observation_;
    std::vector<Belief> beliefs_;
};

// The number of a history that goes on with that action and observation.
std::uint64_t next_history(const rddl_problem& problem, std::uint64_t history,
                           const std::byte* action, const std::byte* observation);

}  // namespace rddlc::planners
