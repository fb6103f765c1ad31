// The episodes of a block of environments: how they start, go on and end. An episode ends when a
// termination condition holds in the new state, when a state invariant is violated there, at the
// horizon, or by a fault.
#pragma once

#include <rddl/columns.hpp>
#include <rddl/context.hpp>
#include <rddl/engine.hpp>
#include <rddl/random.hpp>
#include <rddl/simulator.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl {

// Begins at a cache line of its own, so that threads do not write to each other's.
template <class L>
struct alignas(64) Episodes {
    using Bool = typename L::Bool;
    using Int = typename L::Int;
    using Word = typename L::Word;

    Bool present{true};            // false: no environment in this lane, for ever
    Int number{std::int64_t{-1}};  // episodes ended before this one
    Int steps{std::int64_t{0}};    // made in this episode
    Word key_low{std::uint64_t{0}}, key_high{std::uint64_t{0}};

    // Why it is over.
    Bool terminated{false}, beyond_horizon{false}, violated{false}, faulted{false};

    // The fault of this episode, or of the last one until this one makes a step.
    Bool has_fault{false};
    std::array<FaultRecord, static_cast<std::size_t>(L::width)> faults;
    std::array<std::int64_t, static_cast<std::size_t>(L::width)> fault_steps;  // made before

    Bool truncated() const { return beyond_horizon || violated || faulted; }
    Bool over() const { return terminated || truncated(); }
    Bool running() const { return present && !over(); }

    std::uint8_t causes(int lane) const {
        return static_cast<std::uint8_t>(
            (get_lane(terminated, lane) ? RDDL_TERMINATED : 0) |
            (get_lane(beyond_horizon, lane) ? RDDL_TRUNCATED_HORIZON : 0) |
            (get_lane(violated, lane) ? RDDL_TRUNCATED_INVARIANT : 0) |
            (get_lane(faulted, lane) ? RDDL_FAULTED : 0));
    }

    // The draws of the step that leaves timestep t are counted as t + 1, those at reset as 0.
    Context<L> context_of_step(Bool active) const {
        return Context<L>::of(key_low, key_high, next_step(), active);
    }
    Context<L> context_of_state(Bool active) const {
        return Context<L>::of(key_low, key_high, words_of(steps), active);
    }

    void end_by_faults(const Context<L>& context) {
        for_each_lane(context.faulted(), [&](int lane) {
            const auto place = static_cast<std::size_t>(lane);
            faults[place] = context.fault_of(lane);
            fault_steps[place] = get_lane(steps, lane);
            set_lane(has_fault, lane, true);
            set_lane(faulted, lane, true);
            set_lane(terminated, lane, false);
            set_lane(beyond_horizon, lane, false);
            set_lane(violated, lane, false);
        });
    }

  private:
    Word next_step() const { return words_of(steps) + Word{std::uint64_t{1}}; }
};

// Where a step leaves its results until it is known not to have faulted.
struct StepBuffers {
    std::byte* scratch;
    std::byte* next;
    std::byte* observation;
};

// Ends the episodes whose state, not reached by a step, is terminal; the others of `lanes` run.
template <StartingEngine E, class L = typename E::Lane>
void end_if_terminal(const E& engine, Episodes<L>& episodes, typename L::Bool lanes,
                     const std::byte* states) {
    using Bool = typename L::Bool;
    Context<L> context = episodes.context_of_state(lanes);
    const Bool terminal = engine.terminal(states, context);
    episodes.terminated = select(lanes, terminal, episodes.terminated);
    episodes.beyond_horizon = select(lanes, Bool(false), episodes.beyond_horizon);
    episodes.violated = select(lanes, Bool(false), episodes.violated);
    episodes.faulted = select(lanes, Bool(false), episodes.faulted);
    if (any(context.faulted())) episodes.end_by_faults(context);
}

// Starts the next episodes of these lanes, in the initial state. `identity` is that of lane 0;
// `room` is a block of states to work in.
template <StartingEngine E, class L = typename E::Lane>
void start_next(const E& engine, const Columns& columns, Episodes<L>& episodes,
                typename L::Bool lanes, std::uint64_t seed, std::uint64_t identity, std::byte* room,
                std::byte* states) {
    for_each_lane(lanes, [&](int lane) {
        const std::int64_t number = get_lane(episodes.number, lane) + 1;
        const StreamKey key = stream_key(seed, identity + static_cast<std::uint64_t>(lane),
                                         static_cast<std::uint64_t>(number));
        set_lane(episodes.number, lane, number);
        set_lane(episodes.steps, lane, std::int64_t{0});
        set_lane(episodes.key_low, lane, std::uint64_t{key.low});
        set_lane(episodes.key_high, lane, std::uint64_t{key.high});
        set_lane(episodes.has_fault, lane, false);
    });
    Context<L> context = episodes.context_of_state(lanes);
    engine.reset(room, context);
    merge(L{}, columns, lanes, room, states);
    end_if_terminal(engine, episodes, lanes && !context.faulted(), states);
    if (any(context.faulted())) episodes.end_by_faults(context);
}

// One step of the running episodes; the rewards, 0 where none is made. States and, if partially
// observed, observations change unless the step faults. Preconditions are not looked at.
template <Engine E, class L = typename E::Lane>
typename L::Real advance(const E& engine, const Columns& state_columns,
                         const Columns& observation_columns, Episodes<L>& episodes,
                         std::int64_t horizon, const std::byte* actions, const StepBuffers& buffers,
                         std::byte* states, std::byte* observations) {
    using Bool = typename L::Bool;
    using Int = typename L::Int;
    using Real = typename L::Real;
    const Bool running = episodes.running();
    if (!any(running)) return Real{0.0};
    Context<L> context = episodes.context_of_step(running);
    const Real reward =
        engine.step(states, actions, buffers.scratch, buffers.next, buffers.observation, context);
    const Bool terminal = engine.terminal(buffers.next, context);
    const Bool violation = engine.violated_invariant(buffers.next, context) >= Int{0};
    if (any(context.faulted())) episodes.end_by_faults(context);

    const Bool moved = running && !context.faulted();
    const Bool whole_block = moved || !episodes.present;  // whatever there is in absent lanes
    merge(L{}, state_columns, whole_block, buffers.next, states);
    if (observations != states)
        merge(L{}, observation_columns, whole_block, buffers.observation, observations);
    episodes.has_fault = episodes.has_fault && !moved;
    episodes.steps = select(moved, wrap_add(episodes.steps, Int{1}), episodes.steps);
    episodes.terminated = select(moved, terminal, episodes.terminated);
    episodes.violated = select(moved, violation, episodes.violated);
    if (horizon > 0)
        episodes.beyond_horizon =
            select(moved, episodes.steps >= Int{horizon}, episodes.beyond_horizon);
    return select(moved, reward, Real{0});
}

}  // namespace rddl
