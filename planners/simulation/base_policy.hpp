// A policy that plays futures. It begins without a memory of what was before them.
#pragma once

#include "planners/simulation/futures.hpp"
#include "solvers/policies/policy.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rddlc::planners {

class BasePolicy {
  public:
    // `simulator` must outlive it.
    BasePolicy(const rddl_simulator& simulator, solvers::Policy policy, std::int64_t count);

    // Lane k is at steps[k] of the episode. What the policy draws is by the numbers of lanes alone:
    // lane k has numbers[k].
    void begin(std::int64_t episode, std::span<const std::int64_t> steps, std::int64_t horizon,
               std::span<const std::uint64_t> numbers);
    void begin(std::int64_t episode, std::int64_t step, std::int64_t horizon,
               std::span<const std::uint64_t> numbers);
    // Writes action records of all lanes that run, before a step of all. The others have to
    // hold records before.
    void act(Futures& futures, std::byte* actions, const solvers::Stops* stops);
    // The same for those that `wanted` says.
    void act(Futures& futures, std::span<const std::uint8_t> wanted, std::byte* actions,
             const solvers::Stops* stops);

    // Whether all actions are the same, so that those of one step serve for all that follow.
    bool is_constant() const { return policy_.is_constant; }

  private:
    void restart(std::int64_t episode, std::int64_t horizon,
                 std::span<const std::uint64_t> numbers);

    const rddl_simulator& simulator_;
    solvers::Policy policy_;
    solvers::Actor actor_;
    std::vector<std::int64_t> episodes_, steps_;
    std::vector<std::int32_t> violated_;
    std::vector<std::byte> actions_;
    std::int64_t horizon_ = 0;
};

}  // namespace rddlc::planners
