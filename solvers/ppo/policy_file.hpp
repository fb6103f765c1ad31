// Policies of PPO as JSON (docs/solvers.md describes it).
#pragma once

#include "solvers/ppo/model.hpp"
#include "support/memory.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace rddlc::solvers {

// The version that is written. Versions 1 to 5 are read as well: they have fewer members, and those
// up to 4 call max_sub_actions picks.
inline constexpr int policy_file_version = 6;

std::string ppo_policy_text(const rddl_simulator& simulator, const PpoModel& model);

// Throws a Failure with a sentence if the text is not a policy, or is incomplete, of a newer
// version, or of another problem; and if reading it takes more than the limit, or it holds a number
// that a network may not have.
std::shared_ptr<const PpoModel> read_ppo_policy(const rddl_simulator& simulator,
                                                std::string_view text,
                                                std::int64_t memory_limit = default_memory_limit);

// The solver that a policy's text names: "ppo" or "drp". "ppo" where it is no such text.
std::string solver_of_network(std::string_view text);

}  // namespace rddlc::solvers
