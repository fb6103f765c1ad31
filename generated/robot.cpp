// A simulator, made by rddlc 0.2.0. Do not edit it: change its sources and compile them again.
//
//     problem   robot
//     instance  robot_1
//     sources   examples/robot/domain.rddl
//               examples/robot/instance.rddl
//
// Compile it with -std=c++20 -O3 -ffp-contract=off and rddlc's include folder; g++ also needs
// -fno-tree-loop-distribute-patterns. Link it and call the extern "C" function
//
//     rddl_simulator_robot_robot_1
//
// or make a shared object for dlopen with -shared -fPIC -DRDDL_ENTRY=rddl_simulator_entry.
// <rddl/simulator.h> describes the rddl_simulator that it returns.

#include <rddl/simulator.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl_simulators::robot_robot_1 {
// Unnamed, so that two versions of a simulator can be loaded into one program.
namespace {

// --------------------------------------------------------------------------------- objects

inline constexpr rddl::Index beacon_count = 3;  // west, south, middle

// ---------------------------------------------------------------------------------- tables

// BEACON-X, domain.rddl:17
inline constexpr std::array<double, beacon_count> BEACON_X_ = {0, 5, 6};

// BEACON-Y, domain.rddl:18
inline constexpr std::array<double, beacon_count> BEACON_Y_ = {5, 0, 6};

// draws of every step, whose numbers are made together
inline constexpr std::array step_draws = {rddl::counters_of_loop(3)};

// --------------------------------------------------------------------------------- records

template <class L>
struct State {
    typename L::Real x;        // domain.rddl:38
    typename L::Real y;        // domain.rddl:39
    typename L::Real heading;  // domain.rddl:40
};

template <class L>
struct Action {
    typename L::Real drive;  // domain.rddl:57
    typename L::Real turn;   // domain.rddl:58
};

// Values that CPFs compute and others read, within a step.
template <class L>
struct Scratch {
    typename L::Real course;                              // domain.rddl:42
    typename L::Real distance;                            // domain.rddl:43
    typename L::Real ahead_x;                             // domain.rddl:44
    typename L::Real ahead_y;                             // domain.rddl:45
    typename L::Real reached_x;                           // domain.rddl:46
    typename L::Real reached_y;                           // domain.rddl:47
    typename L::Bool hit_wall;                            // domain.rddl:48
    std::array<typename L::Real, beacon_count> range_to;  // domain.rddl:49
    std::array<typename L::Bool, beacon_count> answers;   // domain.rddl:50
};

template <class L>
struct Observation {
    std::array<typename L::Bool, beacon_count> echo;   // domain.rddl:53
    std::array<typename L::Real, beacon_count> range;  // domain.rddl:54
    typename L::Bool bump;                             // domain.rddl:55
};

// ------------------------------------------------------------------------------ simulator

struct Simulator {
    template <class L> using State = robot_robot_1::State<L>;
    template <class L> using Action = robot_robot_1::Action<L>;
    template <class L> using Scratch = robot_robot_1::Scratch<L>;
    template <class L> using Observation = robot_robot_1::Observation<L>;

    static constexpr bool partially_observed = true;

    // The initial state.
    template <class L>
    static void reset(State<L>& state, rddl::Context<L>& /*context*/) {
        state.x = 1.0;
        state.y = 1.0;
        state.heading = 0.7;
    }

    // All CPFs, each after those that it depends on.
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                     State<L>& next, Observation<L>& observation, rddl::Context<L>& context) {
        const rddl::StepNumbers<L, step_draws> numbers(context);
        set_course(state, action, scratch, context);
        set_distance(action, scratch, context);
        set_ahead_x(state, scratch);
        set_ahead_y(state, scratch);
        set_heading(scratch, next);
        set_hit_wall(scratch);
        set_reached_x(scratch);
        set_reached_y(scratch);
        set_bump(scratch, observation, context);
        set_range_to(scratch, context);
        set_x(scratch, next);
        set_y(scratch, next);
        set_answers(scratch, context, numbers);
        set_echo(scratch, observation);
        set_range(scratch, observation, context);
    }

    // course  (domain.rddl:64)
    template <class L>
    static void set_course(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                           rddl::Context<L>& context) {
        using Real = typename L::Real;
        const Real term = 0.01 * rddl::absolute(action.turn);
        scratch.course =
            state.heading + rddl::sample::normal(context, rddl::LonePlace{0, 0}, action.turn, term);
    }

    // distance  (domain.rddl:65)
    template <class L>
    static void set_distance(const Action<L>& action, Scratch<L>& scratch,
                             rddl::Context<L>& context) {
        using Real = typename L::Real;
        const Real term = 0.02 * rddl::absolute(action.drive);
        scratch.distance = rddl::sample::normal(context, rddl::LonePlace{1, 0}, action.drive, term);
    }

    // ahead-x  (domain.rddl:67)
    template <class L>
    static void set_ahead_x(const State<L>& state, Scratch<L>& scratch) {
        using Real = typename L::Real;
        const Real term = scratch.distance * rddl::cos(scratch.course);
        scratch.ahead_x = state.x + rddl::select(scratch.distance == 0.0, scratch.distance, term);
    }

    // ahead-y  (domain.rddl:68)
    template <class L>
    static void set_ahead_y(const State<L>& state, Scratch<L>& scratch) {
        using Real = typename L::Real;
        const Real term = scratch.distance * rddl::sin(scratch.course);
        scratch.ahead_y = state.y + rddl::select(scratch.distance == 0.0, scratch.distance, term);
    }

    // heading'  (domain.rddl:76)
    template <class L>
    static void set_heading(const Scratch<L>& scratch, State<L>& next) {
        next.heading = scratch.course;
    }

    // hit-wall  (domain.rddl:69)
    template <class L>
    static void set_hit_wall(Scratch<L>& scratch) {
        scratch.hit_wall =
            scratch.ahead_x < 0.0 || scratch.ahead_x > 10.0 || scratch.ahead_y < 0.0 ||
            scratch.ahead_y > 10.0;
    }

    // reached-x  (domain.rddl:71)
    template <class L>
    static void set_reached_x(Scratch<L>& scratch) {
        scratch.reached_x = rddl::maximum(0.0, rddl::minimum(10.0, scratch.ahead_x));
    }

    // reached-y  (domain.rddl:72)
    template <class L>
    static void set_reached_y(Scratch<L>& scratch) {
        scratch.reached_y = rddl::maximum(0.0, rddl::minimum(10.0, scratch.ahead_y));
    }

    // bump  (domain.rddl:88)
    template <class L>
    static void set_bump(const Scratch<L>& scratch, Observation<L>& observation,
                         rddl::Context<L>& context) {
        observation.bump = rddl::branch(
            context, scratch.hit_wall,
            [&] { return rddl::sample::bernoulli(context, rddl::LonePlace{2, 0}, 0.95); },
            [&] { return false; });
    }

    // range-to(?b)  (domain.rddl:79)
    template <class L>
    static void set_range_to(Scratch<L>& scratch, rddl::Context<L>& context) {
        rddl::for_few_reals<beacon_count>(context, [&](auto&, auto b) {
            const auto term = scratch.reached_x - rddl::at(BEACON_X_, b);
            rddl::elements(scratch.range_to, b) =
                rddl::hypot(term, scratch.reached_y - rddl::at(BEACON_Y_, b));
        });
    }

    // x'  (domain.rddl:74)
    template <class L>
    static void set_x(const Scratch<L>& scratch, State<L>& next) {
        next.x = scratch.reached_x;
    }

    // y'  (domain.rddl:75)
    template <class L>
    static void set_y(const Scratch<L>& scratch, State<L>& next) {
        next.y = scratch.reached_y;
    }

    // answers(?b)  (domain.rddl:82)
    template <class L>
    static void set_answers(Scratch<L>& scratch, rddl::Context<L>& context,
                            const rddl::StepNumbers<L, step_draws>& numbers) {
        using Real = typename L::Real;
        for (rddl::Index b = 0; b < beacon_count; ++b) {
            const Real term = rddl::exp(-scratch.range_to[b] / 6.0);
            scratch.answers[b] =
                rddl::sample::bernoulli(context, rddl::place_in_row<0>(numbers, 3, b), term);
        }
    }

    // echo(?b)  (domain.rddl:84)
    template <class L>
    static void set_echo(const Scratch<L>& scratch, Observation<L>& observation) {
        for (rddl::Index b = 0; b < beacon_count; ++b) {
            observation.echo[b] = scratch.answers[b];
        }
    }

    // range(?b)  (domain.rddl:85)
    template <class L>
    static void set_range(const Scratch<L>& scratch, Observation<L>& observation,
                          rddl::Context<L>& context) {
        rddl::for_each_object<beacon_count>(context, [&](auto& several, auto b) {
            rddl::elements(observation.range, b) = rddl::branch(
                several, rddl::at(scratch.answers, b),
                [&] {
                    const auto term =
                        0.05 * rddl::at(scratch.range_to, b) *
                        (0.05 * rddl::at(scratch.range_to, b));
                    return rddl::sample::normal(several, rddl::PlaceAmong<beacon_count>{4, b},
                                                rddl::at(scratch.range_to, b), term);
                },
                [&] { return 0.0; });
        });
    }

    // The reward of the step that was just made.
    template <class L>
    static typename L::Real reward(const State<L>& /*state*/, const Action<L>& /*action*/,
                                   const Scratch<L>& scratch, const State<L>& next,
                                   rddl::Context<L>& /*context*/) {
        return 100.0 * rddl::to_real(rddl::hypot(next.x - 8.0, next.y - 8.0) <= 0.5) -
               5.0 * rddl::to_real(scratch.hit_wall) - 1.0;
    }

    // Whether one of the terminations holds, so that the episode ends.
    template <class L>
    static typename L::Bool terminal(const State<L>& state, rddl::Context<L>& /*context*/) {
        rddl::Terminations<L> conditions;
        conditions.add(termination_0(state));
        return conditions.hold();
    }

    // hypot[x - GOAL-X, y - GOAL-Y] <= GOAL-RADIUS  (domain.rddl:96)
    template <class L>
    static typename L::Bool termination_0(const State<L>& state) {
        return rddl::hypot(state.x - 8.0, state.y - 8.0) <= 0.5;
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
        if (conditions.go_on()) conditions.add(2, precondition_2(action));
        if (conditions.go_on()) conditions.add(3, precondition_3(action));
        return conditions.first_violated();
    }

    // drive >= -1.0  (domain.rddl:100)
    template <class L>
    static typename L::Bool precondition_0(const Action<L>& action) {
        return action.drive >= -1.0;
    }

    // drive <= 1.0  (domain.rddl:101)
    template <class L>
    static typename L::Bool precondition_1(const Action<L>& action) {
        return action.drive <= 1.0;
    }

    // turn >= -0.8  (domain.rddl:102)
    template <class L>
    static typename L::Bool precondition_2(const Action<L>& action) {
        return action.turn >= -0.8;
    }

    // turn <= 0.8  (domain.rddl:103)
    template <class L>
    static typename L::Bool precondition_3(const Action<L>& action) {
        return action.turn <= 0.8;
    }
};

static_assert(sizeof(State<rddl::Scalar>) == 24);
static_assert(offsetof(State<rddl::Scalar>, heading) == 16);
static_assert(sizeof(Action<rddl::Scalar>) == 16);
static_assert(offsetof(Action<rddl::Scalar>, turn) == 8);
static_assert(sizeof(Observation<rddl::Scalar>) == 40);
static_assert(offsetof(Observation<rddl::Scalar>, bump) == 32);

// --------------------------------------------------------------- description of the problem

namespace about {

inline constexpr const char* source_file = "examples/robot/domain.rddl";
inline constexpr const char* beacon_objects[] = {"west", "south", "middle"};
inline constexpr rddl_type types[] = {{"beacon", beacon_objects, beacon_count, 0}};
inline constexpr std::int32_t of_beacon[] = {0};
inline constexpr std::array<double, 1> drive_lower = {-1};
inline constexpr std::array<double, 1> drive_upper = {1};
inline constexpr std::array<double, 1> turn_lower = {-0.8};
inline constexpr std::array<double, 1> turn_upper = {0.8};

// name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, source
inline constexpr rddl_fluent fluents[] = {
    {"BEACON-X", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_beacon, 3, -1, nullptr, nullptr,
     {source_file, 17, 9}},
    {"BEACON-Y", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_beacon, 3, -1, nullptr, nullptr,
     {source_file, 18, 9}},
    {"GOAL-X", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 19, 9}},
    {"GOAL-Y", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 20, 9}},
    {"GOAL-RADIUS", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 21, 9}},
    {"FIELD", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 22, 9}},
    {"DRIVE-VARIANCE", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 25, 9}},
    {"TURN-VARIANCE", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 26, 9}},
    {"REACH", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 29, 9}},
    {"RANGE-DEVIATION", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 30, 9}},
    {"BUMPER-FAILURE", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 31, 9}},
    {"STEP-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 33, 9}},
    {"WALL-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 34, 9}},
    {"GOAL-REWARD", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 35, 9}},
    {"x", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1, offsetof(State<rddl::Scalar>, x), nullptr,
     nullptr, {source_file, 38, 9}},
    {"y", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1, offsetof(State<rddl::Scalar>, y), nullptr,
     nullptr, {source_file, 39, 9}},
    {"heading", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1, offsetof(State<rddl::Scalar>, heading),
     nullptr, nullptr, {source_file, 40, 9}},
    {"course", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 42, 9}},
    {"distance", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 43, 9}},
    {"ahead-x", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 44, 9}},
    {"ahead-y", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 45, 9}},
    {"reached-x", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 46, 9}},
    {"reached-y", RDDL_INTERM, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 47, 9}},
    {"hit-wall", RDDL_INTERM, RDDL_BOOL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 48, 9}},
    {"range-to", RDDL_INTERM, RDDL_REAL, -1, 1, of_beacon, 3, -1, nullptr, nullptr,
     {source_file, 49, 9}},
    {"answers", RDDL_INTERM, RDDL_BOOL, -1, 1, of_beacon, 3, -1, nullptr, nullptr,
     {source_file, 50, 9}},
    {"echo", RDDL_OBSERVATION, RDDL_BOOL, -1, 1, of_beacon, 3,
     offsetof(Observation<rddl::Scalar>, echo), nullptr, nullptr, {source_file, 53, 9}},
    {"range", RDDL_OBSERVATION, RDDL_REAL, -1, 1, of_beacon, 3,
     offsetof(Observation<rddl::Scalar>, range), nullptr, nullptr, {source_file, 54, 9}},
    {"bump", RDDL_OBSERVATION, RDDL_BOOL, -1, 0, nullptr, 1,
     offsetof(Observation<rddl::Scalar>, bump), nullptr, nullptr, {source_file, 55, 9}},
    {"drive", RDDL_ACTION, RDDL_REAL, -1, 0, nullptr, 1, offsetof(Action<rddl::Scalar>, drive),
     drive_lower.data(), drive_upper.data(), {source_file, 57, 9}},
    {"turn", RDDL_ACTION, RDDL_REAL, -1, 0, nullptr, 1, offsetof(Action<rddl::Scalar>, turn),
     turn_lower.data(), turn_upper.data(), {source_file, 58, 9}},
};

inline constexpr rddl::Constants constants[] = {
    rddl::constants(0, BEACON_X_),      // BEACON-X
    rddl::constants(1, BEACON_Y_),      // BEACON-Y
    rddl::constant<double>(2, 8.0),     // GOAL-X
    rddl::constant<double>(3, 8.0),     // GOAL-Y
    rddl::constant<double>(4, 0.5),     // GOAL-RADIUS
    rddl::constant<double>(5, 10.0),    // FIELD
    rddl::constant<double>(6, 0.02),    // DRIVE-VARIANCE
    rddl::constant<double>(7, 0.01),    // TURN-VARIANCE
    rddl::constant<double>(8, 6.0),     // REACH
    rddl::constant<double>(9, 0.05),    // RANGE-DEVIATION
    rddl::constant<double>(10, 0.05),   // BUMPER-FAILURE
    rddl::constant<double>(11, 1.0),    // STEP-COST
    rddl::constant<double>(12, 5.0),    // WALL-COST
    rddl::constant<double>(13, 100.0),  // GOAL-REWARD
};

inline constexpr rddl_condition preconditions[] = {
    {"drive >= -1.0", {source_file, 100, 9}},
    {"drive <= 1.0", {source_file, 101, 9}},
    {"turn >= -0.8", {source_file, 102, 9}},
    {"turn <= 0.8", {source_file, 103, 9}},
};

inline constexpr rddl_condition terminations[] = {{"hypot[x - GOAL-X, y - GOAL-Y] <= GOAL-RADIUS",
                                                   {source_file, 96, 9}}};

inline constexpr Action<rddl::Scalar> default_action = [] {
    Action<rddl::Scalar> action{};
    action.drive = 0.0;
    action.turn = 0.0;
    return action;
}();

inline constexpr rddl_problem problem = {
    .struct_size = sizeof(rddl_problem),
    .type_size = sizeof(rddl_type),
    .fluent_size = sizeof(rddl_fluent),
    .condition_size = sizeof(rddl_condition),
    .domain = "robot",
    .instance = "robot_1",
    .types = types,
    .type_count = 1,
    .fluents = fluents,
    .fluent_count = 31,
    .state_size = sizeof(State<rddl::Scalar>),
    .action_size = sizeof(Action<rddl::Scalar>),
    .observation_size = sizeof(Observation<rddl::Scalar>),
    .interm_size = 0,
    .partially_observed = 1,
    .stochastic = 1,
    .default_action = &default_action,
    .horizon = 60,
    .discount = 0.99,
    .max_nondef_actions = -1,
    .preconditions = preconditions,
    .precondition_count = 4,
    .invariants = nullptr,
    .invariant_count = 0,
    .terminations = terminations,
    .termination_count = 1,
    .fingerprint = 0xba23d4c650198368,
};

inline constexpr rddl::SiteVariable scope_b[] = {{"b", &types[0]}};

inline constexpr rddl::Site sites[] = {
    {{source_file, 64, 30}, "Normal", {}},
    {{source_file, 65, 20}, "Normal", {}},
    {{source_file, 88, 40}, "Bernoulli", {}},
    {{source_file, 82, 23}, "Bernoulli", scope_b},
    {{source_file, 86, 26}, "Normal", scope_b},
};

}  // namespace about

inline const rddl_simulator* simulator() {
    using Engine = rddl::Compiled<Simulator, about::problem>;
    using Packed = rddl::Packed<Simulator, about::problem, 16>;
    constexpr rddl::About description{about::problem, about::sites, about::constants};
    static const rddl::SimulatorTable<Engine, Packed> table(description, Engine());
    return table.get();
}

}  // namespace
}  // namespace rddl_simulators::robot_robot_1

#ifndef RDDL_ENTRY
#define RDDL_ENTRY rddl_simulator_robot_robot_1
#endif

extern "C" RDDL_EXPORT const rddl_simulator* RDDL_ENTRY(void) {
    return rddl_simulators::robot_robot_1::simulator();
}
