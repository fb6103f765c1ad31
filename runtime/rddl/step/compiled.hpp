// An emitted simulator as an engine (engine.hpp), for one environment or for packs of them.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/simulator.h>
#include <rddl/step/columns.hpp>
#include <rddl/step/conditions.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/pack_ops.hpp>

#include <cstddef>
#include <type_traits>

namespace rddl {

// Bytes of a record. An empty struct has one byte in C++; an empty record of the C interface has 0.
template <class Record>
inline constexpr std::size_t record_size = std::is_empty_v<Record> ? 0 : sizeof(Record);

// The policy of a simulator whose problem has no policy block.
struct NoPolicy {
    template <class L>
    struct Memory {};
};

// The CPFs and then the reward.
template <class Simulator, class L, class State, class Action, class Scratch, class Observation>
RDDL_ALWAYS_INLINE typename L::Real step_with_reward(const State& state, const Action& action,
                                                     Scratch& scratch, State& next,
                                                     Observation& observation,
                                                     Context<L>& context) {
    if constexpr (requires { Simulator::has_moderate_step; }) {
        return Simulator::step_with_reward(state, action, scratch, next, observation, context);
    } else {
        Simulator::step(state, action, scratch, next, observation, context);
        return Simulator::reward(state, action, scratch, next, context);
    }
}

// A simulator with a second step, for states and actions whose reals are all moderate: it does the
// same with less work.
template <class Simulator, class ModerateStep>
struct WithModerateStep : Simulator {
    static constexpr bool has_moderate_step = true;

    template <class L>
    union Scratch {
        typename Simulator::template Scratch<L> of_any;
        typename ModerateStep::template Scratch<L> of_moderate;
    };

    template <class L, class State, class Action, class Observation>
    RDDL_ALWAYS_INLINE static typename L::Real step_with_reward(const State& state,
                                                                const Action& action,
                                                                Scratch<L>& scratch, State& next,
                                                                Observation& observation,
                                                                Context<L>& context) {
        if (!all(ModerateStep::is_for(state, action))) [[unlikely]]
            return of_any_values(state, action, scratch.of_any, next, observation, context);
        return rddl::step_with_reward<ModerateStep>(state, action, scratch.of_moderate, next,
                                                    observation, context);
    }

  private:
    template <class L, class State, class Action, class ScratchOfAny, class Observation>
    [[gnu::noinline, gnu::cold]] static typename L::Real of_any_values(
        const State& state, const Action& action, ScratchOfAny& scratch, State& next,
        Observation& observation, Context<L>& context) {
        if constexpr (requires { Simulator::settle(next); }) {
            Simulator::settle(const_cast<State&>(state));
            Simulator::settle(next);
        }
        return rddl::step_with_reward<Simulator>(state, action, scratch, next, observation,
                                                 context);
    }
};

// `problem` describes the simulator.
template <class Simulator, const rddl_problem& problem, class L = Scalar, class Policy = NoPolicy>
struct Compiled {
    using Lane = L;
    using State = typename Simulator::template State<L>;
    using Action = typename Simulator::template Action<L>;
    using Scratch = typename Simulator::template Scratch<L>;
    using Observation = typename Simulator::template Observation<L>;
    using Memory = typename Policy::template Memory<L>;
    // The records of one environment are the callers', who copy their bytes.
    template <class... Records>
    static constexpr bool are_bytes = (std::is_trivially_copyable_v<Records> && ...);
    static_assert(L::width > 1 || are_bytes<State, Action, Scratch, Observation, Memory>);

    static constexpr bool has_state_tables = has_tables(problem, RDDL_STATE);
    static constexpr bool has_large_states =
        has_state_tables || (L::width > 1 && has_large_state(problem));
    static constexpr bool draws = problem.stochastic != 0;
    static constexpr auto state_columns = known_columns<L, problem, RDDL_STATE>(problem.state_size);
    static constexpr auto action_columns =
        known_columns<L, problem, RDDL_ACTION>(problem.action_size);
    // The emitted code takes the bools of actions as callers give them: any byte but 0 is true.
    static constexpr bool tests_action_bools = requires { Simulator::tests_action_bools; };
    // Callers get all bytes of the records of one environment.
    static constexpr bool shows_padding =
        L::width == 1 && (has_padding(problem, RDDL_STATE, problem.state_size) ||
                          (Simulator::partially_observed &&
                           has_padding(problem, RDDL_OBSERVATION, problem.observation_size)));

    static constexpr std::size_t state_size() { return record_size<State>; }
    static constexpr std::size_t action_size() { return record_size<Action>; }
    static constexpr std::size_t scratch_size() { return record_size<Scratch>; }
    static constexpr std::size_t observation_size() {
        return Simulator::partially_observed ? record_size<Observation> : record_size<State>;
    }

    static constexpr bool has_sliding_buffers = L::width > 1 && requires(State& state) {
        Simulator::settle(state);
    };
    static constexpr std::size_t sliding_buffers_size() {
        if constexpr (has_sliding_buffers) return Simulator::template sliding_buffers_size<L>();
        return 0;
    }
    static void settle(std::byte* state) {
        if constexpr (has_sliding_buffers) Simulator::settle(as<State>(state));
    }

    static void reset(std::byte* state, Context<L>& context) {
        settle(state);
        Simulator::reset(as<State>(state), context);
    }

    static void initial_state(std::byte* state) requires requires(State& initial) {
        Simulator::initial_state(initial);
    }
    { Simulator::initial_state(as<State>(state)); }

    static typename L::Real step(const std::byte* state, const std::byte* action,
                                 std::byte* scratch, std::byte* next, std::byte* observation,
                                 Context<L>& context) {
        const State& current = as<State>(state);
        const Action& chosen = as<Action>(action);
        Scratch& workspace = as<Scratch>(scratch);
        State& following = as<State>(next);
        Observation& seen = as<Observation>(observation);
        return step_with_reward<Simulator>(current, chosen, workspace, following, seen, context);
    }

    static typename L::Bool terminal(const std::byte* state, Context<L>& context) {
        return Simulator::terminal(as<State>(state), context);
    }

    static typename L::Bool violates_invariant(const std::byte* state, Context<L>& context) {
        return Simulator::violates_invariant(as<State>(state), context);
    }

    static typename L::Int violated_precondition(const std::byte* state, const std::byte* action,
                                                 Context<L>& context) {
        return Simulator::violated_precondition(as<State>(state), as<Action>(action), context);
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
                    Context<L>& context) requires with_policy {
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

// The same simulator for packs of n environments, with reals of type R.
template <class Simulator, const rddl_problem& problem, int n, class R = double>
using Packed = Compiled<Simulator, problem, Pack<n, R>>;

// The same where the ints of all steps from states within the fluents' bounds fit into a byte: 64
// environments where registers hold as many byte ints, else n.
template <class Simulator, const rddl_problem& problem, int n, class R = double>
#ifdef RDDL_SIMD_BYTE_INTS
using PackedByteInts = Compiled<Simulator, problem, ByteIntPack<R>>;
#else
using PackedByteInts = Packed<Simulator, problem, n, R>;
#endif

}  // namespace rddl
