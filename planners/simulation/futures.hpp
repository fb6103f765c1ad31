// Possible futures of a state: copies of one environment in one batch, each with a random stream of
// its own.
#pragma once

#include "planners/simulation/aligned.hpp"
#include "planners/simulation/origin.hpp"
#include "solvers/batches/batch.hpp"

#include <rddl/simulator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rddlc::planners {

// A batch that is stepped by one thread. `horizon` is as in batches: 0: the instance's,
// RDDL_NO_HORIZON: none.
solvers::BatchHandle batch_of_lanes(const rddl_simulator& simulator, std::int64_t count,
                                    std::int64_t horizon);

class Futures {
  public:
    // The horizon is that of batches.
    Futures(const rddl_simulator& simulator, std::int64_t count, std::int64_t horizon);

    // All begin in environments of the origin; the k-th has the stream of streams[k].
    void begin(const Origin& origin, std::span<const std::uint64_t> streams);
    // The k-th goes on from states[k], after so many steps; those of lanes that are not wanted are
    // any that the problem has.
    void place(const std::byte* states, std::span<const std::int64_t> steps);
    // Stops the k-th after so many steps since begin; no caller reads what the batch does with it
    // then.
    void set_limit(std::size_t k, std::int64_t steps) {
        limits_[k] = steps;
        next_limit_ = std::min(next_limit_, steps);
    }
    // After place(): the k-th has the value that lane from[k] has. Lanes that are named in `from`
    // are their own source.
    void take_values(std::span<const std::uint32_t> from) {
        for (std::size_t k = 0; k < from.size(); ++k) returns_[k] = returns_[from[k]];
    }
    // A record for each.
    void step(const std::byte* actions);

    rddl_batch* batch() { return batch_.get(); }
    std::int64_t count() const { return static_cast<std::int64_t>(returns_.size()); }
    bool is_running(std::size_t k) const { return running_[k] != 0; }
    std::span<const std::uint8_t> running() const { return running_; }
    bool any_running() const { return running_count_ > 0; }
    // So many environments made the last step.
    std::int64_t stepped() const { return stepped_; }
    // The reward of the last step; 0 if the episode was over before.
    double reward(std::size_t k) const { return rewards_[k]; }
    // Whether a limit has ended it, and the reward of the step that ended it.
    double last_reward(std::size_t k) const { return last_rewards_[k]; }
    bool is_cut(std::size_t k) const { return cut_[k] != 0; }
    // The discounted sum since the beginning; -inf after a fault or a reward that is not finite.
    double value(std::size_t k) const { return returns_[k]; }
    std::span<const double> values() const { return returns_; }
    // Adds what is expected to follow, in lanes that still run; discounted as the next step is.
    void add_to_running(std::span<const double> values) {
        for (std::size_t k = 0; k < returns_.size(); ++k)
            if (running_[k]) returns_[k] += discount_ * values[k];
    }

  private:
    static constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();
    rddl_transition outputs();
    void look_at_causes(bool are_alike);
    void take_step();
    void end_good(std::size_t first, std::size_t last);
    void end_any(std::size_t first, std::size_t last);
    void end_by_limits();

    const rddl_simulator& simulator_;
    solvers::BatchHandle batch_;
    std::vector<std::int64_t> sources_;
    std::vector<std::int64_t> limits_;  // steps that it may make
    Aligned<double> rewards_, last_rewards_, returns_;
    std::vector<std::uint8_t> causes_, running_, cut_;
    std::int64_t running_count_ = 0, stepped_ = 0;
    std::int64_t made_ = 0;               // steps since begin
    std::int64_t next_limit_ = no_limit;  // the least one of those that run, or less
    double discount_ = 1;
};

}  // namespace rddlc::planners
