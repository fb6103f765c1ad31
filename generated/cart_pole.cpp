// A simulator, made by rddlc 0.2.0. Do not edit it: change its sources and compile them again.
//
//     problem   cart_pole
//     instance  cart_pole_1
//     sources   examples/cart_pole/domain.rddl
//               examples/cart_pole/instance.rddl
//
// Compile it with -std=c++20 -O3 -ffp-contract=off and rddlc's include folder; g++ also needs
// -fno-tree-loop-distribute-patterns. Link it and call the extern "C" function
//
//     rddl_simulator_cart_pole_cart_pole_1
//
// or make a shared object for dlopen with -shared -fPIC -DRDDL_ENTRY=rddl_simulator_entry.
// <rddl/simulator.h> describes the rddl_simulator that it returns.

#include <rddl/simulator.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl_simulators::cart_pole_cart_pole_1 {
// Unnamed, so that two versions of a simulator can be loaded into one program.
namespace {

// --------------------------------------------------------------------------------- records

template <class L>
struct State {
    typename L::Real position;      // domain.rddl:26
    typename L::Real velocity;      // domain.rddl:27
    typename L::Real angle;         // domain.rddl:28
    typename L::Real angle_change;  // domain.rddl:29
};

template <class L>
struct Action {
    typename L::Bool push_right;  // domain.rddl:38
};

// Values that CPFs compute and others read, within a step.
template <class L>
struct Scratch {
    typename L::Real friction;   // domain.rddl:32
    typename L::Real drive;      // domain.rddl:33
    typename L::Real turn;       // domain.rddl:34
    typename L::Real pressure;   // domain.rddl:35
    typename L::Real speed_up;   // domain.rddl:36
    typename L::Real cos_angle;  // domain.rddl:49
    typename L::Real sin_angle;  // domain.rddl:49
};

template <class L>
struct Observation {};

// ------------------------------------------------------------------------------ simulator

struct Simulator {
    template <class L> using State = cart_pole_cart_pole_1::State<L>;
    template <class L> using Action = cart_pole_cart_pole_1::Action<L>;
    template <class L> using Scratch = cart_pole_cart_pole_1::Scratch<L>;
    template <class L> using Observation = cart_pole_cart_pole_1::Observation<L>;

    static constexpr bool partially_observed = false;

    // The initial state.
    template <class L>
    static void reset(State<L>& state, rddl::Context<L>& /*context*/) {
        state.position = 0.0;
        state.velocity = 0.0;
        state.angle = 0.02;
        state.angle_change = 0.0;
    }

    // All CPFs, each after those that it depends on.
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                     State<L>& next, Observation<L>& /*observation*/,
                     rddl::Context<L>& /*context*/) {
        set_angle(state, next);
        set_friction(state, scratch);
        set_position(state, next);
        set_drive(state, action, scratch);
        set_turn(state, scratch);
        set_angle_change(state, scratch, next);
        set_pressure(state, scratch);
        set_speed_up(state, action, scratch);
        set_velocity(state, scratch, next);
    }

    // angle'  (domain.rddl:76)
    template <class L>
    static void set_angle(const State<L>& state, State<L>& next) {
        next.angle = state.angle + 0.02 * state.angle_change;
    }

    // friction  (domain.rddl:47)
    template <class L>
    static void set_friction(const State<L>& state, Scratch<L>& scratch) {
        scratch.friction = 5e-04 * rddl::to_real(rddl::sign(state.velocity));
    }

    // position'  (domain.rddl:74)
    template <class L>
    static void set_position(const State<L>& state, State<L>& next) {
        next.position = state.position + 0.02 * state.velocity;
    }

    // drive  (domain.rddl:49)
    template <class L>
    static void set_drive(const State<L>& state, const Action<L>& action, Scratch<L>& scratch) {
        using Bool = typename L::Bool;
        using Real = typename L::Real;
        scratch.sin_angle = rddl::sin(state.angle);
        scratch.cos_angle = rddl::cos(state.angle);
        const Real term = scratch.friction * scratch.cos_angle;
        const Real term_2 =
            scratch.sin_angle + rddl::select(scratch.friction == 0.0, scratch.friction, term);
        const Bool condition = 0.05 * (state.angle_change * state.angle_change) == 0.0;
        const Real term_3 = 0.05 * (state.angle_change * state.angle_change);
        const Real term_4 =
            rddl::select(action.push_right, 10.0, -10.0) +
            rddl::select(condition, term_3, term_3 * term_2);
        scratch.drive = term_4 / 1.1;
    }

    // turn  (domain.rddl:55)
    template <class L>
    static void set_turn(const State<L>& state, Scratch<L>& scratch) {
        using Real = typename L::Real;
        const Real term = scratch.cos_angle * (scratch.drive - scratch.friction * 9.8);
        const Real term_2 =
            9.8 * scratch.sin_angle -
            rddl::select(scratch.cos_angle == 0.0, scratch.cos_angle, term) -
            2e-06 * state.angle_change / 0.05;
        const Real term_3 = 0.1 * scratch.cos_angle * (scratch.cos_angle - scratch.friction);
        const Real term_4 =
            rddl::select(0.1 * scratch.cos_angle == 0.0, 0.1 * scratch.cos_angle, term_3) / 1.1;
        scratch.turn = term_2 / (0.5 * (1.3333333333333333 - term_4));
    }

    // angle-change'  (domain.rddl:77)
    template <class L>
    static void set_angle_change(const State<L>& state, const Scratch<L>& scratch, State<L>& next) {
        next.angle_change = state.angle_change + 0.02 * scratch.turn;
    }

    // pressure  (domain.rddl:64)
    template <class L>
    static void set_pressure(const State<L>& state, Scratch<L>& scratch) {
        using Bool = typename L::Bool;
        using Real = typename L::Real;
        const Bool condition = state.angle_change * state.angle_change == 0.0;
        const Real term = state.angle_change * state.angle_change * scratch.cos_angle;
        const Real term_2 =
            rddl::select(scratch.turn == 0.0, scratch.turn, scratch.turn * scratch.sin_angle);
        const Real term_3 =
            term_2 + rddl::select(condition, state.angle_change * state.angle_change, term);
        scratch.pressure = 10.780000000000001 - 0.05 * term_3;
    }

    // speed-up  (domain.rddl:68)
    template <class L>
    static void set_speed_up(const State<L>& state, const Action<L>& action, Scratch<L>& scratch) {
        using Bool = typename L::Bool;
        using Real = typename L::Real;
        const Bool condition = state.angle_change * state.angle_change == 0.0;
        const Real term = state.angle_change * state.angle_change * scratch.sin_angle;
        const Real term_2 = rddl::select(condition, state.angle_change * state.angle_change, term);
        const Real term_3 =
            rddl::select(scratch.turn == 0.0, scratch.turn, scratch.turn * scratch.cos_angle);
        const Real term_4 = scratch.friction * scratch.pressure;
        const Real term_5 =
            rddl::select(action.push_right, 10.0, -10.0) + 0.05 * (term_2 - term_3) -
            rddl::select(scratch.pressure == 0.0, scratch.pressure, term_4);
        scratch.speed_up = term_5 / 1.1;
    }

    // velocity'  (domain.rddl:75)
    template <class L>
    static void set_velocity(const State<L>& state, const Scratch<L>& scratch, State<L>& next) {
        next.velocity = state.velocity + 0.02 * scratch.speed_up;
    }

    // The reward of the step that was just made.
    template <class L>
    static typename L::Real reward(const State<L>& /*state*/, const Action<L>& /*action*/,
                                   const Scratch<L>& /*scratch*/, const State<L>& next,
                                   rddl::Context<L>& /*context*/) {
        using Bool = typename L::Bool;
        const Bool condition =
            rddl::absolute(next.position) <= 2.4 && rddl::absolute(next.angle) <= 0.2094384;
        return rddl::to_real(condition);
    }

    // Whether one of the terminations holds, so that the episode ends.
    template <class L>
    static typename L::Bool terminal(const State<L>& state, rddl::Context<L>& /*context*/) {
        rddl::Terminations<L> conditions;
        conditions.add(termination_0(state));
        conditions.add(termination_1(state));
        return conditions.hold();
    }

    // abs[position] > TRACK-LIMIT  (domain.rddl:84)
    template <class L>
    static typename L::Bool termination_0(const State<L>& state) {
        return rddl::absolute(state.position) > 2.4;
    }

    // abs[angle] > ANGLE-LIMIT  (domain.rddl:85)
    template <class L>
    static typename L::Bool termination_1(const State<L>& state) {
        return rddl::absolute(state.angle) > 0.2094384;
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
static_assert(offsetof(State<rddl::Scalar>, angle_change) == 24);
static_assert(sizeof(Action<rddl::Scalar>) == 1);

// --------------------------------------------------------------- description of the problem

namespace about {

inline constexpr const char* source_file = "examples/cart_pole/domain.rddl";

// name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, source
inline constexpr rddl_fluent fluents[] = {
    {"GRAVITY", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 13, 9}},
    {"CART-MASS", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 14, 9}},
    {"POLE-MASS", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 15, 9}},
    {"POLE-LENGTH", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 16, 9}},
    {"CART-FRICTION", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 17, 9}},
    {"POLE-FRICTION", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 18, 9}},
    {"PUSH-FORCE", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 19, 9}},
    {"TIME-STEP", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 20, 9}},
    {"TRACK-LIMIT", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 23, 9}},
    {"ANGLE-LIMIT", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 24, 9}},
    {"position", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1, offsetof(State<rddl::Scalar>, position),
     nullptr, nullptr, {source_file, 26, 9}},
    {"velocity", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1, offsetof(State<rddl::Scalar>, velocity),
     nullptr, nullptr, {source_file, 27, 9}},
    {"angle", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1, offsetof(State<rddl::Scalar>, angle),
     nullptr, nullptr, {source_file, 28, 9}},
    {"angle-change", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1,
     offsetof(State<rddl::Scalar>, angle_change), nullptr, nullptr, {source_file, 29, 9}},
    {"force", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 31, 9}},
    {"friction", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 32, 9}},
    {"drive", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 33, 9}},
    {"turn", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr, {source_file, 34, 9}},
    {"pressure", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 35, 9}},
    {"speed-up", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 36, 9}},
    {"push-right", RDDL_ACTION, RDDL_BOOL, -1, 0, nullptr, 1,
     offsetof(Action<rddl::Scalar>, push_right), nullptr, nullptr, {source_file, 38, 9}},
};

inline constexpr rddl::Constants constants[] = {
    rddl::constant<double>(0, 9.8),        // GRAVITY
    rddl::constant<double>(1, 1.0),        // CART-MASS
    rddl::constant<double>(2, 0.1),        // POLE-MASS
    rddl::constant<double>(3, 0.5),        // POLE-LENGTH
    rddl::constant<double>(4, 5e-04),      // CART-FRICTION
    rddl::constant<double>(5, 2e-06),      // POLE-FRICTION
    rddl::constant<double>(6, 10.0),       // PUSH-FORCE
    rddl::constant<double>(7, 0.02),       // TIME-STEP
    rddl::constant<double>(8, 2.4),        // TRACK-LIMIT
    rddl::constant<double>(9, 0.2094384),  // ANGLE-LIMIT
};

inline constexpr rddl_condition terminations[] = {
    {"abs[position] > TRACK-LIMIT", {source_file, 84, 9}},
    {"abs[angle] > ANGLE-LIMIT", {source_file, 85, 9}},
};

inline constexpr Action<rddl::Scalar> default_action = [] {
    Action<rddl::Scalar> action{};
    action.push_right = false;
    return action;
}();

inline constexpr rddl_problem problem = {
    .struct_size = sizeof(rddl_problem),
    .type_size = sizeof(rddl_type),
    .fluent_size = sizeof(rddl_fluent),
    .condition_size = sizeof(rddl_condition),
    .domain = "cart_pole",
    .instance = "cart_pole_1",
    .types = nullptr,
    .type_count = 0,
    .fluents = fluents,
    .fluent_count = 21,
    .state_size = sizeof(State<rddl::Scalar>),
    .action_size = sizeof(Action<rddl::Scalar>),
    .observation_size = sizeof(State<rddl::Scalar>),
    .interm_size = 0,
    .partially_observed = 0,
    .stochastic = 0,
    .default_action = &default_action,
    .horizon = 500,
    .discount = 1.0,
    .max_nondef_actions = -1,
    .preconditions = nullptr,
    .precondition_count = 0,
    .invariants = nullptr,
    .invariant_count = 0,
    .terminations = terminations,
    .termination_count = 2,
    .fingerprint = 0x88335af98a238997,
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
}  // namespace rddl_simulators::cart_pole_cart_pole_1

#ifndef RDDL_ENTRY
#define RDDL_ENTRY rddl_simulator_cart_pole_cart_pole_1
#endif

extern "C" RDDL_EXPORT const rddl_simulator* RDDL_ENTRY(void) {
    return rddl_simulators::cart_pole_cart_pole_1::simulator();
}
