// A batch of the hand-written simulator, driven through the C interface.
#pragma once

#include "tiny_simulator.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tiny {

using StateRecord = State<Scalar>;
using ActionRecord = Action<Scalar>;

// Records whose padding is also zero, to be compared byte by byte.
inline std::vector<StateRecord> blank_states(std::size_t count) {
    std::vector<StateRecord> states(count);
    std::memset(static_cast<void*>(states.data()), 0, count * sizeof(StateRecord));
    return states;
}

constexpr rddl_batch_options batch_options(std::int64_t count, std::int64_t first = 0,
                                           std::uint64_t seed = 42, std::int32_t threads = 1,
                                           rddl_autoreset autoreset = RDDL_AUTORESET_DISABLED,
                                           std::int64_t horizon = 0, std::int32_t lanes = 0) {
    return {.struct_size = sizeof(rddl_batch_options),
            .thread_count = threads,
            .environment_count = count,
            .first_environment = first,
            .seed = seed,
            .autoreset = autoreset,
            .lane_count = lanes,
            .horizon = horizon,
            .keeps_steps = 0};
}

class TinyBatch {
  public:
    explicit TinyBatch(const rddl_batch_options& options,
                       const rddl_simulator* functions = simulator())
        : TinyBatch(functions->create(functions, &options),
                    static_cast<std::size_t>(options.environment_count), functions) {}
    TinyBatch(rddl_batch* batch, std::size_t size, const rddl_simulator* functions = simulator())
        : observations(blank_states(size)),
          finals(blank_states(size)),
          actions(size),
          rewards(size),
          terminated(size),
          truncated(size),
          causes(size),
          functions_(functions),
          batch_(batch) {}
    TinyBatch(const TinyBatch&) = delete;
    ~TinyBatch() { functions_->destroy(batch_); }

    rddl_batch* get() { return batch_; }
    std::size_t size() const { return actions.size(); }

    // Steps with the actions in `actions`.
    void step() {
        const rddl_transition out{.struct_size = sizeof(rddl_transition),
                                  .observations = observations.data(),
                                  .rewards = rewards.data(),
                                  .terminated = terminated.data(),
                                  .truncated = truncated.data(),
                                  .causes = causes.data(),
                                  .final_observations = finals.data(),
                                  .final_states = nullptr,
                                  .final_observation_values = nullptr};
        ASSERT_EQ(functions_->step(batch_, actions.data(), &out), RDDL_OK);
    }
    std::vector<StateRecord> states() {
        std::vector<StateRecord> states = blank_states(size());
        const auto count = static_cast<std::int64_t>(size());
        EXPECT_EQ(functions_->get_state(batch_, 0, count, states.data()), RDDL_OK);
        return states;
    }

    std::vector<StateRecord> observations, finals;
    std::vector<ActionRecord> actions;
    std::vector<double> rewards;
    std::vector<std::uint8_t> terminated, truncated, causes;

  private:
    const rddl_simulator* functions_;
    rddl_batch* batch_;
};

// A policy that depends on nothing but the environment's identity and the time.
inline ActionRecord action_of(std::int64_t environment, int time) {
    ActionRecord action{};
    action.set_mode = (environment + time) % 3 == 0;
    const std::int64_t machine = (environment + 2 * time) % 5;
    if (machine < machines) action.repair[static_cast<std::size_t>(machine)] = true;
    if (environment % 97 == 13 && time == 20) action.hazard = 3.0;  // faults
    return action;
}

}  // namespace tiny
