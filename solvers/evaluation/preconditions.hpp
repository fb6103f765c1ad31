// What becomes of actions that violate a precondition, and what is kept of them.
#pragma once

#include <rddl/values/context.hpp>

#include <cstddef>
#include <vector>

namespace rddlc::solvers {

// What becomes of an action that violates a precondition.
enum class Preconditions {
    Ignore,  // it is taken, and nobody looks
    Warn,    // it is taken and reported
    Error,   // it is refused
    Noop     // the default action is taken instead, and that is reported
};

// What a condition was evaluated on.
struct Violation {
    std::vector<std::byte> state;
    std::vector<std::byte> action;             // of a precondition
    rddl::Context<rddl::Scalar> context = {};  // the random numbers
};

}  // namespace rddlc::solvers
