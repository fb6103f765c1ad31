// A simulator, made by rddlc 0.2.0. Do not edit it: change its sources and compile them again.
//
//     problem   fire
//     instance  fire_1
//     sources   examples/fire/domain.rddl
//               examples/fire/instance.rddl
//
// Compile it with -std=c++20 -O3 -ffp-contract=off and rddlc's include folder; g++ also needs
// -fno-tree-loop-distribute-patterns. Link it and call the extern "C" function
//
//     rddl_simulator_fire_fire_1
//
// or make a shared object for dlopen with -shared -fPIC -DRDDL_ENTRY=rddl_simulator_entry.
// <rddl/simulator.h> describes the rddl_simulator that it returns.

#include <rddl/simulator.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl_simulators::fire_fire_1 {
// Unnamed, so that two versions of a simulator can be loaded into one program.
namespace {

// --------------------------------------------------------------------------------- objects

inline constexpr rddl::Index xpos_count = 5;  // x1, x2, x3, x4, x5
inline constexpr rddl::Index ypos_count = 5;  // y1, y2, y3, y4, y5

// ---------------------------------------------------------------------------------- tables

// CLEARING, domain.rddl:23
inline constexpr std::array<std::array<bool, ypos_count>, xpos_count> CLEARING_ = {{
    {0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0},
    {0, 0, 0, 1, 1},
    {0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0},
}};

// burning, domain.rddl:39
inline constexpr std::array<std::array<bool, ypos_count>, xpos_count> initial_burning = {{
    {0, 0, 1, 0, 0},
    {0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0},
}};

// ignites-rows, domain.rddl:58
inline constexpr std::array<std::int64_t, 126> ignites_rows_ = {
    0, 1, 2, 2, 2, 2, 4, 5, 5, 5, 5, 7, 8, 8, 8, 8, 10, 11, 11, 11, 11, 12, 13, 13, 13, 13, 14, 15,
    16, 16, 16, 17, 19, 20, 20, 20, 21, 23, 24, 24, 24, 25, 27, 28, 28, 28, 29, 30, 31, 31, 31, 31,
    32, 33, 34, 34, 34, 35, 37, 38, 38, 38, 39, 41, 42, 42, 42, 43, 45, 46, 46, 46, 47, 48, 49, 49,
    49, 49, 50, 51, 52, 52, 52, 53, 55, 56, 56, 56, 57, 59, 60, 60, 60, 61, 63, 64, 64, 64, 65, 66,
    67, 67, 67, 67, 68, 69, 69, 69, 69, 70, 72, 72, 72, 72, 73, 75, 75, 75, 75, 76, 78, 78, 78, 78,
    79, 80
};

// ignites-m, domain.rddl:58
inline constexpr std::array<std::int64_t, 80> ignites_m_ = {
    1, 0, 0, 2, 1, 1, 3, 2, 2, 4, 3, 3, 4, 0, 1, 0, 1, 0, 2, 1, 2, 1, 3, 2, 3, 2, 4, 3, 4, 3, 4, 0,
    1, 0, 1, 0, 2, 1, 2, 1, 3, 2, 3, 2, 4, 3, 4, 3, 4, 0, 1, 0, 1, 0, 2, 1, 2, 1, 3, 2, 3, 2, 4, 3,
    4, 3, 4, 0, 1, 1, 0, 2, 2, 1, 3, 3, 2, 4, 4, 3
};

// ignites-entries, domain.rddl:58
inline constexpr std::array<double, 80> ignites_entries_ = {
    0.88, 0.88, 0.88, 0.88, 0.88, 0.88, 0.88, 0.88, 0.88, 0.88, 0.88, 0.88, 0.88,
    0.6799999999999999, 0.88, 0.88, 0.6799999999999999, 0.88, 0.88, 0.88, 0.6799999999999999, 0.88,
    0.88, 0.88, 0.6799999999999999, 0.88, 0.88, 0.88, 0.6799999999999999, 0.88, 0.88,
    0.6799999999999999, 0.88, 0.88, 0.6799999999999999, 0.88, 0.88, 0.88, 0.6799999999999999, 0.88,
    0.88, 0.88, 0.6799999999999999, 0.88, 0.88, 0.88, 0.6799999999999999, 0.88, 0.88,
    0.6799999999999999, 0.88, 0.88, 0.6799999999999999, 0.88, 0.88, 0.88, 0.6799999999999999, 0.88,
    0.88, 0.88, 0.6799999999999999, 0.88, 0.88, 0.88, 0.6799999999999999, 0.88, 0.88,
    0.6799999999999999, 0.88, 0.6799999999999999, 0.88, 0.88, 0.6799999999999999, 0.88, 0.88,
    0.6799999999999999, 0.88, 0.88, 0.6799999999999999, 0.88
};

// HOUSE-c, domain.rddl:22
inline constexpr std::array<std::int64_t, 3> HOUSE_c_ = {4, 4, 4};

// HOUSE-r, domain.rddl:22
inline constexpr std::array<std::int64_t, 3> HOUSE_r_ = {0, 2, 4};

// --------------------------------------------------------------------------------- records

template <class L>
struct State {
    std::array<std::array<typename L::Bool, ypos_count>, xpos_count> burning;  // domain.rddl:39
    std::array<std::array<typename L::Bool, ypos_count>, xpos_count> bare;     // domain.rddl:40
};

template <class L>
struct Action {
    std::array<std::array<typename L::Bool, ypos_count>, xpos_count> douse;  // domain.rddl:45
    std::array<std::array<typename L::Bool, ypos_count>, xpos_count> clear;  // domain.rddl:46
};

// Values that CPFs compute and others read, within a step.
template <class L>
struct Scratch {
    std::array<std::array<typename L::Bool, ypos_count>, xpos_count> ignites;  // domain.rddl:43
};

template <class L>
struct Observation {};

// ------------------------------------------------------------------------------ simulator

struct Simulator {
    template <class L> using State = fire_fire_1::State<L>;
    template <class L> using Action = fire_fire_1::Action<L>;
    template <class L> using Scratch = fire_fire_1::Scratch<L>;
    template <class L> using Observation = fire_fire_1::Observation<L>;

    static constexpr bool partially_observed = false;

    // The initial state.
    template <class L>
    static void reset(State<L>& state, rddl::Context<L>& /*context*/) {
        rddl::assign(state.burning, initial_burning);
        rddl::assign(state.bare, false);
    }

    // All CPFs, each after those that it depends on.
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                     State<L>& next, Observation<L>& /*observation*/, rddl::Context<L>& context) {
        set_bare(state, action, next, context);
        set_ignites(state, action, scratch, context);
        set_burning(state, action, scratch, next, context);
    }

    // bare'(?c, ?r)  (domain.rddl:65)
    template <class L>
    static void set_bare(const State<L>& state, const Action<L>& action, State<L>& next,
                         rddl::Context<L>& context) {
        rddl::for_many_objects<xpos_count * ypos_count>(context, [&](auto& several, auto c_r) {
            rddl::elements(next.bare, c_r) = rddl::branch(
                several, rddl::at(state.burning, c_r),
                [&] { return rddl::sample::bernoulli(several, {0, c_r}, 0.15); },
                [&] { return rddl::at(state.bare, c_r) || rddl::at(action.clear, c_r); });
        });
    }

    // ignites(?c, ?r)  (domain.rddl:58)
    template <class L>
    static void set_ignites(const State<L>& state, const Action<L>& action, Scratch<L>& scratch,
                            rddl::Context<L>& context) {
        using Bool = typename L::Bool;
        using Real = typename L::Real;
        for (rddl::Index c = 0; c < xpos_count; ++c) {
            for (rddl::Index r = 0; r < ypos_count; ++r) {
                const Bool condition =
                    CLEARING_[c][r] || state.burning[c][r] || state.bare[c][r] ||
                    action.clear[c][r];
                scratch.ignites[c][r] = rddl::branch(
                    context, condition,
                    [&] { return false; },
                    [&] {
                        const Real product = rddl::product<Real>(xpos_count, [&](rddl::Index n) {
                            return rddl::product<Real>(
                                rddl::row(ignites_rows_,
                                          (c * 5 + r) * 5 + n), [&](rddl::Index entry) {
                                    return rddl::select(state.burning[n][ignites_m_[entry]],
                                                        ignites_entries_[entry], 1.0);
                                });
                        });
                        const Real term = 1.0 - 0.9995 * product;
                        return rddl::sample::valid_bernoulli(context, {1, c * 5 + r}, term);
                    });
            }
        }
    }

    // burning'(?c, ?r)  (domain.rddl:63)
    template <class L>
    static void set_burning(const State<L>& state, const Action<L>& action,
                            const Scratch<L>& scratch, State<L>& next, rddl::Context<L>& context) {
        rddl::for_many_objects<xpos_count * ypos_count>(context, [&](auto&, auto c_r) {
            const auto condition =
                rddl::at(state.burning, c_r) && !rddl::at(action.douse, c_r) &&
                !rddl::at(next.bare, c_r);
            rddl::elements(next.burning, c_r) = rddl::at(scratch.ignites, c_r) || condition;
        });
    }

    // The reward of the step that was just made.
    template <class L>
    static typename L::Real reward(const State<L>& /*state*/, const Action<L>& action,
                                   const Scratch<L>& scratch, const State<L>& next,
                                   rddl::Context<L>& /*context*/) {
        using Int = typename L::Int;
        using Real = typename L::Real;
        const Int total = rddl::sum<Int>(3, [&](rddl::Index entry) {
            return rddl::to_int(scratch.ignites[HOUSE_c_[entry]][HOUSE_r_[entry]]);
        });
        const Int count = rddl::count_ones(rddl::action_bits(action.douse));
        const Real term =
            rddl::to_real(rddl::wrap_add(count, rddl::count_ones(rddl::action_bits(action.clear))));
        const Real term_2 =
            rddl::to_real(rddl::count_ones(rddl::bits(next.burning))) +
            50.0 * rddl::to_real(total) + 0.5 * term;
        return -term_2;
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
        return conditions.violated();
    }

    // forall_{?c : xpos, ?r : ypos} [~(burning(?c, ?r) ^ bare(?c, ?r))]  (domain.rddl:84)
    template <class L>
    static typename L::Bool invariant_0(const State<L>& state) {
        return rddl::bit_and(rddl::bits(state.burning), rddl::bits(state.bare)) == 0;
    }

    // The first precondition that the action violates, or -1.
    template <class L>
    static typename L::Int violated_precondition(const State<L>& state, const Action<L>& action,
                                                 rddl::Context<L>& context) {
        rddl::Preconditions<L> conditions(context);
        if (conditions.go_on()) conditions.add(0, precondition_0(state, action));
        if (conditions.go_on()) conditions.add(1, precondition_1(state, action));
        return conditions.first_violated();
    }

    // forall_{?c : xpos, ?r : ypos} [douse(?c, ?r) => burning(?c, ?r)]  (domain.rddl:77)
    template <class L>
    static typename L::Bool precondition_0(const State<L>& state, const Action<L>& action) {
        using Int = typename L::Int;
        const Int douse = rddl::action_bits(action.douse);
        return rddl::bit_and(douse, rddl::bit_xor(rddl::bits(state.burning), -1)) == 0;
    }

    // forall_{?c : xpos, ?r : ypos} [ clear(?c, ?r) => ~(burning(?c, ?r) | bar...  (domain.rddl:78)
    template <class L>
    static typename L::Bool precondition_1(const State<L>& state, const Action<L>& action) {
        using Int = typename L::Int;
        const Int bits =
            rddl::bit_or(rddl::bit_or(rddl::bits(state.burning), rddl::bits(state.bare)), 24576);
        return rddl::bit_and(rddl::action_bits(action.clear), bits) == 0;
    }
};

static_assert(sizeof(State<rddl::Scalar>) == 50);
static_assert(offsetof(State<rddl::Scalar>, bare) == 25);
static_assert(sizeof(Action<rddl::Scalar>) == 50);
static_assert(offsetof(Action<rddl::Scalar>, clear) == 25);

// --------------------------------------------------------------- description of the problem

namespace about {

inline constexpr const char* source_file = "examples/fire/domain.rddl";
inline constexpr const char* xpos_objects[] = {"x1", "x2", "x3", "x4", "x5"};
inline constexpr const char* ypos_objects[] = {"y1", "y2", "y3", "y4", "y5"};

inline constexpr rddl_type types[] = {
    {"xpos", xpos_objects, xpos_count, 0},
    {"ypos", ypos_objects, ypos_count, 0},
};

inline constexpr std::int32_t of_xpos[] = {0};
inline constexpr std::int32_t of_ypos[] = {1};
inline constexpr std::int32_t of_xpos_ypos[] = {0, 1};

// name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, source
inline constexpr rddl_fluent fluents[] = {
    {"X", RDDL_NON_FLUENT, RDDL_INT, -1, 1, of_xpos, 5, -1, nullptr, nullptr, {source_file, 18, 9}},
    {"Y", RDDL_NON_FLUENT, RDDL_INT, -1, 1, of_ypos, 5, -1, nullptr, nullptr, {source_file, 19, 9}},
    {"HOUSE", RDDL_NON_FLUENT, RDDL_BOOL, -1, 2, of_xpos_ypos, 25, -1, nullptr, nullptr,
     {source_file, 22, 9}},
    {"CLEARING", RDDL_NON_FLUENT, RDDL_BOOL, -1, 2, of_xpos_ypos, 25, -1, nullptr, nullptr,
     {source_file, 23, 9}},
    {"SPREAD", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 27, 9}},
    {"WIND", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 28, 9}},
    {"WIND-X", RDDL_NON_FLUENT, RDDL_INT, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 29, 9}},
    {"WIND-Y", RDDL_NON_FLUENT, RDDL_INT, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 30, 9}},
    {"LIGHTNING", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 31, 9}},
    {"BURN-OUT", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 32, 9}},
    {"FIRE-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 35, 9}},
    {"HOUSE-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 36, 9}},
    {"CREW-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 37, 9}},
    {"burning", RDDL_STATE, RDDL_BOOL, -1, 2, of_xpos_ypos, 25,
     offsetof(State<rddl::Scalar>, burning), nullptr, nullptr, {source_file, 39, 9}},
    {"bare", RDDL_STATE, RDDL_BOOL, -1, 2, of_xpos_ypos, 25, offsetof(State<rddl::Scalar>, bare),
     nullptr, nullptr, {source_file, 40, 9}},
    {"risk", RDDL_INTERM, RDDL_REAL, -1, 2, of_xpos_ypos, 25, -1, nullptr, nullptr,
     {source_file, 42, 9}},
    {"ignites", RDDL_INTERM, RDDL_BOOL, -1, 2, of_xpos_ypos, 25, -1, nullptr, nullptr,
     {source_file, 43, 9}},
    {"douse", RDDL_ACTION, RDDL_BOOL, -1, 2, of_xpos_ypos, 25,
     offsetof(Action<rddl::Scalar>, douse), nullptr, nullptr, {source_file, 45, 9}},
    {"clear", RDDL_ACTION, RDDL_BOOL, -1, 2, of_xpos_ypos, 25,
     offsetof(Action<rddl::Scalar>, clear), nullptr, nullptr, {source_file, 46, 9}},
};

inline constexpr std::array<std::int64_t, 5> X_values_ = {1, 2, 3, 4, 5};
inline constexpr std::array<std::int64_t, 5> Y_values_ = {1, 2, 3, 4, 5};
inline constexpr std::array<std::int64_t, 3> HOUSE_places_ = {20, 22, 24};

inline constexpr rddl::Constants constants[] = {
    rddl::constants(0, X_values_),             // X
    rddl::constants(1, Y_values_),             // Y
    rddl::constants(2, false, HOUSE_places_),  // HOUSE
    rddl::constants(3, CLEARING_),             // CLEARING
    rddl::constant<double>(4, 0.12),           // SPREAD
    rddl::constant<double>(5, 0.2),            // WIND
    rddl::constant<std::int64_t>(6, 1),        // WIND-X
    rddl::constant<std::int64_t>(7, 0),        // WIND-Y
    rddl::constant<double>(8, 5e-04),          // LIGHTNING
    rddl::constant<double>(9, 0.15),           // BURN-OUT
    rddl::constant<double>(10, 1.0),           // FIRE-COST
    rddl::constant<double>(11, 50.0),          // HOUSE-COST
    rddl::constant<double>(12, 0.5),           // CREW-COST
};

inline constexpr rddl_condition preconditions[] = {
    {"forall_{?c : xpos, ?r : ypos} [douse(?c, ?r) => burning(?c, ?r)]", {source_file, 77, 9}},
    {"forall_{?c : xpos, ?r : ypos} [ clear(?c, ?r) => ~(burning(?c, ?r) | bare(?c, ?r) | "
     "CLEARING(?c, ?r)) ]", {source_file, 78, 9}},
};

inline constexpr rddl_condition
    invariants[] = {{"forall_{?c : xpos, ?r : ypos} [~(burning(?c, ?r) ^ bare(?c, ?r))]",
                     {source_file, 84, 9}}};

inline constexpr Action<rddl::Scalar> default_action = [] {
    Action<rddl::Scalar> action{};
    rddl::assign(action.douse, false);
    rddl::assign(action.clear, false);
    return action;
}();

inline constexpr rddl_problem problem = {
    .struct_size = sizeof(rddl_problem),
    .type_size = sizeof(rddl_type),
    .fluent_size = sizeof(rddl_fluent),
    .condition_size = sizeof(rddl_condition),
    .domain = "fire",
    .instance = "fire_1",
    .types = types,
    .type_count = 2,
    .fluents = fluents,
    .fluent_count = 19,
    .state_size = sizeof(State<rddl::Scalar>),
    .action_size = sizeof(Action<rddl::Scalar>),
    .observation_size = sizeof(State<rddl::Scalar>),
    .interm_size = 0,
    .partially_observed = 0,
    .stochastic = 1,
    .default_action = &default_action,
    .horizon = 40,
    .discount = 1.0,
    .max_nondef_actions = 1,
    .preconditions = preconditions,
    .precondition_count = 2,
    .invariants = invariants,
    .invariant_count = 1,
    .terminations = nullptr,
    .termination_count = 0,
    .fingerprint = 0x683d75749be8cc5d,
};

inline constexpr rddl::SiteVariable scope_c_r[] = {{"c", &types[0]}, {"r", &types[1]}};

inline constexpr rddl::Site sites[] = {
    {{source_file, 66, 30}, "Bernoulli", scope_c_r},
    {{source_file, 60, 32}, "Bernoulli", scope_c_r},
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
}  // namespace rddl_simulators::fire_fire_1

#ifndef RDDL_ENTRY
#define RDDL_ENTRY rddl_simulator_fire_fire_1
#endif

extern "C" RDDL_EXPORT const rddl_simulator* RDDL_ENTRY(void) {
    return rddl_simulators::fire_fire_1::simulator();
}
