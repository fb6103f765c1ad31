// A simulator written by hand in the form that the emitter gives: machines that wear, break and
// are repaired. It has every kind of fluent and every cause for an episode to end.
#pragma once

#include <rddl/simulator.hpp>

#include <array>
#include <cstdint>
#include <limits>

namespace tiny {

using rddl::Context;
using rddl::Index;
using rddl::Scalar;

inline constexpr Index machines = 3;

// The instance, and what the tests vary of it.
inline constexpr double wear_variance = 0.25;

template <class L>
struct State {
    std::array<typename L::Real, machines> wear;     // wear(?m)
    std::array<typename L::Bool, machines> running;  // running(?m)
    typename L::Int mode;                            // mode: @slow or @fast
    typename L::Int repairs;                         // repairs
};

template <class L>
struct Action {
    std::array<typename L::Bool, machines> repair;  // repair(?m)
    typename L::Int set_mode;                       // set-mode: @slow or @fast
    typename L::Real hazard;                        // hazard: added to a probability unchecked
};

template <class L>
struct Scratch {
    std::array<typename L::Real, machines> strain;  // strain(?m), an interm-fluent
};

template <class L>
struct Observation {};

// Converts a bool or an int.
template <class L, class Value>
typename L::Real to_real_of(const Value& value) {
    if constexpr (std::is_same_v<typename L::Element, float>)
        return rddl::to_float(value);
    else
        return rddl::to_real(value);
}

struct Simulator {
    template <class L>
    using State = tiny::State<L>;
    template <class L>
    using Action = tiny::Action<L>;
    template <class L>
    using Scratch = tiny::Scratch<L>;
    template <class L>
    using Observation = tiny::Observation<L>;

    static constexpr bool partially_observed = false;

    template <class L>
    static void reset(State<L>& state, Context<L>& /*context*/) {
        for (Index m = 0; m < machines; ++m) {
            state.wear[m] = 0;
            state.running[m] = true;
        }
        state.mode = 0;
        state.repairs = 0;
    }

    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                     State<L>& next, Observation<L>&, Context<L>& context) {
        using namespace rddl;
        using Number = typename L::Element;
        for (Index m = 0; m < machines; ++m)
            scratch.strain[m] =
                to_real_of<L>(state.mode) + sample::gamma(context, {0, m}, 2.0, 0.5);
        for (Index m = 0; m < machines; ++m)
            next.wear[m] = branch(
                context, action.repair[m], [&] { return typename L::Real{0}; },
                [&] {
                    return state.wear[m] + scratch.strain[m] +
                           sample::normal(context, {1, m}, 0.0, wear_variance);
                });
        for (Index m = 0; m < machines; ++m)
            next.running[m] =
                !sample::bernoulli(context, {2, m},
                                   Number(0.02) + select(m == 1, action.hazard, Number(0))) &&
                (state.running[m] || action.repair[m]);
        next.mode = action.set_mode;
        next.repairs = wrap_add(state.repairs, sum<typename L::Int>(machines, [&](Index m) {
                                    return to_int(action.repair[m]);
                                }));
    }

    template <class L>
    static typename L::Real reward(const State<L>& state, const Action<L>&, const Scratch<L>&,
                                   const State<L>&, Context<L>&) {
        return rddl::sum<typename L::Real>(machines, [&](Index m) {
            return to_real_of<L>(state.running[m]) - typename L::Element(0.01) * state.wear[m];
        });
    }

    // Nothing runs.
    template <class L>
    static typename L::Bool terminal(const State<L>& state, Context<L>&) {
        return !rddl::exists<typename L::Bool>(machines, [&](Index m) { return state.running[m]; });
    }
    // Wear stays below 13.
    template <class L>
    static typename L::Bool violates_invariant(const State<L>& state, Context<L>& context) {
        rddl::Invariants<L> conditions(context);
        if (conditions.go_on())
            conditions.add(rddl::for_all<typename L::Bool>(
                machines, [&](Index m) { return state.wear[m] < 13.0; }));
        return conditions.violated();
    }
    // The precondition: at most one repair at a time.
    template <class L>
    static typename L::Int violated_precondition(const State<L>&, const Action<L>& action,
                                                 Context<L>& context) {
        rddl::Preconditions<L> conditions(context);
        if (conditions.go_on())
            conditions.add(0, rddl::sum<typename L::Int>(machines, [&](Index m) {
                                  return rddl::to_int(action.repair[m]);
                              }) <= 1);
        return conditions.first_violated();
    }
};

inline constexpr const char* machine_names[] = {"lathe", "mill", "press"};
inline constexpr const char* mode_names[] = {"slow", "fast"};
inline constexpr rddl_type types[] = {{"machine", machine_names, machines, 0},
                                      {"speed", mode_names, 2, 1}};
inline constexpr std::int32_t over_machines[] = {0};
inline constexpr rddl_fluent fluents[] = {{"wear",
                                           RDDL_STATE,
                                           RDDL_REAL,
                                           -1,
                                           1,
                                           over_machines,
                                           machines,
                                           offsetof(State<Scalar>, wear),
                                           nullptr,
                                           nullptr,
                                           {"tiny.rddl", 5, 9}},
                                          {"running",
                                           RDDL_STATE,
                                           RDDL_BOOL,
                                           -1,
                                           1,
                                           over_machines,
                                           machines,
                                           offsetof(State<Scalar>, running),
                                           nullptr,
                                           nullptr,
                                           {"tiny.rddl", 6, 9}},
                                          {"mode",
                                           RDDL_STATE,
                                           RDDL_INT,
                                           1,
                                           0,
                                           nullptr,
                                           1,
                                           offsetof(State<Scalar>, mode),
                                           nullptr,
                                           nullptr,
                                           {"tiny.rddl", 7, 9}},
                                          {"repairs",
                                           RDDL_STATE,
                                           RDDL_INT,
                                           -1,
                                           0,
                                           nullptr,
                                           1,
                                           offsetof(State<Scalar>, repairs),
                                           nullptr,
                                           nullptr,
                                           {"tiny.rddl", 8, 9}},
                                          {"strain",
                                           RDDL_INTERM,
                                           RDDL_REAL,
                                           -1,
                                           1,
                                           over_machines,
                                           machines,
                                           -1,
                                           nullptr,
                                           nullptr,
                                           {"tiny.rddl", 9, 9}},
                                          {"repair",
                                           RDDL_ACTION,
                                           RDDL_BOOL,
                                           -1,
                                           1,
                                           over_machines,
                                           machines,
                                           offsetof(Action<Scalar>, repair),
                                           nullptr,
                                           nullptr,
                                           {"tiny.rddl", 10, 9}},
                                          {"set-mode",
                                           RDDL_ACTION,
                                           RDDL_INT,
                                           1,
                                           0,
                                           nullptr,
                                           1,
                                           offsetof(Action<Scalar>, set_mode),
                                           nullptr,
                                           nullptr,
                                           {"tiny.rddl", 11, 9}},
                                          {"hazard",
                                           RDDL_ACTION,
                                           RDDL_REAL,
                                           -1,
                                           0,
                                           nullptr,
                                           1,
                                           offsetof(Action<Scalar>, hazard),
                                           nullptr,
                                           nullptr,
                                           {"tiny.rddl", 12, 9}}};
inline constexpr rddl_condition preconditions[] = {
    {"sum_{?m : machine} repair(?m) <= 1", {"tiny.rddl", 30, 9}}};
inline constexpr rddl_condition invariants[] = {
    {"forall_{?m : machine} wear(?m) < 13", {"tiny.rddl", 33, 9}}};
inline constexpr rddl_condition terminations[] = {
    {"~exists_{?m : machine} running(?m)", {"tiny.rddl", 36, 9}}};
inline constexpr Action<Scalar> default_action{};

inline constexpr rddl::SiteVariable over_m[] = {{"m", &types[0]}};
inline constexpr rddl::Site sites[] = {{{"tiny.rddl", 20, 20}, "Gamma", over_m},
                                       {{"tiny.rddl", 21, 60}, "Normal", over_m},
                                       {{"tiny.rddl", 22, 24}, "Bernoulli", over_m}};

inline constexpr rddl_problem problem{.struct_size = sizeof(rddl_problem),
                                      .type_size = sizeof(rddl_type),
                                      .fluent_size = sizeof(rddl_fluent),
                                      .condition_size = sizeof(rddl_condition),
                                      .domain = "tiny",
                                      .instance = "tiny_1",
                                      .types = types,
                                      .type_count = 2,
                                      .fluents = fluents,
                                      .fluent_count = 8,
                                      .state_size = sizeof(State<Scalar>),
                                      .action_size = sizeof(Action<Scalar>),
                                      .observation_size = sizeof(State<Scalar>),
                                      .interm_size = 0,
                                      .partially_observed = 0,
                                      .stochastic = 1,
                                      .default_action = &default_action,
                                      .horizon = 50,
                                      .discount = 0.9,
                                      .max_nondef_actions = 1,
                                      .preconditions = preconditions,
                                      .precondition_count = 1,
                                      .invariants = invariants,
                                      .invariant_count = 1,
                                      .terminations = terminations,
                                      .termination_count = 1,
                                      .fingerprint = 0};

// Made once, in tiny_simulator.cpp: single environments, and packs of 16.
const rddl_simulator* simulator();

}  // namespace tiny
