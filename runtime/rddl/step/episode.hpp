// The episodes of a block of environments: how they start, continue and end. An episode ends when a
// termination condition holds in the new state, when a state invariant is violated there, at the
// horizon, or by a fault.
#pragma once

#include <rddl/random/random.hpp>
#include <rddl/simulator.h>
#include <rddl/step/columns.hpp>
#include <rddl/step/engine.hpp>
#include <rddl/step/step_counts.hpp>
#include <rddl/values/context.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl {

// The causes of the ends of a block's episodes; false for running ones.
template <class L>
struct Ends {
    using Bool = typename L::Bool;
    Bool terminated{false}, beyond_horizon{false}, violated{false}, faulted{false};

    // All causes are combined, since that needs no jumps.
    Bool truncated() const { return Bool(beyond_horizon | violated | faulted); }
    Bool any() const { return Bool(terminated | truncated()); }

    std::uint8_t causes(int lane) const {
        return static_cast<std::uint8_t>(
            (get_lane(terminated, lane) ? RDDL_TERMINATED : 0) |
            (get_lane(beyond_horizon, lane) ? RDDL_TRUNCATED_HORIZON : 0) |
            (get_lane(violated, lane) ? RDDL_TRUNCATED_INVARIANT : 0) |
            (get_lane(faulted, lane) ? RDDL_FAULTED : 0));
    }

    Ends<Scalar> of(int lane) const {
        return {get_lane(terminated, lane), get_lane(beyond_horizon, lane),
                get_lane(violated, lane), get_lane(faulted, lane)};
    }
    void set(int lane, const Ends<Scalar>& ends) {
        set_lane(terminated, lane, ends.terminated);
        set_lane(beyond_horizon, lane, ends.beyond_horizon);
        set_lane(violated, lane, ends.violated);
        set_lane(faulted, lane, ends.faulted);
    }
};

// Begins at a cache line of its own, so that threads do not write to each other's.
template <class L>
struct alignas(64) Episodes {
    using Bool = typename L::Bool;
    using Int = typename L::Count;
    using Word = typename L::Word;

    // Each step looks at these, in one cache line.
    Ends<L> ends;
    Bool present{true};      // false: no environment in this lane, for ever
    Bool has_fault{false};   // see `faults`
    std::int64_t state = 0;  // which of the two records of the block it is: 0 or 1
    StepCounts<L> steps;     // made in this episode
    const std::byte* last_action = nullptr;  // the row of its last step, of one environment

    Int number{std::int64_t{-1}};  // episodes ended before this one
    Word key_low{std::uint64_t{0}}, key_high{std::uint64_t{0}};
    // The fault of this episode, or of the last one until this one makes a step.
    std::array<FaultRecord, static_cast<std::size_t>(L::width)> faults;
    std::array<std::int64_t, static_cast<std::size_t>(L::width)> fault_steps;  // made before

    Bool is_present() const {
        if constexpr (L::width == 1) return true;
        return present;
    }
    Bool over() const { return is_present() && ends.any(); }
    Bool running() const {
        // All at once, since that is one load.
        if constexpr (L::width == 1) return std::bit_cast<std::uint32_t>(ends) == 0;
        return is_present() && !ends.any();
    }
    // Whether all lanes run and, of packs, none has a fault to forget.
    bool all_run() const {
        if constexpr (L::width == 1) return running();
        return all(present) && !any(has_fault) && !has_ends();
    }

    // Whether some episode of the block has ended in every fourth step, judged by those of a lane.
    bool are_short() const { return get_lane(number, 0) > steps.of_block() / (4 * L::width); }

    // The draws of the step that leaves timestep t are counted as t + 1, those at reset as 0.
    Context<L> context_of_step(Bool active) const {
        return Context<L>::of(key_low, key_high, next_step(), active);
    }
    Context<L> context_of_state(Bool active) const {
        return Context<L>::of(key_low, key_high, words_of(steps.all()), active);
    }

    // These lanes run, unless their state is terminal or faulted.
    void begin(Bool lanes, Bool terminal, const Context<L>& context) {
        ends.terminated = select(lanes, terminal, ends.terminated);
        ends.beyond_horizon = ends.beyond_horizon && !lanes;
        ends.violated = ends.violated && !lanes;
        ends.faulted = ends.faulted && !lanes;
        if (any(context.faulted())) end_by_faults(context);
    }

    void end_by_faults(const Context<L>& context) {
        for_each_lane(context.faulted(), [&](int lane) {
            const auto place = static_cast<std::size_t>(lane);
            faults[place] = context.fault_of(lane);
            fault_steps[place] = steps.of(lane);
            set_lane(has_fault, lane, true);
            set_lane(ends.terminated, lane, false);
            set_lane(ends.beyond_horizon, lane, false);
            set_lane(ends.violated, lane, false);
            set_lane(ends.faulted, lane, true);
        });
    }

    // The episode of one environment, without its records.
    Episodes<Scalar> of(int lane) const {
        const auto place = static_cast<std::size_t>(lane);
        Episodes<Scalar> one;
        one.number = get_lane(number, lane);
        one.steps.set(0, steps.of(lane));
        one.key_low = get_lane(key_low, lane);
        one.key_high = get_lane(key_high, lane);
        one.ends = ends.of(lane);
        one.has_fault = get_lane(has_fault, lane);
        one.faults[0] = faults[place];
        one.fault_steps[0] = fault_steps[place];
        return one;
    }
    void set(int lane, const Episodes<Scalar>& one) {
        const auto place = static_cast<std::size_t>(lane);
        set_lane(number, lane, one.number);
        steps.set(lane, one.steps.of(0));
        set_lane(key_low, lane, one.key_low);
        set_lane(key_high, lane, one.key_high);
        ends.set(lane, one.ends);
        set_lane(has_fault, lane, one.has_fault);
        faults[place] = one.faults[0];
        fault_steps[place] = one.fault_steps[0];
    }

  private:
    bool has_ends() const {
        // All at once, where they fit into a word.
        if constexpr (sizeof ends == sizeof(std::uint64_t))
            return std::bit_cast<std::uint64_t>(ends) != 0;
        return any(ends.any());
    }
    Word next_step() const { return words_of(steps.all()) + Word{std::uint64_t{1}}; }
};

// The source of an environment's random numbers, with the number of its episode.
struct Stream {
    std::uint64_t seed;
    std::uint64_t identity;

    // Nothing is random (median_key). No environment has this identity, since none is negative.
    static constexpr Stream of_medians() { return {0, ~std::uint64_t{0}}; }

    friend bool operator==(const Stream&, const Stream&) = default;
};

// The environments of a batch, in blocks.
template <class L>
struct Blocks {
    std::int64_t environment_count;
    std::int64_t horizon;  // the greatest int: no horizon
    rddl_autoreset autoreset;
    bool start_running;     // no episode is over when it starts
    const Stream* streams;  // of each environment; null: nothing is drawn
    Episodes<L>* episodes;
    std::byte* states;         // two records for each block: its state, and room for the next one
    std::byte* observations;   // null when fully observed
    const std::byte* actions;  // those of whole blocks that are read when they are checked
    const Columns* state_columns;
    const Columns* action_columns;
    const Columns* observation_columns;
    std::uintptr_t action_alignment_bits;  // 0 in the addresses of aligned action records

    // Whether action records of single environments are blocks as they stand.
    bool are_blocks(const std::byte* rows) const {
        return rows != nullptr &&
               (reinterpret_cast<std::uintptr_t>(rows) & action_alignment_bits) == 0;
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
template <StateEngine E, class L = typename E::Lane>
void end_if_terminal(const E& engine, Episodes<L>& episodes, typename L::Bool lanes,
                     const std::byte* states) {
    episodes.steps.look_again();
    Context<L> context = episodes.context_of_state(lanes);
    const typename L::Bool terminal = engine.terminal(states, context);
    episodes.begin(lanes, terminal, context);
}

// The states of a block, and room for as many.
struct StateRecords {
    std::byte* states;
    std::byte* room;
};

// These lanes' states become initial ones; where they are terminal.
template <Engine E, class L = typename E::Lane>
typename L::Bool reset_some(const E& engine, const Columns& columns, typename L::Bool lanes,
                            const StateRecords& records, Context<L>& context) {
    engine.reset(records.room, context);
    merge(L{}, columns, lanes, records.room, records.states);
    return engine.terminal(records.room, context);
}
// Small states are made and merged in registers.
template <SmallStateEngine E, class L = typename E::Lane>
typename L::Bool reset_some(const E& engine, const Columns&, typename L::Bool lanes,
                            const StateRecords& records, Context<L>& context) {
    typename E::State initial;
    auto* const made = reinterpret_cast<std::byte*>(&initial);
    engine.reset(made, context);
    merge(L{}, E::state_columns, lanes, made, records.states);
    return engine.terminal(made, context);
}

// So many lanes get their keys together.
inline constexpr int keys_at_once = 8;

// Sets the keys of the episodes of the lanes from keys_at_once * `part` on, which are all present.
template <class L>
void set_some_keys(const Blocks<L>& blocks, std::int64_t b, std::size_t part) {
    constexpr std::int64_t n = L::width;
    using Word = Lanes<std::uint64_t, keys_at_once>;
    Episodes<L>& episodes = blocks.episodes[b];
    const auto* const streams = reinterpret_cast<const std::byte*>(
        blocks.streams + b * n + static_cast<std::int64_t>(part) * keys_at_once);
    const auto seed = Word::load_apart(streams + offsetof(Stream, seed), sizeof(Stream));
    const auto identity = Word::load_apart(streams + offsetof(Stream, identity), sizeof(Stream));
    const auto keys = stream_keys(seed, identity, part_of<Word>(words_of(episodes.number), part));
    constexpr Stream medians = Stream::of_medians();
    const auto are_medians = ints_of(seed) == ints_of(Word{medians.seed}) &&
                             ints_of(identity) == ints_of(Word{medians.identity});
    set_part(episodes.key_low, part,
             select(are_medians, Word{std::uint64_t{median_key.low}}, keys.low));
    set_part(episodes.key_high, part,
             select(are_medians, Word{std::uint64_t{median_key.high}}, keys.high));
}

// Sets the keys of the episodes of these lanes of block `b`, which are present. Where episodes have
// the same horizon, most of them start together.
template <class L>
void set_keys(const Blocks<L>& blocks, std::int64_t b, typename L::Bool lanes) {
    Episodes<L>& episodes = blocks.episodes[b];
    if constexpr (L::width > 1) {
        for (int first = 0; first < L::width; first += keys_at_once) {
            const std::uint64_t some = ((std::uint64_t{1} << keys_at_once) - 1) << first;
            if ((lanes.bits & some) != some) continue;
            set_some_keys(blocks, b, static_cast<std::size_t>(first / keys_at_once));
            lanes = L::Bool::of_bits(lanes.bits & ~some);
        }
    }
    for_each_lane(lanes, [&](int lane) {
        const auto number = static_cast<std::uint64_t>(get_lane(episodes.number, lane));
        const Stream& stream = blocks.streams[b * L::width + lane];
        const StreamKey key = stream == Stream::of_medians()
                                  ? median_key
                                  : stream_key(stream.seed, stream.identity, number);
        set_lane(episodes.key_low, lane, std::uint64_t{key.low});
        set_lane(episodes.key_high, lane, std::uint64_t{key.high});
    });
}

// Starts the next episodes of these lanes of block `b`, in the initial state. `room` is a block of
// states to work in. The fault that ended an episode can be read until the next one makes a step.
template <StateEngine E, class L = typename E::Lane>
void start_next(const E& engine, const Blocks<L>& blocks, std::int64_t b, typename L::Bool lanes,
                std::byte* room) {
    using Int = typename L::Count;
    Episodes<L>& episodes = blocks.episodes[b];
    episodes.number = select(lanes, wrap_add(episodes.number, Int{1}), episodes.number);
    episodes.steps.begin(lanes);
    if (blocks.streams != nullptr) set_keys(blocks, b, lanes);
    Context<L> context = episodes.context_of_state(lanes);
    const StateRecords records{blocks.state_of(b, engine.state_size()), room};
    settle(engine, records.states);
    const typename L::Bool terminal =
        reset_some(engine, *blocks.state_columns, lanes, records, context);
    episodes.begin(lanes, terminal, context);
}

}  // namespace rddl
