// Typical outcomes of all actions in many states at once: steps of one batch in which each draw is
// the median of its distribution.
#pragma once

#include "planners/simulation/finite_actions.hpp"
#include "solvers/batches/batch.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::planners {

class TypicalSteps {
  public:
    // `simulator` and `actions` must outlive it.
    TypicalSteps(const rddl_simulator& simulator, const FiniteActions& actions);

    // States that are taken at a time, and the steps that each of them costs.
    std::size_t most_states() const { return most_states_; }
    std::int64_t cost() const { return static_cast<std::int64_t>(actions_.count()); }
    std::size_t action_count() const { return actions_.count(); }
    std::size_t state_size() const { return state_size_; }

    // Results of a state are a function of the state alone.
    void run(std::span<const std::byte* const> states);
    bool is_legal(std::size_t state, std::size_t action) const;
    // -inf where the step faults.
    double reward(std::size_t state, std::size_t action) const;
    // The state after the step; NULL: the episode is over.
    const std::byte* next(std::size_t state, std::size_t action) const;
    // Whether the step leaves the state as it is.
    bool is_unchanged(std::size_t state, std::size_t action) const;

  private:
    std::size_t lane(std::size_t state, std::size_t action) const {
        return state * actions_.count() + action;
    }
    const std::byte* next_state(std::size_t k) const { return next_.data() + k * state_size_; }
    bool is_over(std::size_t k) const;
    bool has_failed(std::size_t k) const;
    void find_legal(std::size_t count);

    const rddl_simulator& simulator_;
    const FiniteActions& actions_;
    std::size_t state_size_, most_states_;
    solvers::BatchHandle batch_;
    std::vector<std::byte> states_, next_, records_;
    std::vector<std::int64_t> steps_;
    std::vector<double> rewards_;
    std::vector<std::uint8_t> causes_;
    std::vector<std::int32_t> violated_;
    std::vector<std::uint8_t> legal_;  // by state and action
};

}  // namespace rddlc::planners
