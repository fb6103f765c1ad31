// Policies of PPO for other programs.
#pragma once

#include "solvers/ppo/model.hpp"

#include <string>

namespace rddlc::solvers {

// A C++ header with a function that writes what the network says of one environment: means of
// reals, then logits. Needs nothing but <cmath>; the normaliser is in it.
std::string ppo_policy_cpp(const PpoModel& model);

// An ONNX model (opset 13) with the same function, for batches: "features" to "outputs".
std::string ppo_policy_onnx(const PpoModel& model);

}  // namespace rddlc::solvers
