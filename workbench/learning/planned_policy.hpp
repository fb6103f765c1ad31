// Planners among the policies of commands, and the reasons of their decisions.
#pragma once

#include "formats/line_stream.hpp"
#include "formats/records_json.hpp"
#include "planners/planner/planner_policy.hpp"

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace rddlc::workbench {

// Settings of planners from the command line.
struct PlannerSettings {
    bool cheat = false;             // they see the state of problems that hide it
    std::string explanations = {};  // a file for what decisions were made by; "": none
    std::function<void(const planners::Explanation&)> explain = {};
    // Derivatives of steps (engines/step_derivatives.hpp), for planners that need them.
    solvers::DerivativesSource derivatives = {};

    bool explain_on_standard_output() const { return explanations == "-"; }
};

// A file with a line of JSON for each decision, in the order of episodes and steps.
class Explanations {
  public:
    // The file, where there is one; else nothing is written. Both must outlive it.
    Explanations(PlannerSettings& settings, const rddl_problem& problem, const UsedFiles& used);
    // The decisions of one policy.
    void write(const std::string& policy);
    void finish();

  private:
    void take(const planners::Explanation& explanation);
    std::string line_of(const planners::Explanation& explanation) const;

    const rddl_problem& problem_;
    RecordLayout actions_;
    std::optional<LineWriter> file_;
    std::mutex mutex_;                                                    // of what follows
    std::map<std::pair<std::int64_t, std::int64_t>, std::string> lines_;  // episode and step
};

}  // namespace rddlc::workbench
