// Characteristics of a problem that matter for the choice of a solver.
#pragma once

#include "model/model.hpp"

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace rddlc::workbench {

// The values of some fluents, counted by kind.
struct ValueKinds {
    std::int64_t bools = 0, ints = 0, objects = 0, reals = 0;

    std::int64_t total() const { return bools + ints + objects + reals; }
    // "discrete", "continuous", "mixed" or "none"
    std::string text() const;
};

struct Characteristics {
    std::vector<std::string> random_cpfs;  // "burning'", in evaluation order
    bool random_reward = false;
    bool random_initial_state = false;
    bool random_conditions = false;  // terminations, invariants or preconditions
    bool partially_observed = false;
    ValueKinds state, action, observation;
    std::optional<std::int64_t> max_nondef_actions;  // absent: no limit in effect
    std::int64_t preconditions = 0, invariants = 0, terminations = 0;
    std::set<std::string> distributions;
    // Parts of the language beyond Boolean logic and arithmetic: "interm-fluents", "switch", ...
    std::set<std::string> features;

    bool stochastic() const {
        return !random_cpfs.empty() || random_reward || random_conditions || random_initial_state;
    }
    // Several actions may differ from their default at once.
    bool concurrent() const;
};

Characteristics characteristics_of(const model::Model& model);

}  // namespace rddlc::workbench
