// The interface of a simulator for a batch, compiled or interpreted.
//
// An engine works on blocks of Lane::width environments; that of the interpreter is one. A record
// of a block holds each value as the lane type's Bool, Int or Real.
//
// An engine is immutable and shared by threads: all its functions are const and work on records
// that the caller owns. Those of one environment are laid out as simulator.h says. Pointers are
// never null and are aligned for any element, even if a record is empty.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/real.hpp>
#include <rddl/step/columns.hpp>
#include <rddl/values/context.hpp>

#include <concepts>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace rddl {

// The sizes of records, and the conditions on states.
template <class E>
concept StateEngine = requires(const E engine, const std::byte* record, std::byte* target,
                               Context<typename E::Lane>& context) {
    // Bytes of one record; 0 for an empty one. Scratch is whatever a step needs beside them.
    { engine.state_size() } -> std::convertible_to<std::size_t>;
    { engine.action_size() } -> std::convertible_to<std::size_t>;
    { engine.observation_size() } -> std::convertible_to<std::size_t>;
    { engine.scratch_size() } -> std::convertible_to<std::size_t>;

    // Whether a termination condition holds.
    { engine.terminal(record, context) } -> std::convertible_to<typename E::Lane::Bool>;
    // The first violated condition, or -1. One that faults counts as violated.
    {
        engine.violated_precondition(record, record, context)
        } -> std::convertible_to<typename E::Lane::Int>;
};

template <class E>
concept Engine = StateEngine<E> && requires(const E engine, const std::byte* record,
                                            std::byte* target, Context<typename E::Lane>& context) {
    // reset(state, context): the initial values.
    {engine.reset(target, context)};
    // step(state, action, scratch, next, observation, context): fills the next state, and the
    // observation of a partially observed problem; the reward.
    {
        engine.step(record, record, target, target, target, context)
        } -> std::convertible_to<typename E::Lane::Real>;
    // Whether an invariant does not hold, or faults.
    { engine.violates_invariant(record, context) } -> std::convertible_to<typename E::Lane::Bool>;
};

// An engine that may have a policy. Memory is what the policy remembers within an episode.
template <class E>
concept PolicyEngine = StateEngine<E> &&
    requires(const E engine, const std::byte* record, std::byte* target,
             Context<typename E::Lane>& context) {
    // The functions below may be called where this is true.
    { engine.has_policy() } -> std::convertible_to<bool>;
    { engine.memory_size() } -> std::convertible_to<std::size_t>;

    // reset_policy(memory): the memory before the first decision.
    {engine.reset_policy(target)};
    // act(observation, memory, scratch, action, next_memory, context): fills the action and the
    // next memory. In a fully observed problem the state is what is observed.
    {engine.act(record, record, target, target, target, context)};
};

// One whose reset draws: the state of before.
template <class E>
concept RandomStart = requires(const E engine, std::byte* target) {
    {engine.initial_state(target)};
};

// The state in which episodes start, as it is before anything is drawn.
template <Engine E>
void initial_state(const E& engine, std::byte* state) {
    if constexpr (RandomStart<E>) {
        engine.initial_state(state);
    } else {
        Context<typename E::Lane> unused =
            Context<typename E::Lane>::of({}, {}, {}, typename E::Lane::Bool{true});
        engine.reset(state, unused);
    }
}

// Tables of a state may lie in sliding buffers behind its other values
// (rddl/values/sliding_tables.hpp). They come back to where the columns have them, before others
// than the engine read or write them.
template <StateEngine E>
RDDL_INLINE void settle(const E& engine, std::byte* state) {
    if constexpr (requires { engine.settle(state); }) engine.settle(state);
}
// Bytes of sliding buffers in a record.
template <StateEngine E>
constexpr std::size_t sliding_buffers_size(const E& engine) {
    if constexpr (requires { engine.sliding_buffers_size(); }) return engine.sliding_buffers_size();
    return 0;
}

// The actions of a step, and where it leaves its results until it is known not to have faulted.
struct StepBuffers {
    std::byte* action;
    std::byte* scratch;
    std::byte* next;
    std::byte* observation;
};

// An engine that is compiled with its records.
template <class E>
concept TypedEngine = Engine<E> && requires {
    typename E::State;
    typename E::Action;
    typename E::Scratch;
    typename E::Observation;
    E::state_columns;
    E::action_columns;
    { E::has_state_tables } -> std::convertible_to<bool>;
    { E::has_large_states } -> std::convertible_to<bool>;
    { E::shows_padding } -> std::convertible_to<bool>;
};

// One whose state has no tables, so that it can be made and merged in registers.
template <class E>
concept SmallStateEngine = TypedEngine<E> && !E::has_state_tables && !E::shows_padding;

// Whether a step makes the next state where it is going to stay, instead of in registers, from
// where it is copied.
template <Engine E>
constexpr bool makes_states_in_place() {
    if constexpr (TypedEngine<E>) return E::has_large_states;
    return true;
}

// Calls use(buffers) with these or, for small records, with variables, which the compiler may keep
// in registers.
template <class E, class Use>
RDDL_ALWAYS_INLINE decltype(auto) with_step_buffers(const StepBuffers& buffers, Use&& use) {
    constexpr std::size_t most_bytes = 4096;  // of the stack
    if constexpr (TypedEngine<E>) {
        struct Nothing {};
        struct Records {
            typename E::Action action;
            typename E::Scratch scratch;
            std::conditional_t<makes_states_in_place<E>(), Nothing, typename E::State> next;
            typename E::Observation observation;
        };
        if constexpr (sizeof(Records) <= most_bytes) {
            Records records;
            if constexpr (E::shows_padding)
                std::memset(static_cast<void*>(&records), 0, sizeof records);
            return use(StepBuffers{reinterpret_cast<std::byte*>(&records.action),
                                   reinterpret_cast<std::byte*>(&records.scratch),
                                   reinterpret_cast<std::byte*>(&records.next),
                                   reinterpret_cast<std::byte*>(&records.observation)});
        }
    }
    return use(buffers);
}

// Copies of whole blocks. Where their type is known they need not pass through memory, unless
// padding has to come along.
template <class Record, TypedEngine E>
RDDL_ALWAYS_INLINE void copy_typed(const E&, const std::byte* from, std::byte* to) {
    if constexpr (E::shows_padding)
        std::memcpy(to, from, sizeof(Record));
    else
        *reinterpret_cast<Record*>(to) = *reinterpret_cast<const Record*>(from);
}
// Two floats have the size of an int, as which compilers load them, waiting for the two stores.
template <Engine E>
RDDL_ALWAYS_INLINE void copy_each_value(const std::byte* from, std::byte* to) {
    for_each_column(E::state_columns, [&](const Column& column) RDDL_INLINE_LAMBDA {
        with_type<typename E::Lane>(column.scalar, [&]<class T>() RDDL_INLINE_LAMBDA {
            for (std::int64_t k = 0; k < column.count; ++k)
                detail::values_in<T>(to, column)[k] = detail::values_in<T>(from, column)[k];
        });
    });
}
template <Engine E>
RDDL_ALWAYS_INLINE void copy_state(const E& engine, const std::byte* from, std::byte* to) {
    if constexpr (TypedEngine<E> && std::is_same_v<typename E::Lane, ScalarOf<float>>)
        copy_each_value<E>(from, to);
    else if constexpr (TypedEngine<E>)
        copy_typed<typename E::State>(engine, from, to);
    else if (engine.state_size() > 0)
        std::memcpy(to, from, engine.state_size());
}
template <Engine E>
void copy_action(const E& engine, const std::byte* from, std::byte* to) {
    if (from == to) return;
    if constexpr (TypedEngine<E>)
        copy_typed<typename E::Action>(engine, from, to);
    else if (engine.action_size() > 0)
        std::memcpy(to, from, engine.action_size());
}
template <Engine E>
void copy_observation(const E& engine, const std::byte* from, std::byte* to) {
    if constexpr (TypedEngine<E>)
        copy_typed<typename E::Observation>(engine, from, to);
    else if (engine.observation_size() > 0)
        std::memcpy(to, from, engine.observation_size());
}

template <StateEngine E>
constexpr bool has_policy(const E& engine) {
    if constexpr (PolicyEngine<E>) return engine.has_policy();
    return false;
}

template <StateEngine E>
constexpr std::size_t memory_size(const E& engine) {
    if constexpr (PolicyEngine<E>) return engine.has_policy() ? engine.memory_size() : 0;
    return 0;
}

}  // namespace rddl
