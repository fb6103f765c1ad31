// A simulator, made by rddlc 0.2.0. Do not edit it: change its sources and compile them again.
//
//     problem   t_maze
//     instance  t_maze_1
//     sources   examples/t_maze/domain.rddl
//               examples/t_maze/instance.rddl
//
// Compile it with -std=c++20 -O3 -ffp-contract=off and rddlc's include folder; g++ also needs
// -fno-tree-loop-distribute-patterns. Link it and call the extern "C" function
//
//     rddl_simulator_t_maze_t_maze_1
//
// or make a shared object for dlopen with -shared -fPIC -DRDDL_ENTRY=rddl_simulator_entry.
// <rddl/simulator.h> describes the rddl_simulator that it returns.

#include <rddl/simulator.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl_simulators::t_maze_t_maze_1 {
// Unnamed, so that two versions of a simulator can be loaded into one program.
namespace {

// --------------------------------------------------------------------------------- records

template <class L>
struct State {
    typename L::Bool inside;        // domain.rddl:19
    typename L::Bool goal_is_left;  // domain.rddl:20
    typename L::Int place;          // domain.rddl:21
    typename L::Bool has_turned;    // domain.rddl:22
};

template <class L>
struct Action {
    typename L::Bool turn_left;   // domain.rddl:33
    typename L::Bool turn_right;  // domain.rddl:34
};

// Values that CPFs compute and others read, within a step.
template <class L>
struct Scratch {
    typename L::Bool turns;  // domain.rddl:26
};

template <class L>
struct Observation {
    typename L::Bool sign_says_left;   // domain.rddl:29
    typename L::Bool sign_says_right;  // domain.rddl:30
    typename L::Bool at_junction;      // domain.rddl:31
};

// ------------------------------------------------------------------------------ simulator

struct Simulator {
    template <class L> using State = t_maze_t_maze_1::State<L>;
    template <class L> using Action = t_maze_t_maze_1::Action<L>;
    template <class L> using Scratch = t_maze_t_maze_1::Scratch<L>;
    template <class L> using Observation = t_maze_t_maze_1::Observation<L>;

    static constexpr bool partially_observed = true;

    // The initial state.
    template <class L>
    static void reset(State<L>& state, rddl::Context<L>& /*context*/) {
        state.inside = false;
        state.goal_is_left = false;
        state.place = 0;
        state.has_turned = false;
    }

    // All CPFs, each after those that it depends on.
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                     State<L>& next, Observation<L>& observation, rddl::Context<L>& context) {
        set_goal_is_left(state, next, context);
        set_inside(next);
        set_place(state, next);
        set_sign_says_left(state, next, observation);
        set_sign_says_right(state, next, observation);
        set_turns(state, action, scratch);
        set_at_junction(next, observation);
        set_has_turned(scratch, next);
    }

    // goal-is-left'  (domain.rddl:44)
    template <class L>
    static void set_goal_is_left(const State<L>& state, State<L>& next, rddl::Context<L>& context) {
        next.goal_is_left = rddl::branch(
            context, state.inside,
            [&] { return state.goal_is_left; },
            [&] { return rddl::sample::bernoulli(context, rddl::LonePlace{0, 0}, 0.5); });
    }

    // inside'  (domain.rddl:43)
    template <class L>
    static void set_inside(State<L>& next) {
        next.inside = true;
    }

    // place'  (domain.rddl:45)
    template <class L>
    static void set_place(const State<L>& state, State<L>& next) {
        using Bool = typename L::Bool;
        const Bool condition = state.inside && state.place != 10;
        next.place = rddl::select(condition, rddl::wrap_add(state.place, 1), state.place);
    }

    // sign-says-left  (domain.rddl:49)
    template <class L>
    static void set_sign_says_left(const State<L>& state, const State<L>& next,
                                   Observation<L>& observation) {
        observation.sign_says_left = !state.inside && next.goal_is_left;
    }

    // sign-says-right  (domain.rddl:50)
    template <class L>
    static void set_sign_says_right(const State<L>& state, const State<L>& next,
                                    Observation<L>& observation) {
        observation.sign_says_right = !state.inside && !next.goal_is_left;
    }

    // turns  (domain.rddl:41)
    template <class L>
    static void set_turns(const State<L>& state, const Action<L>& action, Scratch<L>& scratch) {
        scratch.turns =
            state.inside && state.place == 10 && (action.turn_left || action.turn_right);
    }

    // at-junction  (domain.rddl:51)
    template <class L>
    static void set_at_junction(const State<L>& next, Observation<L>& observation) {
        observation.at_junction = next.place == 10;
    }

    // has-turned'  (domain.rddl:46)
    template <class L>
    static void set_has_turned(const Scratch<L>& scratch, State<L>& next) {
        next.has_turned = scratch.turns;
    }

    // The reward of the step that was just made.
    template <class L>
    static typename L::Real reward(const State<L>& state, const Action<L>& action,
                                   const Scratch<L>& scratch, const State<L>& /*next*/,
                                   rddl::Context<L>& /*context*/) {
        using Real = typename L::Real;
        const Real term = rddl::select(action.turn_left == state.goal_is_left, 4.0, -0.1);
        return rddl::select(scratch.turns, term, rddl::select(state.place == 10, -0.1, 0.0));
    }

    // Whether one of the terminations holds, so that the episode ends.
    template <class L>
    static typename L::Bool terminal(const State<L>& state, rddl::Context<L>& /*context*/) {
        rddl::Terminations<L> conditions;
        conditions.add(termination_0(state));
        return conditions.hold();
    }

    // has-turned  (domain.rddl:59)
    template <class L>
    static typename L::Bool termination_0(const State<L>& state) {
        return state.has_turned;
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

static_assert(sizeof(State<rddl::Scalar>) == 24);
static_assert(offsetof(State<rddl::Scalar>, has_turned) == 16);
static_assert(sizeof(Action<rddl::Scalar>) == 2);
static_assert(offsetof(Action<rddl::Scalar>, turn_right) == 1);
static_assert(sizeof(Observation<rddl::Scalar>) == 3);
static_assert(offsetof(Observation<rddl::Scalar>, at_junction) == 2);

// --------------------------------------------------------------- description of the problem

namespace about {

inline constexpr const char* source_file = "examples/t_maze/domain.rddl";

// name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, source
inline constexpr rddl_fluent fluents[] = {
    {"CORRIDOR", RDDL_NON_FLUENT, RDDL_INT, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 13, 9}},
    {"GOAL-REWARD", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 14, 9}},
    {"MISS-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 15, 9}},
    {"WAIT-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 16, 9}},
    {"inside", RDDL_STATE, RDDL_BOOL, -1, 0, nullptr, 1, offsetof(State<rddl::Scalar>, inside),
     nullptr, nullptr, {source_file, 19, 9}},
    {"goal-is-left", RDDL_STATE, RDDL_BOOL, -1, 0, nullptr, 1,
     offsetof(State<rddl::Scalar>, goal_is_left), nullptr, nullptr, {source_file, 20, 9}},
    {"place", RDDL_STATE, RDDL_INT, -1, 0, nullptr, 1, offsetof(State<rddl::Scalar>, place),
     nullptr, nullptr, {source_file, 21, 9}},
    {"has-turned", RDDL_STATE, RDDL_BOOL, -1, 0, nullptr, 1,
     offsetof(State<rddl::Scalar>, has_turned), nullptr, nullptr, {source_file, 22, 9}},
    {"enters", RDDL_INTERM, RDDL_BOOL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 24, 9}},
    {"at-end", RDDL_INTERM, RDDL_BOOL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 25, 9}},
    {"turns", RDDL_INTERM, RDDL_BOOL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 26, 9}},
    {"sign-says-left", RDDL_OBSERVATION, RDDL_BOOL, -1, 0, nullptr, 1,
     offsetof(Observation<rddl::Scalar>, sign_says_left), nullptr, nullptr, {source_file, 29, 9}},
    {"sign-says-right", RDDL_OBSERVATION, RDDL_BOOL, -1, 0, nullptr, 1,
     offsetof(Observation<rddl::Scalar>, sign_says_right), nullptr, nullptr, {source_file, 30, 9}},
    {"at-junction", RDDL_OBSERVATION, RDDL_BOOL, -1, 0, nullptr, 1,
     offsetof(Observation<rddl::Scalar>, at_junction), nullptr, nullptr, {source_file, 31, 9}},
    {"turn-left", RDDL_ACTION, RDDL_BOOL, -1, 0, nullptr, 1,
     offsetof(Action<rddl::Scalar>, turn_left), nullptr, nullptr, {source_file, 33, 9}},
    {"turn-right", RDDL_ACTION, RDDL_BOOL, -1, 0, nullptr, 1,
     offsetof(Action<rddl::Scalar>, turn_right), nullptr, nullptr, {source_file, 34, 9}},
};

inline constexpr rddl::Constants constants[] = {
    rddl::constant<std::int64_t>(0, 10),  // CORRIDOR
    rddl::constant<double>(1, 4.0),       // GOAL-REWARD
    rddl::constant<double>(2, 0.1),       // MISS-COST
    rddl::constant<double>(3, 0.1),       // WAIT-COST
};

inline constexpr rddl_condition terminations[] = {{"has-turned", {source_file, 59, 9}}};

inline constexpr Action<rddl::Scalar> default_action = [] {
    Action<rddl::Scalar> action{};
    action.turn_left = false;
    action.turn_right = false;
    return action;
}();

inline constexpr rddl_problem problem = {
    .struct_size = sizeof(rddl_problem),
    .type_size = sizeof(rddl_type),
    .fluent_size = sizeof(rddl_fluent),
    .condition_size = sizeof(rddl_condition),
    .domain = "t_maze",
    .instance = "t_maze_1",
    .types = nullptr,
    .type_count = 0,
    .fluents = fluents,
    .fluent_count = 16,
    .state_size = sizeof(State<rddl::Scalar>),
    .action_size = sizeof(Action<rddl::Scalar>),
    .observation_size = sizeof(Observation<rddl::Scalar>),
    .interm_size = 0,
    .partially_observed = 1,
    .stochastic = 1,
    .default_action = &default_action,
    .horizon = 40,
    .discount = 1.0,
    .max_nondef_actions = 1,
    .preconditions = nullptr,
    .precondition_count = 0,
    .invariants = nullptr,
    .invariant_count = 0,
    .terminations = terminations,
    .termination_count = 1,
    .fingerprint = 0xf2eeac6efe15191f,
};

inline constexpr rddl::Site sites[] = {{{source_file, 44, 60}, "Bernoulli", {}}};

}  // namespace about

inline const rddl_simulator* simulator() {
    using Engine = rddl::Compiled<Simulator, about::problem>;
    using Packed = rddl::Packed<Simulator, about::problem, 16>;
    constexpr rddl::About description{about::problem, about::sites, about::constants};
    static const rddl::SimulatorTable<Engine, Packed> table(description, Engine());
    return table.get();
}

}  // namespace
}  // namespace rddl_simulators::t_maze_t_maze_1

#ifndef RDDL_ENTRY
#define RDDL_ENTRY rddl_simulator_t_maze_t_maze_1
#endif

extern "C" RDDL_EXPORT const rddl_simulator* RDDL_ENTRY(void) {
    return rddl_simulators::t_maze_t_maze_1::simulator();
}
