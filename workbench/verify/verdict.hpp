// Finds the engine that is wrong if engines differ.
#pragma once

#include "verify/verified_problem.hpp"
#include "verify/walk_in_step.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace rddlc::workbench {

struct Verdict {
    std::optional<std::string> pass;        // whose program the interpreter runs differently
    bool emitted_code = false;              // the interpreter agrees after every pass
    std::optional<std::string> avoided_by;  // leaving this pass out makes the difference vanish
};

// Repeats the step: after each pass in the interpreter or, if the interpreter agrees, compiled
// without one pass after the other, for a minute at most.
Verdict judge(const VerifiedProblem& problem, const OutcomeComparison& comparison,
              const Disagreement& found, std::uint64_t seed);

}  // namespace rddlc::workbench
