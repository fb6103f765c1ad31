// What a batch needs from a simulator, compiled or interpreted.
//
// An engine works on blocks of Lane::width environments; that of the interpreter is one. A record
// of a block holds each value as the lane type's Bool, Int or Real.
//
// An engine is immutable and shared by threads: all its functions are const and work on records
// that the caller owns. Those of one environment are laid out as simulator.h says. Pointers are
// never null and are aligned for any element, also where a record is empty.
#pragma once

#include <rddl/context.hpp>
#include <rddl/lane.hpp>

#include <concepts>
#include <cstddef>

namespace rddl {

// What starts and describes episodes.
template <class E>
concept StartingEngine = requires(const E engine, const std::byte* record, std::byte* target,
                                  Context<typename E::Lane>& context) {
    // Bytes of one record; 0 for an empty one. Scratch is whatever a step needs beside them.
    { engine.state_size() } -> std::convertible_to<std::size_t>;
    { engine.action_size() } -> std::convertible_to<std::size_t>;
    { engine.observation_size() } -> std::convertible_to<std::size_t>;
    { engine.scratch_size() } -> std::convertible_to<std::size_t>;

    // reset(state, context): the initial values.
    {engine.reset(target, context)};
    // Whether a termination condition holds.
    { engine.terminal(record, context) } -> std::convertible_to<typename E::Lane::Bool>;
    // The first violated condition, or -1. One that faults counts as violated.
    {
        engine.violated_precondition(record, record, context)
        } -> std::convertible_to<typename E::Lane::Int>;
};

template <class E>
concept Engine = StartingEngine<E> &&
    requires(const E engine, const std::byte* record, std::byte* target,
             Context<typename E::Lane>& context) {
    // step(state, action, scratch, next, observation, context): fills the next state, and the
    // observation of a partially observed problem; the reward.
    {
        engine.step(record, record, target, target, target, context)
        } -> std::convertible_to<typename E::Lane::Real>;
    // As violated_precondition.
    { engine.violated_invariant(record, context) } -> std::convertible_to<typename E::Lane::Int>;
};

// An engine that may have a policy. Memory is what the policy remembers within an episode.
template <class E>
concept PolicyEngine = StartingEngine<E> &&
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

template <StartingEngine E>
constexpr bool has_policy(const E& engine) {
    if constexpr (PolicyEngine<E>) return engine.has_policy();
    return false;
}

template <StartingEngine E>
constexpr std::size_t memory_size(const E& engine) {
    if constexpr (PolicyEngine<E>) return engine.has_policy() ? engine.memory_size() : 0;
    return 0;
}

}  // namespace rddl
