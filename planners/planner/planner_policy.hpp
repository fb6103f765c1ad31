// Planners as policies, by the text that users give: plan:NAME[,key=value...].
#pragma once

#include "planners/planner/planner.hpp"
#include "solvers/options/options.hpp"
#include "solvers/policies/policy.hpp"
#include "support/memory.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace rddlc::planners {

inline constexpr const char* prefix = "plan:";
inline bool is_planner(const std::string& policy) {
    return policy.starts_with(prefix);
}

// The description of a planner, for help and completions.
struct PlannerText {
    std::string name;  // "cem"
    std::string summary;
    std::vector<solvers::OptionText> options;
};
const std::vector<PlannerText>& planner_texts();

// Throws a Failure with a sentence where the text names no planner, or an option that it does not
// have, or a value that the option does not take.
void require_planner(const std::string& policy);

struct PolicySettings {
    std::uint64_t seed = 0;  // of the search, unless the text has one
    bool cheat = false;      // as if the text had cheat=yes
    std::int64_t memory_limit = default_memory_limit;
    // The base policy of that name.
    std::function<solvers::Policy(const std::string& name)> named;
    // Takes what each decision was made by, from all threads; may be empty.
    std::function<void(const Explanation&)> explain = {};
    // For planners that need derivatives; empty where the text of the problem is not at hand.
    solvers::DerivativesSource derivatives = {};
};

// Throws a Failure where the planner does not take the problem. The simulator must outlive it.
solvers::Policy planner_policy(const rddl_simulator& simulator, const std::string& policy,
                               const PolicySettings& settings);

}  // namespace rddlc::planners
