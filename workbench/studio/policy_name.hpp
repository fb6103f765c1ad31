// The policies that users name on the page.
#pragma once

#include "learning/learned_policy.hpp"

#include <optional>
#include <string>

namespace rddlc::studio {

using workbench::is_block_file;

// The policy block that the problem must be loaded with: a file, or "" for that of the texts.
// Nothing for a policy that plays no block.
inline std::optional<std::string> block_of(const std::string& policy) {
    if (is_block_file(policy)) return policy;
    if (policy == "rddl") return "";
    return std::nullopt;
}

// The name in a problem that was loaded with the block.
inline std::string name_when_loaded(const std::string& policy) {
    return is_block_file(policy) ? "rddl" : policy;
}

}  // namespace rddlc::studio
