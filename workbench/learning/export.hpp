// Learned policies as text, for people and for other programs.
#pragma once

#include <rddl/simulator.h>

#include <cstdint>
#include <string>

namespace rddlc::workbench {

// `text` is a policy file of a solver. The forms of programs by CGP are formula, cpp, dot, svg, py
// and latex, those of networks by PPO json, cpp and onnx; empty is the first. Throws a Failure.
std::string exported_policy(const rddl_simulator& simulator, const std::string& text,
                            const std::string& form, std::int64_t memory_limit);

}  // namespace rddlc::workbench
