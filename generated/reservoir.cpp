// A simulator, made by rddlc 0.2.0. Do not edit it: change its sources and compile them again.
//
//     problem   reservoir
//     instance  reservoir_1
//     sources   examples/reservoir/domain.rddl
//               examples/reservoir/instance.rddl
//
// Compile it with -std=c++20 -O3 -ffp-contract=off and rddlc's include folder; g++ also needs
// -fno-tree-loop-distribute-patterns. Link it and call the extern "C" function
//
//     rddl_simulator_reservoir_reservoir_1
//
// or make a shared object for dlopen with -shared -fPIC -DRDDL_ENTRY=rddl_simulator_entry.
// <rddl/simulator.h> describes the rddl_simulator that it returns.

#include <rddl/simulator.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl_simulators::reservoir_reservoir_1 {
// Unnamed, so that two versions of a simulator can be loaded into one program.
namespace {

// --------------------------------------------------------------------------------- objects

inline constexpr rddl::Index basin_count = 4;  // north, lake, east, valley

// ---------------------------------------------------------------------------------- tables

// FLOWS-TO, domain.rddl:18
inline constexpr std::array<std::array<bool, basin_count>, basin_count> FLOWS_TO_ = {{
    {0, 1, 0, 0},
    {0, 0, 0, 1},
    {0, 0, 0, 1},
    {0, 0, 0, 0},
}};

// CAPACITY, domain.rddl:21
inline constexpr std::array<double, basin_count> CAPACITY_ = {100, 200, 100, 150};

// SAFE-LOW, domain.rddl:22
inline constexpr std::array<double, basin_count> SAFE_LOW_ = {20, 50, 20, 30};

// SAFE-HIGH, domain.rddl:23
inline constexpr std::array<double, basin_count> SAFE_HIGH_ = {80, 170, 80, 120};

// RAIN-CHANCE, domain.rddl:26
inline constexpr std::array<double, basin_count> RAIN_CHANCE_ = {0.5, 0.3, 0.2, 0.3};

// RAIN-SCALE, domain.rddl:28
inline constexpr std::array<double, basin_count> RAIN_SCALE_ = {6, 10, 15, 10};

// water, domain.rddl:36
inline constexpr std::array<double, basin_count> initial_water = {50, 120, 50, 60};

// draws of every step, whose numbers are made together
inline constexpr std::array step_draws = {rddl::counters_of_loop(0)};

// --------------------------------------------------------------------------------- records

template <class L>
struct State {
    std::array<typename L::Real, basin_count> water;  // domain.rddl:36
};

template <class L>
struct Action {
    std::array<typename L::Real, basin_count> release;  // domain.rddl:43
};

// Values that CPFs compute and others read, within a step.
template <class L>
struct Scratch {
    std::array<typename L::Real, basin_count> balance;  // domain.rddl:40
    std::array<typename L::Real, basin_count> spill;    // domain.rddl:41
};

template <class L>
struct Observation {};

// ------------------------------------------------------------------------------ simulator

struct Simulator {
    template <class L> using State = reservoir_reservoir_1::State<L>;
    template <class L> using Action = reservoir_reservoir_1::Action<L>;
    template <class L> using Scratch = reservoir_reservoir_1::Scratch<L>;
    template <class L> using Observation = reservoir_reservoir_1::Observation<L>;

    static constexpr bool partially_observed = false;

    // The initial state.
    template <class L>
    static void reset(State<L>& state, rddl::Context<L>& /*context*/) {
        rddl::assign(state.water, initial_water);
    }

    // All CPFs, each after those that it depends on.
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                     State<L>& next, Observation<L>& /*observation*/, rddl::Context<L>& context) {
        const rddl::StepNumbers<L, step_draws> numbers(context);
        set_balance(state, action, scratch, context, numbers);
        set_spill(scratch);
        set_water(scratch, next);
    }

    // balance(?b)  (domain.rddl:56)
    template <class L>
    static void set_balance(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                            rddl::Context<L>& context,
                            const rddl::StepNumbers<L, step_draws>& numbers) {
        using Bool = typename L::Bool;
        using Real = typename L::Real;
        for (rddl::Index b = 0; b < basin_count; ++b) {
            const Bool draw =
                rddl::sample::valid_bernoulli(context, rddl::place_in_row<0>(numbers, 0, b),
                                              RAIN_CHANCE_[b]);
            const Real term = rddl::branch(
                context, draw,
                [&] { return rddl::sample::gamma(context, {1, b}, 2.0, RAIN_SCALE_[b]); },
                [&] { return 0.0; });
            const Real total = rddl::sum<Real>(basin_count, [&](rddl::Index up) {
                return rddl::to_real(FLOWS_TO_[up][b]) * action.release[up];
            });
            scratch.balance[b] = 0.98 * state.water[b] + term + total - action.release[b];
        }
    }

    // spill(?b)  (domain.rddl:58)
    template <class L>
    static void set_spill(Scratch<L>& scratch) {
        for (rddl::Index b = 0; b < basin_count; ++b) {
            scratch.spill[b] = rddl::maximum(0.0, scratch.balance[b] - CAPACITY_[b]);
        }
    }

    // water'(?b)  (domain.rddl:60)
    template <class L>
    static void set_water(const Scratch<L>& scratch, State<L>& next) {
        for (rddl::Index b = 0; b < basin_count; ++b) {
            next.water[b] = rddl::maximum(0.0, scratch.balance[b] - scratch.spill[b]);
        }
    }

    // The reward of the step that was just made.
    template <class L>
    static typename L::Real reward(const State<L>& /*state*/, const Action<L>& /*action*/,
                                   const Scratch<L>& scratch, const State<L>& next,
                                   rddl::Context<L>& /*context*/) {
        using Real = typename L::Real;
        const Real total = rddl::sum<Real>(basin_count, [&](rddl::Index b) {
            return 5.0 * rddl::maximum(0.0, SAFE_LOW_[b] - next.water[b]) +
                   10.0 * rddl::maximum(0.0, next.water[b] - SAFE_HIGH_[b]) +
                   50.0 * scratch.spill[b];
        });
        return -total;
    }

    // Whether one of the terminations holds, so that the episode ends.
    template <class L>
    static typename L::Bool terminal(const State<L>& /*state*/, rddl::Context<L>& /*context*/) {
        return false;
    }

    // Whether the state breaks one of the invariants.
    template <class L>
    static typename L::Bool violates_invariant(const State<L>& state, rddl::Context<L>& context) {
        rddl::Invariants<L> conditions(context);
        if (conditions.go_on()) conditions.add(invariant_0(state));
        if (conditions.go_on()) conditions.add(invariant_1(state));
        return conditions.violated();
    }

    // forall_{?b : basin} [water(?b) >= 0.0]  (domain.rddl:76)
    template <class L>
    static typename L::Bool invariant_0(const State<L>& state) {
        using Bool = typename L::Bool;
        return rddl::for_all<Bool>(basin_count, [&](rddl::Index b) {
            return state.water[b] >= 0.0;
        });
    }

    // forall_{?b : basin} [water(?b) <= CAPACITY(?b)]  (domain.rddl:77)
    template <class L>
    static typename L::Bool invariant_1(const State<L>& state) {
        using Bool = typename L::Bool;
        return rddl::for_all<Bool>(basin_count, [&](rddl::Index b) {
            return state.water[b] <= CAPACITY_[b];
        });
    }

    // The first precondition that the action violates, or -1.
    template <class L>
    static typename L::Int violated_precondition(const State<L>& state, const Action<L>& action,
                                                 rddl::Context<L>& context) {
        rddl::Preconditions<L> conditions(context);
        if (conditions.go_on()) conditions.add(0, precondition_0(action));
        if (conditions.go_on()) conditions.add(1, precondition_1(state, action));
        return conditions.first_violated();
    }

    // forall_{?b : basin} [release(?b) >= 0.0]  (domain.rddl:71)
    template <class L>
    static typename L::Bool precondition_0(const Action<L>& action) {
        using Bool = typename L::Bool;
        return rddl::for_all<Bool>(basin_count, [&](rddl::Index b) {
            return action.release[b] >= 0.0;
        });
    }

    // forall_{?b : basin} [release(?b) <= water(?b)]  (domain.rddl:72)
    template <class L>
    static typename L::Bool precondition_1(const State<L>& state, const Action<L>& action) {
        using Bool = typename L::Bool;
        return rddl::for_all<Bool>(basin_count, [&](rddl::Index b) {
            return action.release[b] <= state.water[b];
        });
    }
};

// ------------------------------------------------------------------------- moderate values

// The same step with less work, for states and actions whose reals are all moderate
// (rddl/values/moderate.hpp): nothing overflows then, so terms multiplied by 0 are left out.
namespace moderate {

// ---------------------------------------------------------------------------------- tables

// FLOWS-TO-rows, domain.rddl:18
inline constexpr std::array<std::int64_t, 5> FLOWS_TO_rows_ = {0, 0, 1, 1, 3};

// FLOWS-TO-up, domain.rddl:18
inline constexpr std::array<std::int64_t, 3> FLOWS_TO_up_ = {0, 1, 2};

// draws of every step, whose numbers are made together
inline constexpr std::array step_draws = {rddl::counters_of_loop(0)};

// Values that CPFs compute and others read, within a step.
template <class L>
struct Scratch {
    std::array<typename L::Real, basin_count> balance;  // domain.rddl:40
    std::array<typename L::Real, basin_count> spill;    // domain.rddl:41
};

struct Step {
    template <class L> using Scratch = moderate::Scratch<L>;

    // Whether all reals are moderate.
    template <class L>
    static typename L::Bool is_for(const State<L>& state, const Action<L>& action) {
        return rddl::is_moderate<L>(state.water) && rddl::is_moderate<L>(action.release);
    }

    // All CPFs, each after those that it depends on.
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                     State<L>& next, Observation<L>& /*observation*/, rddl::Context<L>& context) {
        const rddl::StepNumbers<L, step_draws> numbers(context);
        set_balance(state, action, scratch, context, numbers);
        set_spill(scratch);
        set_water(scratch, next);
    }

    // balance(?b)  (domain.rddl:56)
    template <class L>
    static void set_balance(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                            rddl::Context<L>& context,
                            const rddl::StepNumbers<L, step_draws>& numbers) {
        using Bool = typename L::Bool;
        using Real = typename L::Real;
        for (rddl::Index b = 0; b < basin_count; ++b) {
            const Bool draw =
                rddl::sample::valid_bernoulli(context, rddl::place_in_row<0>(numbers, 0, b),
                                              RAIN_CHANCE_[b]);
            const Real term = rddl::branch(
                context, draw,
                [&] { return rddl::sample::gamma(context, {1, b}, 2.0, RAIN_SCALE_[b]); },
                [&] { return 0.0; });
            const Real total = rddl::sum<Real>(
                rddl::row(FLOWS_TO_rows_, b), [&](rddl::Index entry) {
                    return action.release[FLOWS_TO_up_[entry]];
                });
            scratch.balance[b] = 0.98 * state.water[b] + term + total - action.release[b];
        }
    }

    // spill(?b)  (domain.rddl:58)
    template <class L>
    static void set_spill(Scratch<L>& scratch) {
        for (rddl::Index b = 0; b < basin_count; ++b) {
            scratch.spill[b] = rddl::maximum(0.0, scratch.balance[b] - CAPACITY_[b]);
        }
    }

    // water'(?b)  (domain.rddl:60)
    template <class L>
    static void set_water(const Scratch<L>& scratch, State<L>& next) {
        for (rddl::Index b = 0; b < basin_count; ++b) {
            next.water[b] = rddl::maximum(0.0, scratch.balance[b] - scratch.spill[b]);
        }
    }

    // The reward of the step that was just made.
    template <class L>
    static typename L::Real reward(const State<L>& /*state*/, const Action<L>& /*action*/,
                                   const Scratch<L>& scratch, const State<L>& next,
                                   rddl::Context<L>& /*context*/) {
        using Real = typename L::Real;
        const Real total = rddl::sum<Real>(basin_count, [&](rddl::Index b) {
            return 5.0 * rddl::maximum(0.0, SAFE_LOW_[b] - next.water[b]) +
                   10.0 * rddl::maximum(0.0, next.water[b] - SAFE_HIGH_[b]) +
                   50.0 * scratch.spill[b];
        });
        return -total;
    }
};

}  // namespace moderate

// Makes that step where it may, else the one of Simulator.
using FastSimulator = rddl::WithModerateStep<Simulator, moderate::Step>;

static_assert(sizeof(State<rddl::Scalar>) == 32);
static_assert(sizeof(Action<rddl::Scalar>) == 32);

// --------------------------------------------------------------- description of the problem

namespace about {

inline constexpr const char* source_file = "examples/reservoir/domain.rddl";
inline constexpr const char* basin_objects[] = {"north", "lake", "east", "valley"};
inline constexpr rddl_type types[] = {{"basin", basin_objects, basin_count, 0}};
inline constexpr std::int32_t of_basin_basin[] = {0, 0};
inline constexpr std::int32_t of_basin[] = {0};
inline constexpr auto water_lower = rddl::repeated<4>(0.0);
inline constexpr std::array<double, 4> water_upper = {100, 200, 100, 150};
inline constexpr auto release_lower = rddl::repeated<4>(0.0);
inline constexpr auto release_upper = rddl::repeated<4>(std::numeric_limits<double>::infinity());

// name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, source
inline constexpr rddl_fluent fluents[] = {
    {"FLOWS-TO", RDDL_NON_FLUENT, RDDL_BOOL, -1, 2, of_basin_basin, 16, -1, nullptr, nullptr,
     {source_file, 18, 9}},
    {"CAPACITY", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_basin, 4, -1, nullptr, nullptr,
     {source_file, 21, 9}},
    {"SAFE-LOW", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_basin, 4, -1, nullptr, nullptr,
     {source_file, 22, 9}},
    {"SAFE-HIGH", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_basin, 4, -1, nullptr, nullptr,
     {source_file, 23, 9}},
    {"RAIN-CHANCE", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_basin, 4, -1, nullptr, nullptr,
     {source_file, 26, 9}},
    {"RAIN-SHAPE", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_basin, 4, -1, nullptr, nullptr,
     {source_file, 27, 9}},
    {"RAIN-SCALE", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_basin, 4, -1, nullptr, nullptr,
     {source_file, 28, 9}},
    {"EVAPORATION", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 29, 9}},
    {"LOW-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 32, 9}},
    {"HIGH-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 33, 9}},
    {"SPILL-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 34, 9}},
    {"water", RDDL_STATE, RDDL_REAL, -1, 1, of_basin, 4, offsetof(State<rddl::Scalar>, water),
     water_lower.data(), water_upper.data(), {source_file, 36, 9}},
    {"rain", RDDL_INTERM, RDDL_REAL, -1, 1, of_basin, 4, -1, nullptr, nullptr,
     {source_file, 38, 9}},
    {"inflow", RDDL_INTERM, RDDL_REAL, -1, 1, of_basin, 4, -1, nullptr, nullptr,
     {source_file, 39, 9}},
    {"balance", RDDL_INTERM, RDDL_REAL, -1, 1, of_basin, 4, -1, nullptr, nullptr,
     {source_file, 40, 9}},
    {"spill", RDDL_INTERM, RDDL_REAL, -1, 1, of_basin, 4, -1, nullptr, nullptr,
     {source_file, 41, 9}},
    {"release", RDDL_ACTION, RDDL_REAL, -1, 1, of_basin, 4, offsetof(Action<rddl::Scalar>, release),
     release_lower.data(), release_upper.data(), {source_file, 43, 9}},
};

inline constexpr rddl::Constants constants[] = {
    rddl::constants(0, FLOWS_TO_),     // FLOWS-TO
    rddl::constants(1, CAPACITY_),     // CAPACITY
    rddl::constants(2, SAFE_LOW_),     // SAFE-LOW
    rddl::constants(3, SAFE_HIGH_),    // SAFE-HIGH
    rddl::constants(4, RAIN_CHANCE_),  // RAIN-CHANCE
    rddl::constant<double>(5, 2.0),    // RAIN-SHAPE
    rddl::constants(6, RAIN_SCALE_),   // RAIN-SCALE
    rddl::constant<double>(7, 0.02),   // EVAPORATION
    rddl::constant<double>(8, 5.0),    // LOW-COST
    rddl::constant<double>(9, 10.0),   // HIGH-COST
    rddl::constant<double>(10, 50.0),  // SPILL-COST
};

inline constexpr rddl_condition preconditions[] = {
    {"forall_{?b : basin} [release(?b) >= 0.0]", {source_file, 71, 9}},
    {"forall_{?b : basin} [release(?b) <= water(?b)]", {source_file, 72, 9}},
};

inline constexpr rddl_condition invariants[] = {
    {"forall_{?b : basin} [water(?b) >= 0.0]", {source_file, 76, 9}},
    {"forall_{?b : basin} [water(?b) <= CAPACITY(?b)]", {source_file, 77, 9}},
};

inline constexpr Action<rddl::Scalar> default_action = [] {
    Action<rddl::Scalar> action{};
    rddl::assign(action.release, 0.0);
    return action;
}();

inline constexpr rddl_problem problem = {
    .struct_size = sizeof(rddl_problem),
    .type_size = sizeof(rddl_type),
    .fluent_size = sizeof(rddl_fluent),
    .condition_size = sizeof(rddl_condition),
    .domain = "reservoir",
    .instance = "reservoir_1",
    .types = types,
    .type_count = 1,
    .fluents = fluents,
    .fluent_count = 17,
    .state_size = sizeof(State<rddl::Scalar>),
    .action_size = sizeof(Action<rddl::Scalar>),
    .observation_size = sizeof(State<rddl::Scalar>),
    .interm_size = 0,
    .partially_observed = 0,
    .stochastic = 1,
    .default_action = &default_action,
    .horizon = 120,
    .discount = 1.0,
    .max_nondef_actions = -1,
    .preconditions = preconditions,
    .precondition_count = 2,
    .invariants = invariants,
    .invariant_count = 2,
    .terminations = nullptr,
    .termination_count = 0,
    .fingerprint = 0x427c050fd0c49cd2,
};

inline constexpr rddl::SiteVariable scope_b[] = {{"b", &types[0]}};

inline constexpr rddl::Site sites[] = {
    {{source_file, 49, 24}, "Bernoulli", scope_b},
    {{source_file, 50, 25}, "Gamma", scope_b},
};

}  // namespace about

inline const rddl_simulator* simulator() {
    using Engine = rddl::Compiled<FastSimulator, about::problem>;
    using Packed = rddl::Packed<FastSimulator, about::problem, 16>;
    constexpr rddl::About description{about::problem, about::sites, about::constants};
    static const rddl::SimulatorTable<Engine, Packed> table(description, Engine());
    return table.get();
}

}  // namespace
}  // namespace rddl_simulators::reservoir_reservoir_1

#ifndef RDDL_ENTRY
#define RDDL_ENTRY rddl_simulator_reservoir_reservoir_1
#endif

extern "C" RDDL_EXPORT const rddl_simulator* RDDL_ENTRY(void) {
    return rddl_simulators::reservoir_reservoir_1::simulator();
}
