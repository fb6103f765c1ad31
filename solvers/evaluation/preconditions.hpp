// The treatment of actions that violate a precondition, and the record that is kept of them.
#pragma once

#include <rddl/values/context.hpp>

#include <cstddef>
#include <vector>

namespace rddlc::solvers {

// The treatment of an action that violates a precondition.
enum class Preconditions {
    Ignore,  // it is executed without a check
    Warn,    // it is taken and reported
    Error,   // it is refused
    Noop     // the default action is taken instead, and that is reported
};

// The values on which a condition was evaluated.
struct Violation {
    std::vector<std::byte> state;
    std::vector<std::byte> action;             // of a precondition
    rddl::Context<rddl::Scalar> context = {};  // the random numbers
};

}  // namespace rddlc::solvers
