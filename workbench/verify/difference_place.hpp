// Where in the RDDL text it is said what a value ought to be.
#pragma once

#include "support/source.hpp"
#include "verify/verified_problem.hpp"

#include <cstdint>
#include <optional>

namespace rddlc::workbench {

// The CPF of a value, the reward, the condition; of a fault the CPF in which it happens, or the
// place itself. None where nothing says so, as of an initial value.
std::optional<Span> place_of(const Difference& difference, const StepStart& start,
                             const VerifiedProblem& problem, std::uint64_t seed);

}  // namespace rddlc::workbench
