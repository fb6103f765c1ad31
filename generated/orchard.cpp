// A simulator, made by rddlc 0.2.0. Do not edit it: change its sources and compile them again.
//
//     problem   orchard
//     instance  orchard_1
//     sources   examples/orchard/domain.rddl
//               examples/orchard/instance.rddl
//
// Compile it with -std=c++20 -O3 -ffp-contract=off and rddlc's include folder; g++ also needs
// -fno-tree-loop-distribute-patterns. Link it and call the extern "C" function
//
//     rddl_simulator_orchard_orchard_1
//
// or make a shared object for dlopen with -shared -fPIC -DRDDL_ENTRY=rddl_simulator_entry.
// <rddl/simulator.h> describes the rddl_simulator that it returns.

#include "../examples/orchard/functions.hpp"

#include <rddl/external.hpp>
#include <rddl/simulator.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl_simulators::orchard_orchard_1 {
// Unnamed, so that two versions of a simulator can be loaded into one program.
namespace {

// --------------------------------------------------------------------------------- objects

inline constexpr rddl::Index plot_count = 3;  // upper, middle, lower

// ---------------------------------------------------------------------- external functions

// $evaporation, domain.rddl:30
static_assert(rddl::external::fits<double(double)>(RDDL_EXTERN_FUNCTION(evaporation)),
              "the external function $evaporation must be callable as double "
              "rddl_extern::evaporation(double)");

// $settle, domain.rddl:32
static_assert(rddl::external::fits<void(std::span<const double, 3>, std::span<const double, 3>,
                                        std::span<const std::array<double, 3>, 3>,
                                        std::span<double, 3>)>(RDDL_EXTERN_FUNCTION(settle)),
              "the external function $settle must be callable as void "
              "rddl_extern::settle(std::span<const double, 3>, std::span<const double, 3>, "
              "std::span<const std::array<double, 3>, 3>, std::span<double, 3>)");

// ---------------------------------------------------------------------------------- tables

// CAPACITY, domain.rddl:13
inline constexpr std::array<double, plot_count> CAPACITY_ = {25, 40, 40};

// RUNS-TO, domain.rddl:14
inline constexpr std::array<std::array<double, plot_count>, plot_count> RUNS_TO_ = {{
    {0, 0.75, 0},
    {0, 0, 0.75},
    {0, 0, 0},
}};

// water, domain.rddl:19
inline constexpr std::array<double, plot_count> initial_water = {24, 20, 20};

// --------------------------------------------------------------------------------- records

template <class L>
struct State {
    std::array<typename L::Real, plot_count> water;  // domain.rddl:19
    typename L::Real temperature;                    // domain.rddl:20
};

template <class L>
struct Action {
    std::array<typename L::Bool, plot_count> open;  // domain.rddl:26
};

// Values that CPFs compute and others read, within a step.
template <class L>
struct Scratch {
    typename L::Real evaporation;                       // domain.rddl:22
    std::array<typename L::Real, plot_count> supplied;  // domain.rddl:23
    std::array<typename L::Real, plot_count> settled;   // domain.rddl:24
    typename L::Real evaporation_2;                     // domain.rddl:30
    std::array<typename L::Real, plot_count> settle;    // domain.rddl:32
};

template <class L>
struct Observation {};

// ------------------------------------------------------------------------------ simulator

struct Simulator {
    template <class L> using State = orchard_orchard_1::State<L>;
    template <class L> using Action = orchard_orchard_1::Action<L>;
    template <class L> using Scratch = orchard_orchard_1::Scratch<L>;
    template <class L> using Observation = orchard_orchard_1::Observation<L>;

    static constexpr bool partially_observed = false;

    // The initial state.
    template <class L>
    static void reset(State<L>& state, rddl::Context<L>& /*context*/) {
        rddl::assign(state.water, initial_water);
        state.temperature = 22.0;
    }

    // All CPFs, each after those that it depends on.
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                     State<L>& next, Observation<L>& /*observation*/, rddl::Context<L>& context) {
        set_evaporation(state, scratch);
        set_supplied(state, action, scratch);
        set_temperature(state, next, context);
        set_settled(scratch);
        set_water(scratch, next);
    }

    // evaporation  (domain.rddl:30)
    template <class L>
    static void set_evaporation(const State<L>& state, Scratch<L>& scratch) {
        scratch.evaporation_2 = rddl_extern::evaporation(state.temperature);
        scratch.evaporation = scratch.evaporation_2;
    }

    // supplied(?p)  (domain.rddl:31)
    template <class L>
    static void set_supplied(const State<L>& state, const Action<L>& action, Scratch<L>& scratch) {
        for (rddl::Index p = 0; p < plot_count; ++p) {
            scratch.supplied[p] = state.water[p] + rddl::to_real(action.open[p]) * 6.0;
        }
    }

    // temperature'  (domain.rddl:34)
    template <class L>
    static void set_temperature(const State<L>& state, State<L>& next, rddl::Context<L>& context) {
        next.temperature =
            22.0 + 0.8 * (state.temperature - 22.0) +
            rddl::sample::normal(context, rddl::LonePlace{0, 0}, 0.0, 4.0);
    }

    // settled(?p)  (domain.rddl:32)
    template <class L>
    static void set_settled(Scratch<L>& scratch) {
        rddl_extern::settle(rddl::external::input(scratch.supplied),
                            rddl::external::input(CAPACITY_), rddl::external::input(RUNS_TO_),
                            rddl::external::output(scratch.settle));
        for (rddl::Index p = 0; p < plot_count; ++p) {
            scratch.settled[p] = scratch.settle[p];
        }
    }

    // water'(?p)  (domain.rddl:33)
    template <class L>
    static void set_water(const Scratch<L>& scratch, State<L>& next) {
        for (rddl::Index p = 0; p < plot_count; ++p) {
            next.water[p] = rddl::maximum(0.0, scratch.settled[p] - scratch.evaporation);
        }
    }

    // The reward of the step that was just made.
    template <class L>
    static typename L::Real reward(const State<L>& /*state*/, const Action<L>& action,
                                   const Scratch<L>& /*scratch*/, const State<L>& next,
                                   rddl::Context<L>& /*context*/) {
        using Real = typename L::Real;
        return rddl::sum<Real>(plot_count, [&](rddl::Index p) {
            return rddl::to_real(next.water[p] >= 12.0) -
                   0.6000000000000001 * rddl::to_real(action.open[p]);
        });
    }

    // Whether one of the terminations holds, so that the episode ends.
    template <class L>
    static typename L::Bool terminal(const State<L>& /*state*/, rddl::Context<L>& /*context*/) {
        return false;
    }

    // Whether the state breaks one of the invariants.
    template <class L>
    static typename L::Bool violates_invariant(const State<L>& /*state*/,
                                               rddl::Context<L>& /*context*/) {
        return false;
    }

    // The first precondition that the action violates, or -1.
    template <class L>
    static typename L::Int violated_precondition(const State<L>& /*state*/,
                                                 const Action<L>& /*action*/,
                                                 rddl::Context<L>& /*context*/) {
        return typename L::Int{-1};
    }
};

static_assert(sizeof(State<rddl::Scalar>) == 32);
static_assert(offsetof(State<rddl::Scalar>, temperature) == 24);
static_assert(sizeof(Action<rddl::Scalar>) == 3);

// --------------------------------------------------------------- description of the problem

namespace about {

inline constexpr const char* source_file = "examples/orchard/domain.rddl";
inline constexpr const char* plot_objects[] = {"upper", "middle", "lower"};
inline constexpr rddl_type types[] = {{"plot", plot_objects, plot_count, 0}};
inline constexpr std::int32_t of_plot[] = {0};
inline constexpr std::int32_t of_plot_plot[] = {0, 0};

// name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, source
inline constexpr rddl_fluent fluents[] = {
    {"CAPACITY", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_plot, 3, -1, nullptr, nullptr,
     {source_file, 13, 9}},
    {"RUNS-TO", RDDL_NON_FLUENT, RDDL_REAL, -1, 2, of_plot_plot, 9, -1, nullptr, nullptr,
     {source_file, 14, 9}},
    {"VALVE-RATE", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 15, 9}},
    {"PRICE", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 16, 9}},
    {"THIRSTY-BELOW", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 17, 9}},
    {"water", RDDL_STATE, RDDL_REAL, -1, 1, of_plot, 3, offsetof(State<rddl::Scalar>, water),
     nullptr, nullptr, {source_file, 19, 9}},
    {"temperature", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1,
     offsetof(State<rddl::Scalar>, temperature), nullptr, nullptr, {source_file, 20, 9}},
    {"evaporation", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 22, 9}},
    {"supplied", RDDL_INTERM, RDDL_REAL, -1, 1, of_plot, 3, -1, nullptr, nullptr,
     {source_file, 23, 9}},
    {"settled", RDDL_INTERM, RDDL_REAL, -1, 1, of_plot, 3, -1, nullptr, nullptr,
     {source_file, 24, 9}},
    {"open", RDDL_ACTION, RDDL_BOOL, -1, 1, of_plot, 3, offsetof(Action<rddl::Scalar>, open),
     nullptr, nullptr, {source_file, 26, 9}},
};

inline constexpr rddl::Constants constants[] = {
    rddl::constants(0, CAPACITY_),    // CAPACITY
    rddl::constants(1, RUNS_TO_),     // RUNS-TO
    rddl::constant<double>(2, 6.0),   // VALVE-RATE
    rddl::constant<double>(3, 0.1),   // PRICE
    rddl::constant<double>(4, 12.0),  // THIRSTY-BELOW
};

inline constexpr Action<rddl::Scalar> default_action = [] {
    Action<rddl::Scalar> action{};
    rddl::assign(action.open, false);
    return action;
}();

inline constexpr rddl_problem problem = {
    .struct_size = sizeof(rddl_problem),
    .type_size = sizeof(rddl_type),
    .fluent_size = sizeof(rddl_fluent),
    .condition_size = sizeof(rddl_condition),
    .domain = "orchard",
    .instance = "orchard_1",
    .types = types,
    .type_count = 1,
    .fluents = fluents,
    .fluent_count = 11,
    .state_size = sizeof(State<rddl::Scalar>),
    .action_size = sizeof(Action<rddl::Scalar>),
    .observation_size = sizeof(State<rddl::Scalar>),
    .interm_size = 0,
    .partially_observed = 0,
    .stochastic = 1,
    .default_action = &default_action,
    .horizon = 60,
    .discount = 1.0,
    .max_nondef_actions = 2,
    .preconditions = nullptr,
    .precondition_count = 0,
    .invariants = nullptr,
    .invariant_count = 0,
    .terminations = nullptr,
    .termination_count = 0,
    .fingerprint = 0x451c96289249a0b0,
};

inline constexpr rddl::Site sites[] = {{{source_file, 34, 60}, "Normal", {}}};

}  // namespace about

inline const rddl_simulator* simulator() {
    using Engine = rddl::Compiled<Simulator, about::problem>;
    constexpr rddl::About description{about::problem, about::sites, about::constants};
    static const rddl::SimulatorTable<Engine> table(description, Engine());
    return table.get();
}

}  // namespace
}  // namespace rddl_simulators::orchard_orchard_1

#ifndef RDDL_ENTRY
#define RDDL_ENTRY rddl_simulator_orchard_orchard_1
#endif

extern "C" RDDL_EXPORT const rddl_simulator* RDDL_ENTRY(void) {
    return rddl_simulators::orchard_orchard_1::simulator();
}
