// PPO: steps environments with the policy as it is, then improves policy and values by what came of
// it, again and again.
//
// The same options give the same bytes on the same kind of processor, whatever the number of
// threads: random numbers are functions of what they are for, and sums are made in a fixed order.
#pragma once

#include "solvers/ppo/demonstrations.hpp"
#include "solvers/ppo/model.hpp"
#include "solvers/ppo/options.hpp"
#include "solvers/ranks/ranks.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace rddlc::solvers {

// The progress at the last update; means over its samples, or over the episodes that ended in it.
struct PpoProgress {
    std::int64_t steps = 0, updates = 0;  // since the beginning
    std::int64_t episodes = 0;            // that ended in the last update
    double mean_return = 0, mean_discounted_return = 0, mean_length = 0;  // of the last 100 of them
    double success_rate = 0;  // those that a termination ended
    double policy_loss = 0, value_loss = 0, entropy = 0, kl = 0, clip_fraction = 0;
    double explained_variance = 0, deviation = 0, learning_rate = 0;
    double repaired_rate = 0;  // actions that violated a precondition
    double collect_seconds = 0, learn_seconds = 0, simulator_seconds = 0;
    int epochs = 0;  // that were made
};

class PpoTrainer {
  public:
    // Throws a Failure where the options do not fit each other or the problem. The simulator must
    // outlive this. Each rank steps as many environments as the options say, and gives its gradient
    // to all; the same options and number of ranks give the same bytes.
    PpoTrainer(const rddl_simulator& simulator, const PpoOptions& options, const Ranks& ranks = {});
    ~PpoTrainer();

    // Learns to act as was shown, and what that earns; before the first update. Throws a Failure
    // where there are several ranks, or the policy has a memory.
    void imitate(const Demonstrations& shown);
    // Throws a Failure, with the step and the cause, where a loss or a gradient is not finite.
    void update();
    bool done() const;  // the options' steps are made

    const PpoModel& model() const;
    const PpoOptions& options() const;
    const PpoProgress& progress() const;

    // All that it takes to continue as if nothing had happened, on as many ranks.
    std::string save() const;
    // Loads the state of a trainer with the same options. Throws a Failure if the bytes are not
    // such a state, or are of another problem.
    void load(std::string_view bytes);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rddlc::solvers
