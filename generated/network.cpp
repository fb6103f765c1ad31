// A simulator, made by rddlc 0.2.0. Do not edit it: change its sources and compile them again.
//
//     problem   network
//     instance  network_1
//     sources   examples/network/domain.rddl
//               examples/network/instance.rddl
//
// Compile it with -std=c++20 -O3 -ffp-contract=off and rddlc's include folder; g++ also needs
// -fno-tree-loop-distribute-patterns. Link it and call the extern "C" function
//
//     rddl_simulator_network_network_1
//
// or make a shared object for dlopen with -shared -fPIC -DRDDL_ENTRY=rddl_simulator_entry.
// <rddl/simulator.h> describes the rddl_simulator that it returns.

#include <rddl/simulator.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddl_simulators::network_network_1 {
// Unnamed, so that two versions of a simulator can be loaded into one program.
namespace {

// --------------------------------------------------------------------------------- objects

inline constexpr rddl::Index computer_count = 8;  // c1, c2, c3, c4, c5, c6, c7, c8

// ---------------------------------------------------------------------------------- tables

// running, domain.rddl:24
inline constexpr std::array<bool, computer_count> initial_running = {1, 1, 0, 1, 1, 1, 1, 1};

// running-by-count, domain.rddl:40
inline constexpr std::array<double, 2> running_by_count_ = {0.7, 0.95};

// running-places, domain.rddl:40
inline constexpr std::array<std::uint8_t, computer_count> running_places_ = {
    7, 0, 1, 2, 3, 4, 5, 6
};

// --------------------------------------------------------------------------------- records

template <class L>
struct State {
    std::array<typename L::Bool, computer_count> running;  // domain.rddl:24
};

template <class L>
struct Action {
    std::array<typename L::Bool, computer_count> reboot;  // domain.rddl:28
};

// Values that CPFs compute and others read, within a step.
template <class L>
struct Scratch {};

template <class L>
struct Observation {};

// ------------------------------------------------------------------------------ simulator

struct Simulator {
    template <class L> using State = network_network_1::State<L>;
    template <class L> using Action = network_network_1::Action<L>;
    template <class L> using Scratch = network_network_1::Scratch<L>;
    template <class L> using Observation = network_network_1::Observation<L>;

    static constexpr bool partially_observed = false;

    // The initial state.
    template <class L>
    static void reset(State<L>& state, rddl::Context<L>& /*context*/) {
        rddl::assign(state.running, initial_running);
    }

    // All CPFs, each after those that it depends on.
    template <class L>
    static void step(const State<L>& state, const Action<L>& action, Scratch<L>& /*scratch*/,
                     State<L>& next, Observation<L>& /*observation*/, rddl::Context<L>& context) {
        set_running(state, action, next, context);
    }

    // running'(?c)  (domain.rddl:40)
    template <class L>
    static void set_running(const State<L>& state, const Action<L>& action, State<L>& next,
                            rddl::Context<L>& context) {
        rddl::for_each_object<computer_count>(context, [&](auto& several, auto c) {
            rddl::elements(next.running, c) = rddl::branch(
                several, rddl::at(action.reboot, c),
                [&] { return true; },
                [&] {
                    const auto number =
                        rddl::to_int(rddl::at_places<running_places_>(state.running, c));
                    const auto term = rddl::at_own(running_by_count_, c, number);
                    const auto term_2 = rddl::select(rddl::at(state.running, c), term, 0.05);
                    return rddl::sample::valid_bernoulli(several, {0, c}, term_2);
                });
        });
    }

    // The reward of the step that was just made.
    template <class L>
    static typename L::Real reward(const State<L>& state, const Action<L>& action,
                                   const Scratch<L>& /*scratch*/, const State<L>& /*next*/,
                                   rddl::Context<L>& /*context*/) {
        return rddl::to_real(rddl::count_ones(rddl::bits(state.running))) -
               0.75 * rddl::to_real(rddl::count_ones(rddl::action_bits(action.reboot)));
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

static_assert(sizeof(State<rddl::Scalar>) == 8);
static_assert(sizeof(Action<rddl::Scalar>) == 8);

// --------------------------------------------------------------- description of the problem

namespace about {

inline constexpr const char* source_file = "examples/network/domain.rddl";
inline constexpr const char* computer_objects[] = {"c1", "c2", "c3", "c4", "c5", "c6", "c7", "c8"};
inline constexpr rddl_type types[] = {{"computer", computer_objects, computer_count, 0}};
inline constexpr std::int32_t of_computer_computer[] = {0, 0};
inline constexpr std::int32_t of_computer[] = {0};

// name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, source
inline constexpr rddl_fluent fluents[] = {
    {"LINK", RDDL_NON_FLUENT, RDDL_BOOL, -1, 2, of_computer_computer, 64, -1, nullptr, nullptr,
     {source_file, 16, 9}},
    {"ALONE-UP", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 18, 9}},
    {"AROUND-UP", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 19, 9}},
    {"REPAIR", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 20, 9}},
    {"REBOOT-COST", RDDL_NON_FLUENT, RDDL_REAL, -1, 0, nullptr, 1, -1, nullptr, nullptr,
     {source_file, 22, 9}},
    {"running", RDDL_STATE, RDDL_BOOL, -1, 1, of_computer, 8,
     offsetof(State<rddl::Scalar>, running), nullptr, nullptr, {source_file, 24, 9}},
    {"support", RDDL_INTERM, RDDL_REAL, -1, 1, of_computer, 8, -1, nullptr, nullptr,
     {source_file, 26, 9}},
    {"reboot", RDDL_ACTION, RDDL_BOOL, -1, 1, of_computer, 8,
     offsetof(Action<rddl::Scalar>, reboot), nullptr, nullptr, {source_file, 28, 9}},
};

inline constexpr std::array<std::int64_t, 8> LINK_places_ = {1, 10, 19, 28, 37, 46, 55, 56};

inline constexpr rddl::Constants constants[] = {
    rddl::constants(0, false, LINK_places_),  // LINK
    rddl::constant<double>(1, 0.45),          // ALONE-UP
    rddl::constant<double>(2, 0.5),           // AROUND-UP
    rddl::constant<double>(3, 0.05),          // REPAIR
    rddl::constant<double>(4, 0.75),          // REBOOT-COST
};

inline constexpr Action<rddl::Scalar> default_action = [] {
    Action<rddl::Scalar> action{};
    rddl::assign(action.reboot, false);
    return action;
}();

inline constexpr rddl_problem problem = {
    .struct_size = sizeof(rddl_problem),
    .type_size = sizeof(rddl_type),
    .fluent_size = sizeof(rddl_fluent),
    .condition_size = sizeof(rddl_condition),
    .domain = "network",
    .instance = "network_1",
    .types = types,
    .type_count = 1,
    .fluents = fluents,
    .fluent_count = 8,
    .state_size = sizeof(State<rddl::Scalar>),
    .action_size = sizeof(Action<rddl::Scalar>),
    .observation_size = sizeof(State<rddl::Scalar>),
    .interm_size = 0,
    .partially_observed = 0,
    .stochastic = 1,
    .default_action = &default_action,
    .horizon = 40,
    .discount = 0.95,
    .max_nondef_actions = 1,
    .preconditions = nullptr,
    .precondition_count = 0,
    .invariants = nullptr,
    .invariant_count = 0,
    .terminations = nullptr,
    .termination_count = 0,
    .fingerprint = 0xf03c15b9a1e51eaa,
};

inline constexpr rddl::SiteVariable scope_c[] = {{"c", &types[0]}};

inline constexpr rddl::Site sites[] = {
    {{source_file, 44, 17}, "Bernoulli", scope_c},
    {{source_file, 46, 17}, "Bernoulli", scope_c},
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
}  // namespace rddl_simulators::network_network_1

#ifndef RDDL_ENTRY
#define RDDL_ENTRY rddl_simulator_network_network_1
#endif

extern "C" RDDL_EXPORT const rddl_simulator* RDDL_ENTRY(void) {
    return rddl_simulators::network_network_1::simulator();
}
