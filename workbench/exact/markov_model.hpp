// A problem as a table: the states that can be reached, and where each action leads to from them.
#pragma once

#include "exact/state_table.hpp"
#include "ir/interpreter.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::workbench {

struct MarkovModel {
    StateTable states;  // by breadth: those that need fewer steps have smaller numbers
    // within[d]: how many states are reached within d steps; the last entry counts all of them.
    std::vector<StateNumber> within;
    std::vector<std::byte> actions;  // records, one after the other
    // The choices of state s are first_choice[s] .. first_choice[s + 1]. The last states may have
    // no choices, since no action follows them within the horizon.
    std::vector<std::uint64_t> first_choice;
    // The action and the mean reward of a choice. Its transitions are first_transition[c] ..
    // first_transition[c + 1].
    std::vector<std::uint32_t> action;
    std::vector<double> reward;
    std::vector<std::uint64_t> first_transition;
    // The next state of a transition, and its probability. Ends of episodes are not transitions, so
    // probabilities sum up to 1 or less.
    std::vector<StateNumber> to;
    std::vector<double> probability;
    // Where episodes start.
    struct Start {
        StateNumber state;
        double probability;
    };
    std::vector<Start> starts;

    std::size_t memory() const;  // bytes
};

struct ModelLimits {
    std::int64_t horizon = 0;  // steps; 0: none
    std::int64_t states = 10'000'000;
    std::int64_t outcomes = 1 << 20;  // of a step
    std::int64_t memory = 0;          // bytes
    int threads = 0;                  // 0: one per core
};

// Lists all that can be reached. `actions` are records one after the other; those that violate a
// precondition, or lead to a fault, are no choices (where all are so, as in planners, those that do
// not fault are taken). The same model on any number of threads. Throws a Failure where the problem
// is not finite, or beyond the limits.
MarkovModel markov_model(const ir::Interpreter& interpreter, std::vector<std::byte> actions,
                         const ModelLimits& limits);

// How many states a record can have: 2 for each bool, and so on; infinite where a number has no
// bounds, or is real.
double count_of_states(const rddl_problem& problem);

}  // namespace rddlc::workbench
