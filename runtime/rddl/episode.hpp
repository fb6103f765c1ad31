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

    // All are looked at, since that needs no jumps.
    Bool truncated() const { return Bool(beyond_horizon | violated | faulted); }
    Bool any() const { return Bool(terminated | truncated()); }

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
    std::int64_t state = 0;  // which of the two records of the block it is: 0 or 1
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
    std::int64_t horizon;  // the greatest int: none
    rddl_autoreset autoreset;
    Episodes<L>* episodes;
    std::byte* states;        // two records for each block: its state, and room for the next one
    std::byte* observations;  // null when fully observed
    const Columns* state_columns;
    const Columns* action_columns;
    const Columns* observation_columns;

    // Whether action records of single environments are blocks as they stand.
    bool are_blocks(const std::byte* rows) const {
        const auto address = reinterpret_cast<std::uintptr_t>(rows);
        return rows != nullptr &&
               (address & static_cast<std::uintptr_t>(action_columns->alignment - 1)) == 0;
    }

    // `state_size` is that of a block.
    std::byte* state_of(std::int64_t b, std::size_t state_size) const {
        return states + static_cast<std::size_t>(2 * b + episodes[b].state) * state_size;
    }
    std::byte* next_state_of(std::int64_t b, std::size_t state_size) const {
        return states + static_cast<std::size_t>(2 * b + 1 - episodes[b].state) * state_size;
    }

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

// What the random stream of each episode of a batch is made of.
struct Streams {
    std::uint64_t seed;
    bool drawn_from;  // false: nothing is drawn, so there need be none
};

// Starts the next episodes of these lanes, in the initial state. `identity` is that of lane 0;
// `room` is a block of states to work in.
template <StartingEngine E, class L = typename E::Lane>
void start_next(const E& engine, const Columns& columns, Episodes<L>& episodes,
                typename L::Bool lanes, const Streams& streams, std::uint64_t identity,
                std::byte* room, std::byte* states) {
    for_each_lane(lanes, [&](int lane) {
        const std::int64_t number = get_lane(episodes.number, lane) + 1;
        set_lane(episodes.number, lane, number);
        set_lane(episodes.steps, lane, std::int64_t{0});
        set_lane(episodes.has_fault, lane, false);
        if (!streams.drawn_from) return;
        const StreamKey key = stream_key(streams.seed, identity + static_cast<std::uint64_t>(lane),
                                         static_cast<std::uint64_t>(number));
        set_lane(episodes.key_low, lane, std::uint64_t{key.low});
        set_lane(episodes.key_high, lane, std::uint64_t{key.high});
    });
    Context<L> context = episodes.context_of_state(lanes);
    engine.reset(room, context);
    merge(L{}, columns, lanes, room, states);
    end_if_terminal(engine, episodes, lanes && !context.faulted(), states);
    if (any(context.faulted())) episodes.end_by_faults(context);
}

}  // namespace rddl
