// An emitted simulator as an engine (engine.hpp). Its sizes are constants, so that a batch copies
// small records in a few instructions.
#pragma once

#include <rddl/context.hpp>
#include <rddl/lane.hpp>

#include <cstddef>
#include <type_traits>

namespace rddl {

// Bytes of a record; C++ gives an empty struct one, the C interface none.
template <class Record>
inline constexpr std::size_t record_size = std::is_empty_v<Record> ? 0 : sizeof(Record);

// Of a simulator whose problem has no policy block.
struct NoPolicy {
    template <class L>
    struct Memory {};
};

template <class Simulator, class Policy = NoPolicy>
struct Compiled {
    using State = typename Simulator::template State<Scalar>;
    using Action = typename Simulator::template Action<Scalar>;
    using Scratch = typename Simulator::template Scratch<Scalar>;
    using Observation = typename Simulator::template Observation<Scalar>;
    using Memory = typename Policy::template Memory<Scalar>;
    static_assert(std::is_trivially_copyable_v<State> && std::is_trivially_copyable_v<Action> &&
                  std::is_trivially_copyable_v<Scratch> &&
                  std::is_trivially_copyable_v<Observation> &&
                  std::is_trivially_copyable_v<Memory>);

    static constexpr std::size_t state_size() { return record_size<State>; }
    static constexpr std::size_t action_size() { return record_size<Action>; }
    static constexpr std::size_t scratch_size() { return record_size<Scratch>; }
    static constexpr std::size_t observation_size() {
        return Simulator::partially_observed ? record_size<Observation> : record_size<State>;
    }

    static void reset(std::byte* state, Context<Scalar>& context) {
        Simulator::reset(as<State>(state), context);
    }

    static double step(const std::byte* state, const std::byte* action, std::byte* scratch,
                       std::byte* next, std::byte* observation, Context<Scalar>& context) {
        const State& current = as<State>(state);
        const Action& chosen = as<Action>(action);
        Scratch& workspace = as<Scratch>(scratch);
        State& following = as<State>(next);
        Simulator::step(current, chosen, workspace, following, as<Observation>(observation),
                        context);
        return Simulator::reward(current, chosen, workspace, following, context);
    }

    static bool terminal(const std::byte* state, Context<Scalar>& context) {
        bool holds = false;
        for (Index k = 0; k < Simulator::termination_count; ++k)
            holds = Simulator::termination(k, as<State>(state), context) || holds;
        return holds;
    }

    static int violated_invariant(const std::byte* state, Context<Scalar>& context) {
        for (Index k = 0; k < Simulator::invariant_count; ++k)
            if (!Simulator::invariant(k, as<State>(state), context) || context.fault)
                return static_cast<int>(k);
        return -1;
    }

    static int violated_precondition(const std::byte* state, const std::byte* action,
                                     Context<Scalar>& context) {
        for (Index k = 0; k < Simulator::precondition_count; ++k)
            if (!Simulator::precondition(k, as<State>(state), as<Action>(action), context) ||
                context.fault)
                return static_cast<int>(k);
        return -1;
    }

    // The policy, if there is one (policy.hpp).
    static constexpr bool with_policy = !std::is_same_v<Policy, NoPolicy>;
    static constexpr bool has_policy() requires with_policy { return true; }
    static constexpr std::size_t memory_size() { return record_size<Memory>; }

    static void reset_policy(std::byte* memory) requires with_policy {
        Policy::reset(as<Memory>(memory));
    }

    static void act(const std::byte* observation, const std::byte* memory, std::byte* scratch,
                    std::byte* action, std::byte* next_memory,
                    Context<Scalar>& context) requires with_policy {
        using Seen = std::conditional_t<Simulator::partially_observed, Observation, State>;
        Policy::act(as<Seen>(observation), as<Memory>(memory), as<Scratch>(scratch),
                    as<Action>(action), as<Memory>(next_memory), context);
    }

  private:
    template <class Record>
    static Record& as(std::byte* record) {
        return *reinterpret_cast<Record*>(record);
    }
    template <class Record>
    static const Record& as(const std::byte* record) {
        return *reinterpret_cast<const Record*>(record);
    }
};

}  // namespace rddl
