// How a policy block chooses the actions of an episode.
#pragma once

#include <rddl/simulator.h>
#include <rddl/step/engine.hpp>
#include <rddl/step/episode.hpp>
#include <rddl/values/context.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl {

namespace detail {

template <class T>
std::int64_t count_unequal(const std::byte* a, const std::byte* b, std::int64_t count) {
    std::int64_t unequal = 0;
    for (std::int64_t i = 0; i < count; ++i) {
        T of_a, of_b;
        std::memcpy(&of_a, a + i * static_cast<std::int64_t>(sizeof(T)), sizeof(T));
        std::memcpy(&of_b, b + i * static_cast<std::int64_t>(sizeof(T)), sizeof(T));
        unequal += of_a != of_b;
    }
    return unequal;
}

}  // namespace detail

// How many values of an action record are not the default.
inline std::int64_t count_non_default(const rddl_problem& problem, const std::byte* action) {
    std::int64_t count = 0;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role != RDDL_ACTION) continue;
        const auto* const defaults = static_cast<const std::byte*>(problem.default_action);
        const auto count_of = [&]<class T>(T) {
            return detail::count_unequal<T>(action + fluent.offset, defaults + fluent.offset,
                                            fluent.count);
        };
        count += fluent.scalar == RDDL_BOOL  ? count_of(std::uint8_t{})
                 : fluent.scalar == RDDL_INT ? count_of(std::int64_t{})
                                             : count_of(double{});
    }
    return count;
}

// The place of a decision's results until it is known not to have faulted.
struct DecisionBuffers {
    std::byte* scratch;
    std::byte* action;
    std::byte* next_memory;
};

// One decision of an episode, if it runs. A fault ends the episode, and so does an action with more
// than max-nondef-actions values that are not the default; else the memory changes.
template <PolicyEngine E, class L = typename E::Lane>
void decide(const E& engine, const rddl_problem& problem, Episodes<L>& episode,
            const std::byte* observation, const DecisionBuffers& buffers, std::byte* memory) {
    if (!episode.running()) return;
    Context<L> context = episode.context_of_step(true);
    engine.act(observation, memory, buffers.scratch, buffers.action, buffers.next_memory, context);
    if (problem.max_nondef_actions >= 0) {
        const std::int64_t changed = count_non_default(problem, buffers.action);
        context.require(changed <= problem.max_nondef_actions, FaultKind::ActionLimit, {},
                        static_cast<double>(changed));
    }
    if (context.fault) return episode.end_by_faults(context);
    std::memcpy(memory, buffers.next_memory, engine.memory_size());
}

}  // namespace rddl
