// The text form of the checked model, for --print=model and for tests.
#pragma once

#include "model/model.hpp"

#include <string>

namespace rddlc::model {

// Types, fluents with a summary of their values, CPFs in evaluation order with every cast, reward
// and conditions. The same model gives the same text.
std::string print(const Model& model);
// The same without the policy block.
std::string print_problem(const Model& model);

}  // namespace rddlc::model
