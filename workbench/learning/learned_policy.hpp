// Policies by the names that users give them.
#pragma once

#include "learning/planned_policy.hpp"
#include "solvers/policies/policy.hpp"
#include "support/memory.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

namespace rddlc::workbench {

// The file that holds the policy: the best one of a run's folder.
std::filesystem::path policy_file(const std::filesystem::path& path);
// Its bytes. Throws a Failure.
std::string policy_text(const std::filesystem::path& path);

// "FILE.rddl" is a file with a policy block. A problem is loaded with one block, which plays as the
// policy "rddl". The words of a planner may end with such a name too.
inline bool is_block_file(const std::string& policy) {
    return policy.ends_with(".rddl") && !planners::is_planner(policy);
}

// A policy file of a solver, the folder of a run, whose best policy it is, or the
// episodes of a trace (.jsonl).
bool is_learned_policy(const std::filesystem::path& path);
// The policy of a solver's file; `name` is the policy's. Throws a Failure. The simulator must
// outlive it.
solvers::Policy policy_of_text(const rddl_simulator& simulator, const std::string& text,
                               bool random, std::uint64_t seed, const std::string& name,
                               std::int64_t memory_limit = default_memory_limit);
// Throws a Failure that names the file. The simulator must outlive the policy.
solvers::Policy learned_policy(const rddl_simulator& simulator, const std::filesystem::path& path,
                               bool random, std::uint64_t seed,
                               std::int64_t memory_limit = default_memory_limit);

// Says on standard error where a trace has fewer episodes than play it.
void note_plans(const solvers::Policy& policy, std::int64_t episodes);

// "random", "noop", "rddl" (the policy block), a learned policy, a recorded plan or a planner.
solvers::Policy policy_named(const rddl_simulator& simulator, const std::string& name, bool random,
                             std::uint64_t seed, std::int64_t memory_limit = default_memory_limit,
                             const PlannerSettings& planning = {});

}  // namespace rddlc::workbench
