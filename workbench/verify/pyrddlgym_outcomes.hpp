// The same steps by pyRDDLGym, where it is installed: a Python program of ours, run as a child.
#pragma once

#include "problems/problem_lookup.hpp"
#include "rollouts/step_outcome.hpp"
#include "verify/walk_in_step.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::workbench {

// The text of the program.
extern const std::string_view pyrddlgym_outcomes_program;

struct PyRddlGymOptions {
    std::string python;  // the interpreter; empty: that of $VIRTUAL_ENV, else python3
    double seconds = 3;  // for its steps
    Tolerance tolerance{1e-9, false};
    // The step here with other last digits; asked where pyRDDLGym's step differs.
    std::function<std::vector<StepOutcome>(const StepStart&)> rounded_otherwise = {};
};

struct PyRddlGymDisagreement {
    Difference difference;  // expected: pyRDDLGym's
    StepStart start;
};

struct PyRddlGymComparison {
    std::string version;
    std::string not_compared;  // why; empty if it was
    ValueCounts counts;        // only what no draw takes part in
    std::int64_t steps = 0;
    std::int64_t both_refuse = 0;     // pyRDDLGym stops with an error, and the step faults here
    std::int64_t left_out = 0;        // pyRDDLGym alone stops with an error
    std::string first_refusal;        // of those: its message
    std::vector<std::string> random;  // fluents, "reward", "end": which draws take part in
    std::optional<PyRddlGymDisagreement> disagreement;
};

PyRddlGymComparison compare_with_pyrddlgym(const ProblemFiles& files, const rddl_problem& problem,
                                           const OutcomeComparison& comparison,
                                           const std::vector<StepSample>& samples,
                                           const PyRddlGymOptions& options);

}  // namespace rddlc::workbench
