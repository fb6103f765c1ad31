// Finds the place in the RDDL text that defines a value.
#pragma once

#include "support/source.hpp"
#include "verify/verified_problem.hpp"

#include <cstdint>
#include <optional>

namespace rddlc::workbench {

// The CPF of a value, the reward, the condition; for a fault the CPF in which it happens, or the
// place itself. Nothing if no text defines it, as for an initial value.
std::optional<Span> place_of(const Difference& difference, const StepStart& start,
                             const VerifiedProblem& problem, std::uint64_t seed);

}  // namespace rddlc::workbench
