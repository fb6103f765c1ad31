// The same steps by all engines, to see whether they agree.
#pragma once

#include "verify/verify_report.hpp"

#include <chrono>
#include <cstdint>
#include <string>

namespace rddlc::workbench {

struct VerifySettings {
    Policy policy = Policy::Random;
    std::int64_t steps = 20'000;  // at most
    double seconds = 10;          // for all of it
    std::uint64_t seed = 0;
    std::string states;  // a trace, or lines for `rddl replay`, from whose states to step; empty:
                         // from those of episodes
    bool pyrddlgym = true;
    PyRddlGymOptions python;
    std::int64_t pyrddlgym_steps = 200;  // at most
    bool quiet = false;                  // no progress bar
};

// The problem has engines; it and the comparison, which is of the problem, must outlive the report.
// `words` are those by which the user named it; the time counts from `begin` on.
VerifyReport verify_problem(const VerifiedProblem& problem, const OutcomeComparison& comparison,
                            const std::string& words, const VerifySettings& options,
                            std::chrono::steady_clock::time_point begin);

}  // namespace rddlc::workbench
