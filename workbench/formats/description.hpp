// The description of a problem for readers and for programs.
#pragma once

#include "engines/load_simulator.hpp"
#include "model/model.hpp"
#include "problems/characteristics.hpp"
#include "problems/problem_lookup.hpp"
#include "solvers/spaces/refusals.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace rddlc::workbench {

struct ProblemDescription {
    ProblemFiles files;
    model::Model model;
    Characteristics characteristics;
    Simulator simulator;         // for bounds, offsets and sizes
    solvers::Refusals refusals;  // of learners
};

// Fails on errors in the files, which are printed.
ProblemDescription describe(const ProblemFiles& files);

// Tables, at most about 100 columns wide.
std::string description_text(const ProblemDescription& description);

nlohmann::ordered_json description_json(const ProblemDescription& description);

}  // namespace rddlc::workbench
