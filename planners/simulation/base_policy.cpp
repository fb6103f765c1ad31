#include "planners/simulation/base_policy.hpp"

#include <algorithm>
#include <utility>

namespace rddlc::planners {

BasePolicy::BasePolicy(const rddl_simulator& simulator, solvers::Policy policy, std::int64_t count)
    : simulator_(simulator),
      policy_(std::move(policy)),
      episodes_(static_cast<std::size_t>(count)),
      steps_(episodes_.size()),
      violated_(episodes_.size(), -1),
      actions_(episodes_.size() * static_cast<std::size_t>(simulator.problem->action_size)) {
    const auto* const action = static_cast<const std::byte*>(simulator_.problem->default_action);
    const auto size = static_cast<std::size_t>(simulator_.problem->action_size);
    for (std::size_t k = 0; k < episodes_.size(); ++k)
        std::copy_n(action, size, actions_.data() + k * size);
}

void BasePolicy::begin(std::int64_t episode, std::span<const std::int64_t> steps,
                       std::int64_t horizon, std::span<const std::uint64_t> numbers) {
    std::ranges::copy(steps, steps_.begin());
    restart(episode, horizon, numbers);
}

void BasePolicy::begin(std::int64_t episode, std::int64_t step, std::int64_t horizon,
                       std::span<const std::uint64_t> numbers) {
    std::ranges::fill(steps_, step);
    restart(episode, horizon, numbers);
}

// A new actor has nothing in its memory that comes from other futures.
void BasePolicy::restart(std::int64_t episode, std::int64_t horizon,
                         std::span<const std::uint64_t> numbers) {
    if (!actor_ || !policy_.is_memoryless)
        actor_ = policy_.start(static_cast<std::int64_t>(episodes_.size()));
    horizon_ = horizon;
    for (std::size_t k = 0; k < episodes_.size(); ++k)  // a recorded plan goes on with its own
        episodes_[k] = policy_.plans > 0 ? episode : static_cast<std::int64_t>(numbers[k] >> 2);
}

void BasePolicy::act(Futures& futures, std::byte* actions, const solvers::Stops* stops) {
    solvers::Decision decision{futures.batch(), futures.running(), episodes_, steps_,
                               actions,         violated_,         false,     stops,
                               horizon_};
    actor_(decision);
    for (std::int64_t& step : steps_) step += 1;
}

void BasePolicy::act(Futures& futures, std::span<const std::uint8_t> wanted, std::byte* actions,
                     const solvers::Stops* stops) {
    act(futures, actions_.data(), stops);
    const auto size = static_cast<std::size_t>(simulator_.problem->action_size);
    for (std::size_t k = 0; k < episodes_.size(); ++k)
        if (wanted[k]) std::copy_n(actions_.data() + k * size, size, actions + k * size);
}

}  // namespace rddlc::planners
