// The output of `rddl verify`: one line, or the first difference.
#pragma once

#include "verify/pyrddlgym_outcomes.hpp"
#include "verify/verdict.hpp"
#include "verify/verified_problem.hpp"
#include "verify/walk_in_step.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace rddlc::workbench {

struct VerifyReport {
    const VerifiedProblem& problem;
    const OutcomeComparison& comparison;
    std::string words;  // the problem as the user named it, for commands
    std::uint64_t seed = 0;
    Walk walk;
    std::optional<PyRddlGymComparison> pyrddlgym;  // absent: not wanted
    std::optional<Verdict> verdict;

    bool agrees() const { return !walk.disagreement && !(pyrddlgym && pyrddlgym->disagreement); }
};

// The texts end with line breaks.
std::string agreement_line(const VerifyReport& report);
std::string difference_text(const VerifyReport& report);
std::string invalid_program_text(const VerifiedProblem& problem, const std::string& words);
nlohmann::ordered_json invalid_program_json(const VerifiedProblem& problem);
nlohmann::ordered_json report_json(const VerifyReport& report);

}  // namespace rddlc::workbench
