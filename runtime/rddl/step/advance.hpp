// Steps of blocks of environments.
//
// All of a step is compiled with the simulator, from the caller's actions to the rewards: most
// values then never leave registers. Rare work is left to the batch, or stands apart.
#pragma once

#include <rddl/simulator.h>
#include <rddl/step/columns.hpp>
#include <rddl/step/engine.hpp>
#include <rddl/step/episode.hpp>
#include <rddl/step/range.hpp>
#include <rddl/values/context.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace rddl {

// The actions of a step: records of the C interface, one for each environment of the batch, or one
// block of them.
struct Actions {
    const std::byte* rows;
    const std::byte* block;  // null: the rows
};

// The place where stepping stopped, since the next episodes are to start.
template <class L>
struct Stop {
    std::int64_t block;
    typename L::Bool over;  // its episodes that are over after a step; empty: it has made no step
};

namespace detail {

template <Engine E, class L>
constexpr const auto& action_columns(const Blocks<L>& blocks) {
    if constexpr (TypedEngine<E>)
        return E::action_columns;
    else
        return *blocks.action_columns;
}

template <Engine E>
inline constexpr bool takes_bools_as_given = [] {
    if constexpr (requires { E::tests_action_bools; }) return E::tests_action_bools;
    return false;
}();

// Whether whole blocks of actions have been read when they were checked.
template <Engine E>
inline constexpr bool reads_checked_actions = [] {
    if constexpr (TypedEngine<E>) return are_read_when_checked<typename E::Lane>(E::action_columns);
    return false;
}();

// Whether the caller goes through an array of actions, so that later ones lie behind this row.
template <class L>
RDDL_INLINE bool goes_on(const std::byte* row, Episodes<L>& episodes) {
    const bool is_behind = row > episodes.last_action;
    episodes.last_action = row;
    return is_behind;
}

// Asks for what a later step, or one of a later environment, reads of its row. Of rows with many
// bools it reads few bytes, but mostly all small tables; shorter rows than half a line of the cache
// come in time without.
template <Engine E, class L>
RDDL_INLINE void prefetch_later_row(const Blocks<L>& blocks, std::int64_t b, const std::byte* row) {
    constexpr const auto& columns = E::action_columns;
    constexpr std::int64_t ahead = 4, most_elements = 64, least_size = 32;
    if constexpr (columns.row_size < least_size) return;
    if constexpr (takes_bools_as_given<E>) {
        if (b + ahead >= blocks.environment_count && !goes_on(row, blocks.episodes[b])) return;
        for_each_column(columns, [&](const Column& column) RDDL_INLINE_LAMBDA {
            if (column.count <= most_elements)
                __builtin_prefetch(row + ahead * columns.row_size + column.row);
        });
    } else if (goes_on(row, blocks.episodes[b])) {
        prefetch_rows(row, columns.row_size);
    }
}

// `room` is for a block that is not a row.
template <Engine E, class L>
RDDL_ALWAYS_INLINE const std::byte* action_of_block(const E& engine, const Blocks<L>& blocks,
                                                    std::int64_t b, const Actions& actions,
                                                    std::byte* room) {
    const auto& columns = action_columns<E>(blocks);
    const std::int64_t first = b * L::width * columns.row_size;
    if constexpr (L::width == 1) {
        if (actions.block) return actions.block;
        if constexpr (TypedEngine<E>) prefetch_later_row<E>(blocks, b, actions.rows + first);
        const bool is_block = std::is_same_v<L, Scalar> || !columns.has_reals;
        if (is_block && (takes_bools_as_given<E> || has_plain_bools(columns, actions.rows + first)))
            return actions.rows + first;
    }
    if (actions.block) {
        copy_action(engine, actions.block, room);
    } else if constexpr (reads_checked_actions<E>) {
        return blocks.actions + static_cast<std::size_t>(b) * engine.action_size();
    } else {
        if constexpr (L::width > 1)
            prefetch_rows(actions.rows + first, L::width * columns.row_size);
        read_records(L{}, columns, actions.rows + first, L::width, room);
    }
    return room;
}

// The state of a block, and where the next one is made if it stays there.
template <Engine E, class L>
RDDL_ALWAYS_INLINE std::byte* state_of(const E& engine, const Blocks<L>& blocks, std::int64_t b) {
    if constexpr (makes_states_in_place<E>()) return blocks.state_of(b, engine.state_size());
    return blocks.states + static_cast<std::size_t>(2 * b) * engine.state_size();
}
template <Engine E, class L>
RDDL_ALWAYS_INLINE std::byte* next_state_of(const E& engine, const Blocks<L>& blocks,
                                            std::int64_t b, std::byte* elsewhere) {
    if constexpr (makes_states_in_place<E>()) return blocks.next_state_of(b, engine.state_size());
    return elsewhere;
}

// Takes over the results of a step in the lanes of the mask; the other lanes stay as they are.
template <Engine E, class L>
[[gnu::noinline]] void take_over_some(const E& engine, const Blocks<L>& blocks, std::int64_t b,
                                      typename L::Bool mask, const StepBuffers& made) {
    const auto place = static_cast<std::size_t>(b);
    settle(engine, made.next);
    merge(L{}, *blocks.state_columns, mask, made.next, state_of(engine, blocks, b));
    if (blocks.observations != nullptr)
        merge(L{}, *blocks.observation_columns, mask, made.observation,
              blocks.observations + place * engine.observation_size());
}

// States and observations become those that a step made, where the mask holds. `memory` is room to
// work in.
template <Engine E, class L>
RDDL_ALWAYS_INLINE void take_over(const E& engine, const Blocks<L>& blocks, std::int64_t b,
                                  typename L::Bool mask, const StepBuffers& made,
                                  const StepBuffers& memory) {
    const auto place = static_cast<std::size_t>(b);
    const bool observed = blocks.observations != nullptr;
    if (all(mask)) {
        if constexpr (makes_states_in_place<E>())
            blocks.episodes[b].state ^= 1;
        else
            copy_state(engine, made.next, state_of(engine, blocks, b));
        if (observed)
            copy_observation(engine, made.observation,
                             blocks.observations + place * engine.observation_size());
    } else if (any(mask)) {
        StepBuffers in_memory = memory;
        if constexpr (makes_states_in_place<E>())
            in_memory.next = made.next;
        else if (made.next != memory.next)
            copy_state(engine, made.next, memory.next);
        if (observed && made.observation != memory.observation)
            copy_observation(engine, made.observation, memory.observation);
        const Blocks<L> copy = blocks;  // so that a caller's may stay in registers
        take_over_some(engine, copy, b, mask, in_memory);
    }
}

// Whether the next episodes of packs start with nothing but their states, and these are small: then
// their blocks need not stop for that.
template <Engine E>
inline constexpr bool starts_states_only =
    SmallStateEngine<E> && !PolicyEngine<E> && E::Lane::width > 1;

// Whether these are a few constants besides, which registers can take over under a mask. Where a
// real takes two registers, that takes longer than a jump.
template <Engine E>
inline constexpr bool starts_with_constants = [] {
    if constexpr (starts_states_only<E>)
        return !E::has_large_states && !E::draws && E::Lane::Real::part_count == 1;
    return false;
}();

// The next episodes of these lanes start while the step's states are in registers, without jumps,
// which processors can hardly foretell where episodes are short.
template <Engine E, class L = typename E::Lane>
RDDL_ALWAYS_INLINE void start_at_once(const E& engine, Episodes<L>& episodes, typename L::Bool over,
                                      std::byte* next) {
    using Int = typename L::Count;
    typename E::State initial;
    auto* const made = reinterpret_cast<std::byte*>(&initial);
    Context<L> context = episodes.context_of_state(over);
    engine.reset(made, context);
    select_values(L{}, E::state_columns, over, made, next);
    episodes.steps.begin(over);
    episodes.number = select(over, wrap_add(episodes.number, Int{1}), episodes.number);
}

// One step of the running episodes of block `b`, with the causes of their ends and the episodes
// that are left over; returns the rewards, 0 for lanes without a step. States and, if partially
// observed, observations change unless the step faults. Preconditions are not checked. With
// `at_once` the next episodes start already, where all lanes run and they start with constants.
template <Engine E, class L>
RDDL_ALWAYS_INLINE typename L::Real make_step(const E& engine, const Blocks<L>& blocks,
                                              std::int64_t b, typename L::Bool running,
                                              Ends<L>& ends, typename L::Bool& over, bool all_run,
                                              bool at_once, const Actions& actions,
                                              StepBuffers made, const StepBuffers& memory) {
    using Bool = typename L::Bool;
    Episodes<L>& episodes = blocks.episodes[b];
    std::byte* const states = state_of(engine, blocks, b);
    if (!all_run) settle(engine, states);
    made.next = next_state_of(engine, blocks, b, made.next);
    const std::byte* const action = action_of_block(engine, blocks, b, actions, made.action);
    Context<L> context = episodes.context_of_step(running);
    const typename L::Real reward =
        engine.step(states, action, made.scratch, made.next, made.observation, context);
    const Bool terminal = engine.terminal(made.next, context);
    const Bool violation = engine.violates_invariant(made.next, context);
    if (all_run && !any(context.faulted())) {
        ends = {terminal, episodes.steps.count_all(blocks.horizon), violation, false};
        over = ends.any();
        if constexpr (starts_with_constants<E>) {
            if (at_once) {
                start_at_once(engine, episodes, over, made.next);
                over = Bool{false};
            }
        }
        if (any(over)) episodes.ends = ends;  // they ran, so they had no ends
        if constexpr (L::width == 1) episodes.has_fault = false;
        take_over(engine, blocks, b, Bool{true}, made, memory);
        return reward;
    }
    if (any(context.faulted())) episodes.end_by_faults(context);
    if constexpr (L::width == 1) {  // it has faulted
        ends = episodes.ends;
        over = ends.any();
        return 0;
    } else {
        const Bool moved = running && !context.faulted();
        episodes.has_fault = episodes.has_fault && !moved;
        // Whatever there is in absent lanes.
        const Bool whole_block = moved || !episodes.is_present();
        take_over(engine, blocks, b, whole_block, made, memory);
        const Bool late = episodes.steps.count(moved, blocks.horizon);
        ends = episodes.ends;
        ends.terminated = select(moved, terminal, ends.terminated);
        ends.violated = select(moved, violation, ends.violated);
        ends.beyond_horizon = select(moved, late, ends.beyond_horizon);
        episodes.ends = ends;
        over = ends.any();
        return select(moved, reward, typename L::Real{0});
    }
}

}  // namespace detail

// Whether the caller wants to know how episodes ended that the step has reset.
inline bool wants_finals(const rddl_transition& out) {
    return out.final_observations != nullptr || out.final_states != nullptr ||
           out.final_observation_values != nullptr;
}

// Writes which episodes of the environments from `first` on are over, of so many lanes.
template <class L>
RDDL_ALWAYS_INLINE void write_ends(std::int64_t first, int lanes, const Ends<L>& ends,
                                   const rddl_transition& out) {
    if (out.terminated != nullptr) write_flags(ends.terminated, out.terminated + first, lanes);
    if (out.truncated != nullptr) write_flags(ends.truncated(), out.truncated + first, lanes);
    if (out.causes == nullptr) return;
    if (L::width > 1 && !any(ends.any()))
        std::memset(out.causes + first, RDDL_RUNNING, static_cast<std::size_t>(lanes));
    else
        for (int lane = 0; lane < lanes; ++lane) out.causes[first + lane] = ends.causes(lane);
}

// The same with rewards.
template <class L>
RDDL_ALWAYS_INLINE void write_results(std::int64_t first, int lanes, const typename L::Real& reward,
                                      const Ends<L>& ends, const rddl_transition& out) {
    if (out.rewards != nullptr) write_reals(reward, out.rewards + first, lanes);
    write_ends(first, lanes, ends, out);
}

// Whether the caller wants the usual results, of whole blocks.
template <class L>
bool wants_common_results(int lanes, const rddl_transition& out) {
    return lanes == L::width && out.rewards != nullptr && out.terminated != nullptr &&
           out.truncated != nullptr && out.causes == nullptr;
}
template <class L>
RDDL_ALWAYS_INLINE void write_common_results(std::int64_t first, const typename L::Real& reward,
                                             const Ends<L>& ends, const rddl_transition& out) {
    write_reals(reward, out.rewards + first, L::width);
    write_flags(ends.terminated, out.terminated + first, L::width);
    write_flags(ends.truncated(), out.truncated + first, L::width);
}

// A step of the running episodes of the blocks from range.begin on, whose rewards and ends are
// written; observations are not. With automatic resets it stops at the first block whose episodes
// are to start again; else at range.end. `memory` is room to work in. Rows of less than a whole
// block are not read: such a block comes with a block of actions.
template <Engine E, class L = typename E::Lane>
RDDL_ALWAYS_INLINE Stop<L> advance(const E& engine, const Blocks<L>& all_blocks, Range range,
                                   Actions actions, const StepBuffers& memory,
                                   const rddl_transition& all_out) {
    using Bool = typename L::Bool;
    // No store of the loop can change a copy, so its parts need not be loaded again.
    constexpr bool loops = L::width > 1;
    const std::conditional_t<loops, Blocks<L>, const Blocks<L>&> blocks = all_blocks;
    const std::conditional_t<loops, rddl_transition, const rddl_transition&> out = all_out;
    const int lanes = blocks.lanes_of(range.end - 1);
    const bool are_common = loops && wants_common_results<L>(lanes, out);
    const bool starts_here = detail::starts_states_only<E> &&
                             blocks.autoreset == RDDL_AUTORESET_SAME_STEP && !wants_finals(out) &&
                             blocks.observations == nullptr;
    const bool at_once = [&] {
        if constexpr (detail::starts_with_constants<E>)
            return starts_here && blocks.start_running && range.begin < range.end &&
                   blocks.episodes[range.begin].are_short();
        return false;
    }();
    for (std::int64_t b = range.begin; b < range.end; ++b) {
        const Episodes<L>& episodes = blocks.episodes[b];
        const bool all_run = episodes.all_run();
        const Bool running = all_run || L::width == 1 ? Bool{all_run} : episodes.running();
        if (!all_run && any(episodes.is_present() && !running) &&
            blocks.autoreset == RDDL_AUTORESET_NEXT_STEP)
            return {b, false};
        typename L::Real reward{0};
        Ends<L> ends;
        Bool over;
        if (any(running)) {
            reward = with_step_buffers<E>(memory, [&](const StepBuffers& made) RDDL_INLINE_LAMBDA {
                return detail::make_step(engine, blocks, b, running, ends, over, all_run, at_once,
                                         actions, made, memory);
            });
        } else {
            ends = episodes.ends;
            over = ends.any();
        }
        if (are_common)
            write_common_results(b * L::width, reward, ends, out);
        else
            write_results(b * L::width, lanes, reward, ends, out);
        if (!any(over)) continue;
        over = episodes.is_present() && over;
        if (!any(over) || blocks.autoreset != RDDL_AUTORESET_SAME_STEP) continue;
        if (!starts_here) return {b, over};
        if constexpr (detail::starts_states_only<E>)
            start_next(engine, all_blocks, b, over, memory.next);
    }
    return {range.end, false};
}

// Whether it advances many blocks in one call.
template <Engine E>
constexpr bool advances_many(const E&) {
    return true;
}

// ----------------------------------------------------------------- blocks of one environment

// The remaining work of a step.
enum class Rest : std::uint8_t {
    NextEpisode,   // its episode is over, and the next one starts
    Start,         // its episode was over, so that the next one starts instead of a step
    Observations,  // they are wanted
};

// The parts of a batch that a thread's steps need: its blocks, buffers, and a function for the
// rest.
template <class L>
struct BatchView {
    Blocks<L> blocks;
    StepBuffers buffers;
    int thread;
    void* batch;
    rddl_error (*do_rest)(const BatchView& view, std::int64_t b, Rest rest, Actions actions,
                          const rddl_transition& out);
};

// A step of block `b`: always RDDL_OK, so that the calls down to here end with each other and have
// no registers to save.
template <Engine E, class L = typename E::Lane>
RDDL_ALWAYS_INLINE rddl_error advance_one(const E& engine, const BatchView<L>& view, std::int64_t b,
                                          Actions actions, const rddl_transition& out) {
    const Stop<L> stop = advance(engine, view.blocks, {b, b + 1}, actions, view.buffers, out);
    if (stop.over) return view.do_rest(view, b, Rest::NextEpisode, actions, out);
    if (stop.block == b) return view.do_rest(view, b, Rest::Start, actions, out);
    if (out.observations) return view.do_rest(view, b, Rest::Observations, actions, out);
    return RDDL_OK;
}

}  // namespace rddl
