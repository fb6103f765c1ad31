// The functions of the structs Simulator and Policy, indented by one level.
#pragma once

#include "emit/cpp/tree.hpp"
#include "emit/lower/unit.hpp"

#include <string>
#include <vector>

namespace rddlc::cpp {

// The records by the names that the runtime looks for.
std::string record_aliases(const Unit& unit, const std::vector<std::string>& records = {
                                                 "State", "Action", "Scratch", "Observation"});

std::string reset_function(const Unit& unit);
std::string reward_function(const Unit& unit);
// Terminations, invariants and preconditions: what they say together, and a function for each.
std::string condition_functions(const Unit& unit);

// A function for each CPF, and the step that calls them.
struct StepFunctions {
    std::string step;
    std::string cpfs;
};
StepFunctions step_functions(const Unit& unit);

// Whether all reals of the state and the action are moderate that the program takes to be.
std::string moderate_test(const Unit& unit);

// The struct Policy; nothing if the program has no policy.
std::string policy(const Unit& unit);

// The assignments that fill a record with the initial or default values of its buffers; without
// those that are drawn.
tree::Block assignments(const Unit& unit, ir::Storage storage, const std::string& record);

}  // namespace rddlc::cpp
