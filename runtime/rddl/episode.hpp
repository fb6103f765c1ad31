// One environment's episode: how it starts, goes on and ends. It ends when a termination condition
// holds in the new state, when a state invariant is violated there, at the horizon, or by a fault.
#pragma once

#include <rddl/context.hpp>
#include <rddl/engine.hpp>
#include <rddl/random.hpp>
#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl {

// A cache line of its own, so that threads do not write to each other's.
struct alignas(64) Episode {
    std::int64_t number = -1;  // episodes ended before this one
    std::int64_t steps = 0;    // made in this episode
    StreamKey key;
    std::uint8_t causes = RDDL_RUNNING;
    FaultRecord fault;  // of this episode, or of the last one until this one makes a step
    std::int64_t fault_steps = 0;  // made before the fault

    bool over() const { return causes != RDDL_RUNNING; }
    bool terminated() const { return (causes & RDDL_TERMINATED) != 0; }
    bool truncated() const { return (causes & ~RDDL_TERMINATED) != 0; }

    // The draws of the step that leaves timestep t are counted as t + 1, those at reset as 0.
    Context<Scalar> context_at(std::int64_t step) const {
        return {key, static_cast<std::uint32_t>(step), {}};
    }
    void end_by(const FaultRecord& first_fault) {
        causes = RDDL_FAULTED;
        fault = first_fault;
        fault_steps = steps;
    }
};

// Where a step leaves its results until it is known not to have faulted.
struct StepBuffers {
    std::byte* scratch;
    std::byte* next;
    std::byte* observation;
};

// Ends the episode if the state, not reached by a step, is terminal.
template <Engine E>
void end_if_terminal(const E& engine, Episode& episode, const std::byte* state) {
    Context<Scalar> context = episode.context_at(episode.steps);
    episode.causes = engine.terminal(state, context) ? RDDL_TERMINATED : RDDL_RUNNING;
    if (context.fault) episode.end_by(context.fault);
}

// Starts the next episode, in the initial state.
template <Engine E>
void start_next(const E& engine, Episode& episode, std::uint64_t seed, std::uint64_t environment,
                std::byte* state) {
    const std::int64_t number = episode.number + 1;
    episode = {};
    episode.number = number;
    episode.key = stream_key(seed, environment, static_cast<std::uint64_t>(number));
    Context<Scalar> context = episode.context_at(0);
    engine.reset(state, context);
    if (context.fault)
        episode.end_by(context.fault);
    else
        end_if_terminal(engine, episode, state);
}

// One step of a running episode; the reward. The state and, if partially observed, the observation
// change unless the step faults. Preconditions are not looked at.
template <Engine E>
double advance(const E& engine, Episode& episode, std::int64_t horizon, const std::byte* action,
               const StepBuffers& buffers, std::byte* state, std::byte* observation) {
    Context<Scalar> context = episode.context_at(episode.steps + 1);
    const double reward =
        engine.step(state, action, buffers.scratch, buffers.next, buffers.observation, context);
    const bool terminal = engine.terminal(buffers.next, context);
    const bool violation = engine.violated_invariant(buffers.next, context) >= 0;
    if (context.fault) {
        episode.end_by(context.fault);
        return 0.0;
    }
    std::memcpy(state, buffers.next, engine.state_size());
    if (observation != state)
        std::memcpy(observation, buffers.observation, engine.observation_size());
    episode.fault = {};
    ++episode.steps;
    const bool at_horizon = horizon > 0 && episode.steps >= horizon;
    episode.causes = static_cast<std::uint8_t>((terminal ? RDDL_TERMINATED : 0) |
                                               (violation ? RDDL_TRUNCATED_INVARIANT : 0) |
                                               (at_horizon ? RDDL_TRUNCATED_HORIZON : 0));
    return reward;
}

}  // namespace rddl
