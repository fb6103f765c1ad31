// A policy written by hand in the form that the emitter gives, for the hand-written simulator: it
// repairs one machine after the other and draws the mode. Its 24th decision of an episode faults.
#pragma once

#include "tiny_simulator.hpp"

namespace tiny {

template <class L>
struct PolicyMemory {
    typename L::Int turn;  // turn: counts the decisions, from 1
};

struct Policy {
    template <class L>
    using Memory = PolicyMemory<L>;

    template <class L>
    static void reset(PolicyMemory<L>& memory) {
        memory.turn = 1;
    }

    template <class L>
    static void act(const State<L>& state, const PolicyMemory<L>& memory, Scratch<L>&,
                    Action<L>& action, PolicyMemory<L>& next_memory, Context<L>& context) {
        using namespace rddl;
        action = {};
        const typename L::Int machine = memory.turn % machines;
        action.repair[static_cast<std::size_t>(machine)] = state.wear[0] < 1000.0;
        const typename L::Real chance = memory.turn < 24 ? 0.5 : 1.5;
        action.set_mode = to_int(sample::bernoulli(context, {3, 0}, chance));
        next_memory.turn = memory.turn + 1;
    }
};

inline constexpr rddl::Site sites_with_policy[] = {
    sites[0], sites[1], sites[2], {{"policy.rddl", 8, 20}, "Bernoulli", {}}};
inline constexpr rddl_policy policy{.struct_size = sizeof(rddl_policy),
                                    .name = "in_turn",
                                    .source = {"policy.rddl", 1, 8},
                                    .memory_size = sizeof(PolicyMemory<Scalar>),
                                    .stochastic = 1};

inline constexpr rddl_problem unlimited = [] {
    rddl_problem copy = problem;
    copy.max_nondef_actions = -1;
    return copy;
}();

inline const rddl_simulator* simulator_with_policy() {
    static const rddl::SimulatorTable table(
        rddl::About{unlimited, sites_with_policy, {}, &policy},
        rddl::Compiled<Simulator, problem, rddl::Scalar, Policy>());
    return table.get();
}

}  // namespace tiny
