// Environments of one engine that is compared with others: all that a step shows.
#pragma once

#include "engines/load_simulator.hpp"
#include "rollouts/step_outcome.hpp"
#include "solvers/batches/batch.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rddlc::workbench {

struct VerifiedEngine {
    std::string name;  // "compiled, packs of 16 (AVX-512)"
    Simulator simulator;
    bool one_by_one = false;  // each environment in a batch of its own
    int lanes = 0;            // rddl_batch_options::lane_count
    bool compiled = false;
    // Index of the engine that it is compared with, an earlier one, and how far it may be from it.
    std::size_t reference = 0;
    Tolerance tolerance = {};
};

class VerifiedEnvironments {
  public:
    // `horizon` as in rddl_batch_options. All start an episode.
    VerifiedEnvironments(const VerifiedEngine& engine, std::int64_t count, std::uint64_t seed,
                         std::int64_t horizon);

    std::int64_t count() const { return count_; }

    // The next episode where the mask is not 0.
    void restart(const std::vector<std::uint8_t>& mask);
    void set_state(std::int64_t environment, const Record& state);
    // Asks the policy block; `step` then reports its decisions. Returns the action records.
    const std::vector<std::byte>& act();
    // The outcomes of all environments under their actions, environment by environment.
    std::vector<StepOutcome> step(const std::vector<std::byte>& actions);
    // The present states, and whether the episodes are over; makes no step.
    std::vector<StepOutcome> look() const;

    Record state(std::int64_t environment) const;
    // The observation that a policy gets.
    Record observation(std::int64_t environment) const;
    std::int64_t steps(std::int64_t environment) const;     // in its episode
    std::int64_t episodes(std::int64_t environment) const;  // ended before it
    // The batch of all environments; null if each has one of its own.
    rddl_batch* batch() const { return batches_.size() == 1 ? batches_.front().get() : nullptr; }

  private:
    // The place of an environment.
    struct Seat {
        rddl_batch* batch;
        std::int64_t place;
    };
    Seat seat(std::int64_t environment) const;
    // Calls visit(batch, first environment).
    template <class Visit>
    void for_each_batch(const Visit& visit) const;
    std::size_t record(std::int64_t environment, std::int64_t size) const {
        return static_cast<std::size_t>(environment * size);
    }
    void describe(StepOutcome& outcome, std::int64_t environment) const;

    Simulator simulator_;
    std::int64_t count_;
    std::vector<solvers::BatchHandle> batches_;
    std::vector<std::byte> policy_actions_;  // empty: it was not asked since the last step
};

}  // namespace rddlc::workbench
