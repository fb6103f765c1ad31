// A simulator, made by rddlc 0.2.0. Do not edit it: change its sources and compile them again.
//
//     problem   delivery
//     instance  delivery_1
//     sources   examples/delivery/domain.rddl
//               examples/delivery/instance.rddl
//
// Compile it with -std=c++20 -O3 -ffp-contract=off and rddlc's include folder; g++ also needs
// -fno-tree-loop-distribute-patterns. Link it and call the extern "C" function
//
//     rddl_simulator_delivery_delivery_1
//
// or make a shared object for dlopen with -shared -fPIC -DRDDL_ENTRY=rddl_simulator_entry.
// <rddl/simulator.h> describes the rddl_simulator that it returns.

#include <rddl/simulator.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl_simulators::delivery_delivery_1 {
// Unnamed, so that two versions of a simulator can be loaded into one program.
namespace {

// --------------------------------------------------------------------------------- objects

inline constexpr rddl::Index place_count = 6;      // farm, mill, church, depot, market, ...
inline constexpr rddl::Index van_count = 1;        // red
inline constexpr rddl::Index parcel_count = 3;     // letter, flour, fish
inline constexpr rddl::Index direction_count = 5;  // stay, north, east, south, west
inline constexpr rddl::Index weather_count = 3;    // sunny, rainy, snowy
inline constexpr rddl::Index progress_count = 3;   // waiting, riding, delivered

// ---------------------------------------------------------------------------------- tables

// ROAD, domain.rddl:27
inline constexpr std::array<std::array<std::int64_t, direction_count>, place_count> ROAD_ = {{
    {0, 0, 1, 3, 0},
    {1, 1, 2, 4, 0},
    {2, 2, 2, 5, 1},
    {3, 0, 4, 3, 3},
    {4, 1, 5, 4, 3},
    {5, 2, 5, 5, 4},
}};

// STEEP, domain.rddl:28
inline constexpr std::array<bool, place_count> STEEP_ = {0, 0, 1, 0, 0, 0};

// ORIGIN, domain.rddl:31
inline constexpr std::array<std::int64_t, parcel_count> ORIGIN_ = {3, 1, 5};

// DESTINATION, domain.rddl:32
inline constexpr std::array<std::int64_t, parcel_count> DESTINATION_ = {2, 4, 0};

// PRICE, domain.rddl:33
inline constexpr std::array<double, parcel_count> PRICE_ = {20, 20, 35};

// sky-thresholds, domain.rddl:57
inline constexpr std::array<std::array<double, 2>, 3> sky_thresholds_ = {{
    {0.8, 0.9500000000000001},
    {0.3, 0.8999999999999999},
    {0.2, 0.4},
}};

// --------------------------------------------------------------------------------- records

template <class L>
struct State {
    typename L::Int sky;                                // domain.rddl:41
    std::array<typename L::Int, van_count> position;    // domain.rddl:42
    std::array<typename L::Int, parcel_count> status;   // domain.rddl:43
    std::array<typename L::Int, parcel_count> carrier;  // domain.rddl:44
};

template <class L>
struct Action {
    std::array<typename L::Int, van_count> go;                               // domain.rddl:50
    std::array<std::array<typename L::Bool, parcel_count>, van_count> take;  // domain.rddl:51
};

// Values that CPFs compute and others read, within a step.
template <class L>
struct Scratch {
    std::array<typename L::Real, van_count> grip;       // domain.rddl:46
    std::array<typename L::Int, van_count> loaded;      // domain.rddl:47
    std::array<typename L::Bool, parcel_count> called;  // domain.rddl:48
};

template <class L>
struct Observation {};

// ------------------------------------------------------------------------------ simulator

struct Simulator {
    template <class L> using State = delivery_delivery_1::State<L>;
    template <class L> using Action = delivery_delivery_1::Action<L>;
    template <class L> using Scratch = delivery_delivery_1::Scratch<L>;
    template <class L> using Observation = delivery_delivery_1::Observation<L>;

    static constexpr bool partially_observed = false;

    // The initial state.
    template <class L>
    static void reset(State<L>& state, rddl::Context<L>& /*context*/) {
        state.sky = 0;
        rddl::assign(state.position, 3);
        rddl::assign(state.status, 0);
        rddl::assign(state.carrier, 0);
    }

    // All CPFs, each after those that it depends on.
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                     State<L>& next, Observation<L>& /*observation*/, rddl::Context<L>& context) {
        set_grip(state, scratch);
        set_loaded(state, scratch);
        set_sky(state, next, context);
        set_called(state, action, scratch);
        set_position(state, action, scratch, next, context);
        set_carrier(state, scratch, next);
        set_status(state, scratch, next);
    }

    // grip(?v)  (domain.rddl:60)
    template <class L>
    static void set_grip(const State<L>& state, Scratch<L>& scratch) {
        using Real = typename L::Real;
        const Real term = rddl::select(rddl::at(STEEP_, state.position[0]), 0.4, 0.7);
        scratch.grip[0] =
            rddl::select(state.sky == 0, 1.0, rddl::select(state.sky == 1, 0.9, term));
    }

    // loaded(?v)  (domain.rddl:71)
    template <class L>
    static void set_loaded(const State<L>& state, Scratch<L>& scratch) {
        using Int = typename L::Int;
        scratch.loaded[0] = rddl::sum<Int>(parcel_count, [&](rddl::Index p) {
            return rddl::to_int(state.status[p] == 1 && state.carrier[p] == 0);
        });
    }

    // sky'  (domain.rddl:57)
    template <class L>
    static void set_sky(const State<L>& state, State<L>& next, rddl::Context<L>& context) {
        next.sky =
            rddl::sample::interval<sky_thresholds_>(context, rddl::LonePlace{0, 0}, state.sky);
    }

    // called(?p)  (domain.rddl:73)
    template <class L>
    static void set_called(const State<L>& state, const Action<L>& action, Scratch<L>& scratch) {
        for (rddl::Index p = 0; p < parcel_count; ++p) {
            scratch.called[p] =
                action.take[0][p] && state.position[0] == ORIGIN_[p] && scratch.loaded[0] < 2;
        }
    }

    // position'(?v)  (domain.rddl:67)
    template <class L>
    static void set_position(const State<L>& state, const Action<L>& action,
                             const Scratch<L>& scratch, State<L>& next, rddl::Context<L>& context) {
        using Bool = typename L::Bool;
        const Bool draw =
            rddl::sample::valid_bernoulli(context, rddl::LonePlace{1, 0}, scratch.grip[0]);
        next.position[0] =
            rddl::select(draw, rddl::at(ROAD_, state.position[0], action.go[0]), state.position[0]);
    }

    // carrier'(?p)  (domain.rddl:77)
    template <class L>
    static void set_carrier(const State<L>& state, const Scratch<L>& scratch, State<L>& next) {
        for (rddl::Index p = 0; p < parcel_count; ++p) {
            next.carrier[p] =
                rddl::select(state.status[p] == 0 && scratch.called[p], 0, state.carrier[p]);
        }
    }

    // status'(?p)  (domain.rddl:84)
    template <class L>
    static void set_status(const State<L>& state, const Scratch<L>& scratch, State<L>& next) {
        using Bool = typename L::Bool;
        using Int = typename L::Int;
        for (rddl::Index p = 0; p < parcel_count; ++p) {
            next.status[p] = rddl::branch(
                state.status[p] == 0,
                [&] { return rddl::select(scratch.called[p], Int{1}, Int{0}); },
                [&] {
                    const Bool condition =
                        rddl::at(next.position, state.carrier[p]) == DESTINATION_[p];
                    const Int number = rddl::select(condition, Int{2}, Int{1});
                    return rddl::select(state.status[p] == 1, number, 2);
                });
        }
    }

    // The reward of the step that was just made.
    template <class L>
    static typename L::Real reward(const State<L>& state, const Action<L>& action,
                                   const Scratch<L>& /*scratch*/, const State<L>& next,
                                   rddl::Context<L>& /*context*/) {
        using Real = typename L::Real;
        const Real total = rddl::sum<Real>(parcel_count, [&](rddl::Index p) {
            return PRICE_[p] * rddl::to_real(state.status[p] == 1 && next.status[p] == 2);
        });
        return total - rddl::to_real(action.go[0] != 0);
    }

    // Whether one of the terminations holds, so that the episode ends.
    template <class L>
    static typename L::Bool terminal(const State<L>& state, rddl::Context<L>& /*context*/) {
        rddl::Terminations<L> conditions;
        conditions.add(termination_0(state));
        return conditions.hold();
    }

    // forall_{?p : parcel} [status(?p) == @delivered]  (domain.rddl:97)
    template <class L>
    static typename L::Bool termination_0(const State<L>& state) {
        using Bool = typename L::Bool;
        return rddl::for_all<Bool>(parcel_count, [&](rddl::Index p) {
            return state.status[p] == 2;
        });
    }

    // Whether the state breaks one of the invariants.
    template <class L>
    static typename L::Bool violates_invariant(const State<L>& /*state*/,
                                               rddl::Context<L>& /*context*/) {
        return false;
    }

    // The first precondition that the action violates, or -1. The others always hold.
    template <class L>
    static typename L::Int violated_precondition(const State<L>& state, const Action<L>& action,
                                                 rddl::Context<L>& context) {
        rddl::Preconditions<L> conditions(context);
        if (conditions.go_on()) conditions.add(0, precondition_0(state, action));
        return conditions.first_violated();
    }

    // forall_{?v : van, ?p : parcel} [ take(?v, ?p) => (status(?p) == @waitin...  (domain.rddl:102)
    template <class L>
    static typename L::Bool precondition_0(const State<L>& state, const Action<L>& action) {
        using Bool = typename L::Bool;
        return rddl::for_all<Bool>(parcel_count, [&](rddl::Index p) {
            return !action.take[0][p] || (state.status[p] == 0 && state.position[0] == ORIGIN_[p]);
        });
    }
};

static_assert(sizeof(State<rddl::Scalar>) == 64);
static_assert(offsetof(State<rddl::Scalar>, carrier) == 40);
static_assert(sizeof(Action<rddl::Scalar>) == 16);
static_assert(offsetof(Action<rddl::Scalar>, take) == 8);

// --------------------------------------------------------------- description of the problem

namespace about {

inline constexpr const char* source_file = "examples/delivery/domain.rddl";

inline constexpr const char* place_objects[] = {"farm", "mill", "church", "depot", "market",
                                                "harbour"};

inline constexpr const char* van_objects[] = {"red"};
inline constexpr const char* parcel_objects[] = {"letter", "flour", "fish"};
inline constexpr const char* direction_objects[] = {"stay", "north", "east", "south", "west"};
inline constexpr const char* weather_objects[] = {"sunny", "rainy", "snowy"};
inline constexpr const char* progress_objects[] = {"waiting", "riding", "delivered"};

inline constexpr rddl_type types[] = {
    {"place", place_objects, place_count, 0},
    {"van", van_objects, van_count, 0},
    {"parcel", parcel_objects, parcel_count, 0},
    {"direction", direction_objects, direction_count, 1},
    {"weather", weather_objects, weather_count, 1},
    {"progress", progress_objects, progress_count, 1},
};

inline constexpr std::int32_t of_place_direction[] = {0, 3};
inline constexpr std::int32_t of_place[] = {0};
inline constexpr std::int32_t of_parcel[] = {2};
inline constexpr std::int32_t of_weather_weather[] = {4, 4};
inline constexpr std::int32_t of_van[] = {1};
inline constexpr std::int32_t of_van_parcel[] = {1, 2};

// name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, source
inline constexpr rddl_fluent fluents[] = {
    {"ROAD", RDDL_NON_FLUENT, RDDL_INT, 0, 2, of_place_direction, 30, -1, nullptr, nullptr,
     {source_file, 27, 9}},
    {"STEEP", RDDL_NON_FLUENT, RDDL_BOOL, -1, 1, of_place, 6, -1, nullptr, nullptr,
     {source_file, 28, 9}},
    {"ORIGIN", RDDL_NON_FLUENT, RDDL_INT, 0, 1, of_parcel, 3, -1, nullptr, nullptr,
     {source_file, 31, 9}},
    {"DESTINATION", RDDL_NON_FLUENT, RDDL_INT, 0, 1, of_parcel, 3, -1, nullptr, nullptr,
     {source_file, 32, 9}},
    {"PRICE", RDDL_NON_FLUENT, RDDL_REAL, -1, 1, of_parcel, 3, -1, nullptr, nullptr,
     {source_file, 33, 9}},
    {"CHANGE", RDDL_NON_FLUENT, RDDL_REAL, -1, 2, of_weather_weather, 9, -1, nullptr, nullptr,
     {source_file, 36, 9}},
    {"DRIVE-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 38, 9}},
    {"CAPACITY", RDDL_NON_FLUENT, RDDL_INT, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 39, 9}},
    {"sky", RDDL_STATE, RDDL_INT, 4, 0, nullptr, 1, offsetof(State<rddl::Scalar>, sky), nullptr,
     nullptr, {source_file, 41, 9}},
    {"position", RDDL_STATE, RDDL_INT, 0, 1, of_van, 1, offsetof(State<rddl::Scalar>, position),
     nullptr, nullptr, {source_file, 42, 9}},
    {"status", RDDL_STATE, RDDL_INT, 5, 1, of_parcel, 3, offsetof(State<rddl::Scalar>, status),
     nullptr, nullptr, {source_file, 43, 9}},
    {"carrier", RDDL_STATE, RDDL_INT, 1, 1, of_parcel, 3, offsetof(State<rddl::Scalar>, carrier),
     nullptr, nullptr, {source_file, 44, 9}},
    {"grip", RDDL_INTERM, RDDL_REAL, -1, 1, of_van, 1, -1, nullptr, nullptr, {source_file, 46, 9}},
    {"loaded", RDDL_INTERM, RDDL_INT, -1, 1, of_van, 1, -1, nullptr, nullptr, {source_file, 47, 9}},
    {"called", RDDL_INTERM, RDDL_BOOL, -1, 1, of_parcel, 3, -1, nullptr, nullptr,
     {source_file, 48, 9}},
    {"go", RDDL_ACTION, RDDL_INT, 3, 1, of_van, 1, offsetof(Action<rddl::Scalar>, go), nullptr,
     nullptr, {source_file, 50, 9}},
    {"take", RDDL_ACTION, RDDL_BOOL, -1, 2, of_van_parcel, 3, offsetof(Action<rddl::Scalar>, take),
     nullptr, nullptr, {source_file, 51, 9}},
};

inline constexpr std::array<double, 9> CHANGE_values_ = {
    0.8, 0.15, 0.05, 0.3, 0.6, 0.1, 0.2, 0.2, 0.6
};

inline constexpr rddl::Constants constants[] = {
    rddl::constants(0, ROAD_),           // ROAD
    rddl::constants(1, STEEP_),          // STEEP
    rddl::constants(2, ORIGIN_),         // ORIGIN
    rddl::constants(3, DESTINATION_),    // DESTINATION
    rddl::constants(4, PRICE_),          // PRICE
    rddl::constants(5, CHANGE_values_),  // CHANGE
    rddl::constant<double>(6, 1.0),      // DRIVE-COST
    rddl::constant<std::int64_t>(7, 2),  // CAPACITY
};

inline constexpr rddl_condition preconditions[] = {
    {"forall_{?v : van, ?p : parcel} [ take(?v, ?p) => (status(?p) == @waiting ^ "
     "position(?v) == ORIGIN(?p)) ]", {source_file, 102, 9}},
    {"forall_{?p : parcel} [(sum_{?v : van} [take(?v, ?p)]) <= 1]", {source_file, 104, 9}},
};

inline constexpr rddl_condition
    terminations[] = {{"forall_{?p : parcel} [status(?p) == @delivered]", {source_file, 97, 9}}};

inline constexpr Action<rddl::Scalar> default_action = [] {
    Action<rddl::Scalar> action{};
    rddl::assign(action.go, 0);
    rddl::assign(action.take, false);
    return action;
}();

inline constexpr rddl_problem problem = {
    .struct_size = sizeof(rddl_problem),
    .type_size = sizeof(rddl_type),
    .fluent_size = sizeof(rddl_fluent),
    .condition_size = sizeof(rddl_condition),
    .domain = "delivery",
    .instance = "delivery_1",
    .types = types,
    .type_count = 6,
    .fluents = fluents,
    .fluent_count = 17,
    .state_size = sizeof(State<rddl::Scalar>),
    .action_size = sizeof(Action<rddl::Scalar>),
    .observation_size = sizeof(State<rddl::Scalar>),
    .interm_size = 0,
    .partially_observed = 0,
    .stochastic = 1,
    .default_action = &default_action,
    .horizon = 40,
    .discount = 1.0,
    .max_nondef_actions = 2,
    .preconditions = preconditions,
    .precondition_count = 2,
    .invariants = nullptr,
    .invariant_count = 0,
    .terminations = terminations,
    .termination_count = 1,
    .fingerprint = 0x45b7121cd5d97afa,
};

inline constexpr rddl::SiteVariable scope_v[] = {{"v", &types[1]}};

inline constexpr rddl::Site sites[] = {
    {{source_file, 57, 16}, "Discrete", {}},
    {{source_file, 67, 29}, "Bernoulli", scope_v},
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
}  // namespace rddl_simulators::delivery_delivery_1

#ifndef RDDL_ENTRY
#define RDDL_ENTRY rddl_simulator_delivery_delivery_1
#endif

extern "C" RDDL_EXPORT const rddl_simulator* RDDL_ENTRY(void) {
    return rddl_simulators::delivery_delivery_1::simulator();
}
