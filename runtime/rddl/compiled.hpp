// An emitted simulator as an engine (engine.hpp), for one environment or for packs of them.
#pragma once

#include <rddl/columns.hpp>
#include <rddl/context.hpp>
#include <rddl/lane.hpp>
#include <rddl/pack_ops.hpp>
#include <rddl/simulator.h>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace rddl {

// Bytes of a record; C++ gives an empty struct one, the C interface none.
template <class Record>
inline constexpr std::size_t record_size = std::is_empty_v<Record> ? 0 : sizeof(Record);

// Of a simulator whose problem has no policy block.
struct NoPolicy {
    template <class L>
    struct Memory {};
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
    static_assert(std::is_trivially_copyable_v<State> && std::is_trivially_copyable_v<Action> &&
                  std::is_trivially_copyable_v<Scratch> &&
                  std::is_trivially_copyable_v<Observation> &&
                  std::is_trivially_copyable_v<Memory>);

    static constexpr bool has_state_tables = has_tables(problem, RDDL_STATE);
    static constexpr auto state_columns = known_columns<L, problem, RDDL_STATE>(problem.state_size);
    static constexpr auto action_columns =
        known_columns<L, problem, RDDL_ACTION>(problem.action_size);
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

    static void reset(std::byte* state, Context<L>& context) {
        Simulator::reset(as<State>(state), context);
    }

    static typename L::Real step(const std::byte* state, const std::byte* action,
                                 std::byte* scratch, std::byte* next, std::byte* observation,
                                 Context<L>& context) {
        const State& current = as<State>(state);
        const Action& chosen = as<Action>(action);
        Scratch& workspace = as<Scratch>(scratch);
        State& following = as<State>(next);
        Simulator::step(current, chosen, workspace, following, as<Observation>(observation),
                        context);
        return Simulator::reward(current, chosen, workspace, following, context);
    }

    // All are evaluated: one of them may fault.
    static typename L::Bool terminal(const std::byte* state, Context<L>& context) {
        typename L::Bool holds{false};
        for_each_index<problem.termination_count>([&](Index k) RDDL_INLINE_LAMBDA {
            holds = Simulator::termination(k, as<State>(state), context) || holds;
        });
        return holds;
    }

    static typename L::Bool violates_invariant(const std::byte* state, Context<L>& context) {
        typename L::Bool violated{false};
        for_each_index<problem.invariant_count>([&](Index k) RDDL_INLINE_LAMBDA {
            evaluate_where(!violated, context, [&]() RDDL_INLINE_LAMBDA {
                const typename L::Bool holds = Simulator::invariant(k, as<State>(state), context);
                violated = violated || !holds || context.faulted();
            });
        });
        return violated;
    }

    static typename L::Int violated_precondition(const std::byte* state, const std::byte* action,
                                                 Context<L>& context) {
        return first_violated(problem.precondition_count, context, [&](Index k) {
            return Simulator::precondition(k, as<State>(state), as<Action>(action), context);
        });
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
    // Calls body with 0, 1, ..., count - 1, as constants.
    template <Index count, class Body>
    static RDDL_INLINE void for_each_index(Body&& body) {
        [&]<Index... k>(std::integer_sequence<Index, k...>) RDDL_INLINE_LAMBDA {
            (body(k), ...);
        }
        (std::make_integer_sequence<Index, count>());
    }

    // The other lanes cannot fault meanwhile.
    template <class Body>
    static RDDL_INLINE void evaluate_where(typename L::Bool lanes, Context<L>& context,
                                           Body&& body) {
        if constexpr (L::width == 1) {
            if (lanes) body();
        } else {
            const typename L::Bool active = context.active;
            context.active = active && lanes;
            body();
            context.active = active;
        }
    }

    // Of the conditions 0 .. count - 1; -1 where all hold.
    template <class Condition>
    static typename L::Int first_violated(Index count, const Context<L>& context,
                                          Condition&& condition) {
        using Bool = typename L::Bool;
        using Int = typename L::Int;
        Int first{std::int64_t{-1}};
        for (Index k = 0; k < count; ++k) {
            const Bool holds = condition(k);
            const Bool unviolated = first < Int{0};
            first = select((!holds || context.faulted()) && unviolated, Int{k}, first);
            if (all(!unviolated)) break;
        }
        return first;
    }

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

}  // namespace rddl
