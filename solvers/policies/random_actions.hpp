// Random legal actions for all environments of a batch at once.
#pragma once

#include "solvers/batches/batch.hpp"
#include "solvers/batches/stops.hpp"
#include "solvers/policies/random_policy.hpp"

#include <rddl/simulator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::solvers {

class RandomActions {
  public:
    // `simulator` and `policy` must outlive this.
    RandomActions(const rddl_simulator& simulator, RandomPolicy& policy, std::int64_t environments)
        : simulator_(&simulator),
          policy_(&policy),
          violated_(static_cast<std::size_t>(environments), -1),
          searches_(violated_.size()) {}

    // Sets where a search for legal actions ends early; what it points to must outlive this.
    void set_stops(const Stops* stops) { stops_ = stops; }

    // Writes the action with which environment i leaves its state wherever is_running(i); legal
    // where the policy finds such an action. The policy knows that environment and timestep as
    // `environment_of(i)` and `step_of(i)`.
    template <class IsRunning, class EnvironmentOf, class StepOf>
    void draw(rddl_batch* batch, std::byte* actions, IsRunning is_running,
              EnvironmentOf environment_of, StepOf step_of) {
        const auto action = [&](std::size_t i) {
            return actions + i * static_cast<std::size_t>(simulator_->problem->action_size);
        };
        for (std::size_t i = 0; i < violated_.size(); ++i)
            if (is_running(i)) policy_->act(environment_of(i), step_of(i), action(i));
        if (simulator_->problem->precondition_count == 0) return;

        // All environments make their tries side by side, since the simulator is asked about all
        // of them at once.
        for (RandomPolicy::Search& search : searches_) search.restart();
        for (bool searching = true; searching && !is_stopped(stops_);) {
            require_done(*simulator_,
                         simulator_->violated_preconditions(batch, actions, violated_.data()));
            searching = false;
            for (std::size_t i = 0; i < violated_.size(); ++i)
                if (is_running(i) && violated_[i] >= 0)
                    searching |= policy_->try_another(environment_of(i), step_of(i), searches_[i],
                                                      action(i));
        }
    }

    // The precondition that the action of environment i, as drawn last, violates; -1: it is legal.
    std::int32_t violated(std::size_t i) const { return violated_[i]; }

  private:
    const rddl_simulator* simulator_;
    RandomPolicy* policy_;
    std::vector<std::int32_t> violated_;
    std::vector<RandomPolicy::Search> searches_;
    const Stops* stops_ = nullptr;
};

}  // namespace rddlc::solvers
