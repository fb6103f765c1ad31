// Two programs of one problem side by side: what each shows in the same situations.
#pragma once

#include "ir/ir.hpp"

#include <rddl/values/context.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::fuzzing {

using Record = std::vector<std::byte>;

// The start of one step.
struct Situation {
    Record state, observation, memory, action;
    std::uint32_t step;  // decides the draws
};

// The results of a program in a situation.
struct Shown {
    Record next, observation, action, memory;  // the last two by the policy block
    double reward = 0;
    int violated_precondition = -1;
    // Conditions of the state, and of the next one.
    bool terminal = false;
    bool is_over = false;  // terminal or faulty, so that no engine steps from there
    bool next_terminal = false, next_violates_invariant = false;
    rddl::FaultRecord of_step, of_conditions, of_policy;
};

// An initial state, and what is made of each situation.
struct Story {
    Record initial;
    rddl::FaultRecord of_reset;
    std::vector<Shown> steps;
};

// The kinds of values of states and actions that no step computed.
enum class Values : std::uint8_t {
    Tame,  // small ints, and reals of few bits, so that sums are not rounded
    Wild,  // also ints beyond 2^53, tenths, -0, and, unless the reals have to be moderate, numbers
           // near the greatest ones, nan and infinities
};

// Situations that the program comes into under random actions (or those of its policy block), from
// its initial state and from random ones. Those of a program for moderate values are moderate.
std::vector<Situation> situations(const ir::Program& program, Values values, bool only_moderate,
                                  std::uint64_t seed, int count);

// The random numbers are those of the seed.
Story story(const ir::Program& program, const std::vector<Situation>& situations,
            std::uint64_t seed);

// The allowed difference of two stories. Bools, ints and objects must be equal in any case.
struct Tolerance {
    double relative = 0;      // of reals, or absolute of those below 1; 0: bit for bit
    bool not_finite = false;  // what is nan or infinite in either may be anything
};

// The first difference, in words. All nans are equal.
std::optional<std::string> difference(const ir::Program& program, const Story& expected,
                                      const Story& found, const Tolerance& tolerance);

// Roughly the number of simple operations of one step.
double step_cost(const ir::Program& program);

}  // namespace rddlc::fuzzing
