// The episodes of a block of environments: how they start, go on and end. An episode ends when a
// termination condition holds in the new state, when a state invariant is violated there, at the
// horizon, or by a fault.
#pragma once

#include <rddl/columns.hpp>
#include <rddl/context.hpp>
#include <rddl/engine.hpp>
#include <rddl/random.hpp>
#include <rddl/simulator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl {

// Why the episodes of a block are over; those that run have none.
template <class L>
struct Ends {
    using Bool = typename L::Bool;
    Bool terminated{false}, beyond_horizon{false}, violated{false}, faulted{false};

    Bool truncated() const { return beyond_horizon || violated || faulted; }
    Bool any() const { return terminated || truncated(); }

    std::uint8_t causes(int lane) const {
        return static_cast<std::uint8_t>(
            (get_lane(terminated, lane) ? RDDL_TERMINATED : 0) |
            (get_lane(beyond_horizon, lane) ? RDDL_TRUNCATED_HORIZON : 0) |
            (get_lane(violated, lane) ? RDDL_TRUNCATED_INVARIANT : 0) |
            (get_lane(faulted, lane) ? RDDL_FAULTED : 0));
    }
};

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
    Ends<L> ends;

    // The fault of this episode, or of the last one until this one makes a step.
    Bool has_fault{false};
    std::array<FaultRecord, static_cast<std::size_t>(L::width)> faults;
    std::array<std::int64_t, static_cast<std::size_t>(L::width)> fault_steps;  // made before

    Bool is_present() const {
        if constexpr (L::width == 1) return true;
        return present;
    }
    Bool over() const { return is_present() && ends.any(); }
    Bool running() const { return is_present() && !ends.any(); }

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
            set_lane(ends.terminated, lane, false);
            set_lane(ends.beyond_horizon, lane, false);
            set_lane(ends.violated, lane, false);
            set_lane(ends.faulted, lane, true);
        });
    }

  private:
    Word next_step() const { return words_of(steps) + Word{std::uint64_t{1}}; }
};

// The environments of a batch, in blocks.
template <class L>
struct Blocks {
    std::int64_t environment_count;
    std::int64_t horizon;  // 0: none
    Episodes<L>* episodes;
    std::byte* states;
    std::byte* observations;  // null when fully observed
    const Columns* state_columns;
    const Columns* observation_columns;

    int lanes_of(std::int64_t b) const {
        if constexpr (L::width == 1) return 1;
        return static_cast<int>(std::min<std::int64_t>(L::width, environment_count - b * L::width));
    }
};

// Ends the episodes whose state, not reached by a step, is terminal; the others of `lanes` run.
template <StartingEngine E, class L = typename E::Lane>
void end_if_terminal(const E& engine, Episodes<L>& episodes, typename L::Bool lanes,
                     const std::byte* states) {
    using Bool = typename L::Bool;
    Context<L> context = episodes.context_of_state(lanes);
    const Bool terminal = engine.terminal(states, context);
    Ends<L>& ends = episodes.ends;
    ends.terminated = select(lanes, terminal, ends.terminated);
    ends.beyond_horizon = select(lanes, Bool(false), ends.beyond_horizon);
    ends.violated = select(lanes, Bool(false), ends.violated);
    ends.faulted = select(lanes, Bool(false), ends.faulted);
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

// States and observations become those that a step made, where the mask holds. `memory` is room to
// work in.
template <Engine E, class L = typename E::Lane>
void take_over(const E& engine, const Blocks<L>& blocks, std::int64_t b, typename L::Bool mask,
               const StepBuffers& made, const StepBuffers& memory) {
    const auto place = static_cast<std::size_t>(b);
    std::byte* const states = blocks.states + place * engine.state_size();
    const bool observed = blocks.observations != nullptr;
    std::byte* const observations =
        observed ? blocks.observations + place * engine.observation_size() : nullptr;
    if (all(mask)) {
        copy_state(engine, made.next, states);
        if (observed) copy_observation(engine, made.observation, observations);
    } else if (any(mask)) {
        if (made.next != memory.next) copy_state(engine, made.next, memory.next);
        merge(L{}, *blocks.state_columns, mask, memory.next, states);
        if (!observed) return;
        if (made.next != memory.next)
            copy_observation(engine, made.observation, memory.observation);
        merge(L{}, *blocks.observation_columns, mask, memory.observation, observations);
    }
}

// One step of the running episodes of block `b`, with why they are over then; the rewards, 0 where
// none is made. States and, if partially observed, observations change unless the step faults.
// Preconditions are not looked at.
template <Engine E, class L = typename E::Lane>
typename L::Real make_step(const E& engine, const Blocks<L>& blocks, std::int64_t b,
                           typename L::Bool running, Ends<L>& ends, const std::byte* actions,
                           const StepBuffers& made, const StepBuffers& memory) {
    using Bool = typename L::Bool;
    using Int = typename L::Int;
    Episodes<L>& episodes = blocks.episodes[b];
    const std::byte* const states =
        blocks.states + static_cast<std::size_t>(b) * engine.state_size();
    Context<L> context = episodes.context_of_step(running);
    const typename L::Real reward =
        engine.step(states, actions, made.scratch, made.next, made.observation, context);
    const Bool terminal = engine.terminal(made.next, context);
    const Bool violation = engine.violated_invariant(made.next, context) >= Int{0};
    if (any(context.faulted())) {
        episodes.end_by_faults(context);
        ends = episodes.ends;
    }
    const Bool moved = running && !context.faulted();
    const Bool whole_block = moved || !episodes.is_present();  // whatever there is in absent lanes
    take_over(engine, blocks, b, whole_block, made, memory);
    episodes.has_fault = episodes.has_fault && !moved;
    episodes.steps = select(moved, wrap_add(episodes.steps, Int{1}), episodes.steps);
    ends.terminated = select(moved, terminal, ends.terminated);
    ends.violated = select(moved, violation, ends.violated);
    if (blocks.horizon > 0)
        ends.beyond_horizon =
            select(moved, episodes.steps >= Int{blocks.horizon}, ends.beyond_horizon);
    episodes.ends = ends;
    return select(moved, reward, typename L::Real{0});
}

// Tells which episodes of block `b` are over.
template <class L>
RDDL_ALWAYS_INLINE void write_ends(const Blocks<L>& blocks, std::int64_t b, const Ends<L>& ends,
                                   const rddl_transition& out) {
    const std::int64_t first = b * L::width;
    const int lanes = blocks.lanes_of(b);
    if (out.terminated != nullptr) write_flags(ends.terminated, out.terminated + first, lanes);
    if (out.truncated != nullptr) write_flags(ends.truncated(), out.truncated + first, lanes);
    for (int lane = 0; out.causes != nullptr && lane < lanes; ++lane)
        out.causes[first + lane] = ends.causes(lane);
}

// The outcome of a step: rewards, and which episodes are over. It gives the lanes of the latter.
template <class L>
RDDL_ALWAYS_INLINE typename L::Bool write_outcome(const Blocks<L>& blocks, std::int64_t b,
                                                  typename L::Real reward, const Ends<L>& ends,
                                                  const rddl_transition& out) {
    if (out.rewards != nullptr) write_reals(reward, out.rewards + b * L::width, blocks.lanes_of(b));
    write_ends(blocks, b, ends, out);
    return blocks.episodes[b].is_present() && ends.any();
}
template <class L>
[[gnu::noinline]] typename L::Bool write_outcome_of_no_step(const Blocks<L>& blocks, std::int64_t b,
                                                            const rddl_transition& out) {
    return write_outcome(blocks, b, typename L::Real{0}, blocks.episodes[b].ends, out);
}

// A step of block `b` where episodes run; the lanes whose episodes are over then. `memory` is room
// to work in. Observations are not written.
template <Engine E, class L = typename E::Lane>
typename L::Bool advance(const E& engine, const Blocks<L>& blocks, const StepBuffers& memory,
                         std::int64_t b, const std::byte* actions, const rddl_transition& out) {
    Ends<L> ends = blocks.episodes[b].ends;
    const typename L::Bool running = blocks.episodes[b].is_present() && !ends.any();
    if (!any(running)) return write_outcome_of_no_step(blocks, b, out);
    const typename L::Real reward = with_step_buffers<E>(memory, [&](const StepBuffers& made) {
        return make_step(engine, blocks, b, running, ends, actions, made, memory);
    });
    return write_outcome(blocks, b, reward, ends, out);
}

}  // namespace rddl
