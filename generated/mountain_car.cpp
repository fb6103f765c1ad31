// A simulator, made by rddlc 0.2.0. Do not edit it: change its sources and compile them again.
//
//     problem   mountain_car
//     instance  mountain_car_1
//     sources   examples/mountain_car/domain.rddl
//               examples/mountain_car/instance.rddl
//
// Compile it with -std=c++20 -O3 -ffp-contract=off and rddlc's include folder; g++ also needs
// -fno-tree-loop-distribute-patterns. Link it and call the extern "C" function
//
//     rddl_simulator_mountain_car_mountain_car_1
//
// or make a shared object for dlopen with -shared -fPIC -DRDDL_ENTRY=rddl_simulator_entry.
// <rddl/simulator.h> describes the rddl_simulator that it returns.

#include <rddl/simulator.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl_simulators::mountain_car_mountain_car_1 {
// Unnamed, so that two versions of a simulator can be loaded into one program.
namespace {

// --------------------------------------------------------------------------------- objects

inline constexpr rddl::Index segment_count = 9;  // s1, s2, s3, s4, s5, s6, s7, s8, s9

// ---------------------------------------------------------------------------------- tables

// position-breaks, domain.rddl:66
inline constexpr std::array<double, 9> position_breaks_ = {
    -1.2, -1, -0.8, -0.6, -0.4, -0.2, 0.2, 0.4, 0.6
};

// position-values, domain.rddl:66
inline constexpr std::array<double, 10> position_values_ = {
    0, -2.9200000000000004, -2.670000000000001, -1.4949999999999992, 0.2099999999999997,
    1.8350000000000004, 2.8249999999999997, 1.8350000000000004, 0.2099999999999997, 0
};

// --------------------------------------------------------------------------------- records

template <class L>
struct State {
    typename L::Real position;  // domain.rddl:39
    typename L::Real velocity;  // domain.rddl:40
};

template <class L>
struct Action {
    typename L::Real throttle;  // domain.rddl:45
};

// Values that CPFs compute and others read, within a step.
template <class L>
struct Scratch {
    typename L::Real slope;  // domain.rddl:42
    typename L::Real speed;  // domain.rddl:43
};

template <class L>
struct Observation {};

// ------------------------------------------------------------------------------ simulator

struct Simulator {
    template <class L> using State = mountain_car_mountain_car_1::State<L>;
    template <class L> using Action = mountain_car_mountain_car_1::Action<L>;
    template <class L> using Scratch = mountain_car_mountain_car_1::Scratch<L>;
    template <class L> using Observation = mountain_car_mountain_car_1::Observation<L>;

    static constexpr bool partially_observed = false;

    // The initial state.
    template <class L>
    static void reset(State<L>& state, rddl::Context<L>& /*context*/) {
        state.position = -0.5;
        state.velocity = 0.0;
    }

    // All CPFs, each after those that it depends on.
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                     State<L>& next, Observation<L>& /*observation*/,
                     rddl::Context<L>& /*context*/) {
        set_slope(state, scratch);
        set_speed(state, action, scratch);
        set_position(state, scratch, next);
        set_velocity(scratch, next);
    }

    // slope  (domain.rddl:52)
    template <class L>
    static void set_slope(const State<L>& state, Scratch<L>& scratch) {
        using Int = typename L::Int;
        scratch.slope =
            rddl::at(position_values_, rddl::search<position_breaks_, Int>(state.position));
    }

    // speed  (domain.rddl:57)
    template <class L>
    static void set_speed(const State<L>& state, const Action<L>& action, Scratch<L>& scratch) {
        using Real = typename L::Real;
        const Real term = state.velocity + 0.0015 * action.throttle - 0.00083333 * scratch.slope;
        scratch.speed = rddl::maximum(-0.07, rddl::minimum(0.07, term));
    }

    // position'  (domain.rddl:59)
    template <class L>
    static void set_position(const State<L>& state, const Scratch<L>& scratch, State<L>& next) {
        next.position = rddl::maximum(-1.2, state.position + scratch.speed);
    }

    // velocity'  (domain.rddl:62)
    template <class L>
    static void set_velocity(const Scratch<L>& scratch, State<L>& next) {
        next.velocity =
            rddl::select(next.position <= -1.2 && scratch.speed < 0.0, 0.0, scratch.speed);
    }

    // The reward of the step that was just made.
    template <class L>
    static typename L::Real reward(const State<L>& /*state*/, const Action<L>& action,
                                   const Scratch<L>& /*scratch*/, const State<L>& next,
                                   rddl::Context<L>& /*context*/) {
        return 100.0 * rddl::to_real(next.position >= 0.5) -
               0.1 * (action.throttle * action.throttle);
    }

    // Whether one of the terminations holds, so that the episode ends.
    template <class L>
    static typename L::Bool terminal(const State<L>& state, rddl::Context<L>& /*context*/) {
        rddl::Terminations<L> conditions;
        conditions.add(termination_0(state));
        return conditions.hold();
    }

    // position >= FLAG  (domain.rddl:70)
    template <class L>
    static typename L::Bool termination_0(const State<L>& state) {
        return state.position >= 0.5;
    }

    // Whether the state breaks one of the invariants.
    template <class L>
    static typename L::Bool violates_invariant(const State<L>& /*state*/,
                                               rddl::Context<L>& /*context*/) {
        return false;
    }

    // The first precondition that the action violates, or -1.
    template <class L>
    static typename L::Int violated_precondition(const State<L>& /*state*/, const Action<L>& action,
                                                 rddl::Context<L>& context) {
        rddl::Preconditions<L> conditions(context);
        if (conditions.go_on()) conditions.add(0, precondition_0(action));
        if (conditions.go_on()) conditions.add(1, precondition_1(action));
        return conditions.first_violated();
    }

    // throttle >= -1.0  (domain.rddl:75)
    template <class L>
    static typename L::Bool precondition_0(const Action<L>& action) {
        return action.throttle >= -1.0;
    }

    // throttle <= 1.0  (domain.rddl:76)
    template <class L>
    static typename L::Bool precondition_1(const Action<L>& action) {
        return action.throttle <= 1.0;
    }
};

static_assert(sizeof(State<rddl::Scalar>) == 16);
static_assert(offsetof(State<rddl::Scalar>, velocity) == 8);
static_assert(sizeof(Action<rddl::Scalar>) == 8);

// --------------------------------------------------------------- description of the problem

namespace about {

inline constexpr const char* source_file = "examples/mountain_car/domain.rddl";

inline constexpr const char* segment_objects[] = {"s1", "s2", "s3", "s4", "s5", "s6", "s7", "s8",
                                                  "s9"};

inline constexpr rddl_type types[] = {{"segment", segment_objects, segment_count, 0}};
inline constexpr std::int32_t of_segment[] = {0};
inline constexpr std::array<double, 1> throttle_lower = {-1};
inline constexpr std::array<double, 1> throttle_upper = {1};

// name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, source
inline constexpr rddl_fluent fluents[] = {
    {"LEFT-X", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_segment, 9, -1, nullptr, nullptr,
     {source_file, 21, 9}},
    {"LEFT-Y", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_segment, 9, -1, nullptr, nullptr,
     {source_file, 22, 9}},
    {"RIGHT-X", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_segment, 9, -1, nullptr, nullptr,
     {source_file, 23, 9}},
    {"RIGHT-Y", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_segment, 9, -1, nullptr, nullptr,
     {source_file, 24, 9}},
    {"WALL", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 27, 9}},
    {"FLAG", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 28, 9}},
    {"POWER", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 31, 9}},
    {"GRAVITY", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 32, 9}},
    {"MAX-SPEED", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 33, 9}},
    {"FUEL-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 36, 9}},
    {"FLAG-REWARD", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 37, 9}},
    {"position", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1, offsetof(State<rddl::Scalar>, position),
     nullptr, nullptr, {source_file, 39, 9}},
    {"velocity", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1, offsetof(State<rddl::Scalar>, velocity),
     nullptr, nullptr, {source_file, 40, 9}},
    {"slope", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 42, 9}},
    {"speed", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 43, 9}},
    {"throttle", RDDL_ACTION, RDDL_REAL, -1, 0, nullptr, 1,
     offsetof(Action<rddl::Scalar>, throttle), throttle_lower.data(), throttle_upper.data(),
     {source_file, 45, 9}},
};

inline constexpr std::array<double, 9> LEFT_X_values_ = {
    -1.2, -1, -0.8, -0.6, -0.4, -0.2, 0, 0.2, 0.4
};

inline constexpr std::array<double, 9> LEFT_Y_values_ = {
    0.443, -0.141, -0.675, -0.974, -0.932, -0.565, 0, 0.565, 0.932
};

inline constexpr std::array<double, 9> RIGHT_X_values_ = {
    -1, -0.8, -0.6, -0.4, -0.2, 0, 0.2, 0.4, 0.6
};

inline constexpr std::array<double, 9> RIGHT_Y_values_ = {
    -0.141, -0.675, -0.974, -0.932, -0.565, 0, 0.565, 0.932, 0.974
};

inline constexpr rddl::Constants constants[] = {
    rddl::constants(0, LEFT_X_values_),     // LEFT-X
    rddl::constants(1, LEFT_Y_values_),     // LEFT-Y
    rddl::constants(2, RIGHT_X_values_),    // RIGHT-X
    rddl::constants(3, RIGHT_Y_values_),    // RIGHT-Y
    rddl::constant<double>(4, -1.2),        // WALL
    rddl::constant<double>(5, 0.5),         // FLAG
    rddl::constant<double>(6, 0.0015),      // POWER
    rddl::constant<double>(7, 0.00083333),  // GRAVITY
    rddl::constant<double>(8, 0.07),        // MAX-SPEED
    rddl::constant<double>(9, 0.1),         // FUEL-COST
    rddl::constant<double>(10, 100.0),      // FLAG-REWARD
};

inline constexpr rddl_condition preconditions[] = {
    {"throttle >= -1.0", {source_file, 75, 9}},
    {"throttle <= 1.0", {source_file, 76, 9}},
};

inline constexpr rddl_condition terminations[] = {{"position >= FLAG", {source_file, 70, 9}}};

inline constexpr Action<rddl::Scalar> default_action = [] {
    Action<rddl::Scalar> action{};
    action.throttle = 0.0;
    return action;
}();

inline constexpr rddl_problem problem = {
    .struct_size = sizeof(rddl_problem),
    .type_size = sizeof(rddl_type),
    .fluent_size = sizeof(rddl_fluent),
    .condition_size = sizeof(rddl_condition),
    .domain = "mountain_car",
    .instance = "mountain_car_1",
    .types = types,
    .type_count = 1,
    .fluents = fluents,
    .fluent_count = 16,
    .state_size = sizeof(State<rddl::Scalar>),
    .action_size = sizeof(Action<rddl::Scalar>),
    .observation_size = sizeof(State<rddl::Scalar>),
    .interm_size = 0,
    .partially_observed = 0,
    .stochastic = 0,
    .default_action = &default_action,
    .horizon = 200,
    .discount = 1.0,
    .max_nondef_actions = -1,
    .preconditions = preconditions,
    .precondition_count = 2,
    .invariants = nullptr,
    .invariant_count = 0,
    .terminations = terminations,
    .termination_count = 1,
    .fingerprint = 0x6b7acb7a3ddd0487,
};

}  // namespace about

inline const rddl_simulator* simulator() {
    using Engine = rddl::Compiled<Simulator, about::problem>;
    using Packed = rddl::Packed<Simulator, about::problem, 16>;
    constexpr rddl::About description{about::problem, {}, about::constants};
    static const rddl::SimulatorTable<Engine, Packed> table(description, Engine());
    return table.get();
}

}  // namespace
}  // namespace rddl_simulators::mountain_car_mountain_car_1

#ifndef RDDL_ENTRY
#define RDDL_ENTRY rddl_simulator_mountain_car_mountain_car_1
#endif

extern "C" RDDL_EXPORT const rddl_simulator* RDDL_ENTRY(void) {
    return rddl_simulators::mountain_car_mountain_car_1::simulator();
}
