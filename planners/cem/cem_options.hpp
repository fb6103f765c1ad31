// Options of plan:cem.
#pragma once

#include "planners/planner/common_options.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace rddlc::planners {

enum class Weights { Elites, Mppi };
// Behind the horizon of plans, the policy plays on in the last comparison, or its values count in
// all of them.
enum class Tail { Policy, Value };

struct CemOptions : CommonOptions {
    int population = 256;
    std::optional<int> scenarios;  // random streams of each plan of actions
    double elites = 0.1;           // the part of the population that the next one is drawn like
    double correlation = -1;       // of noise between steps; below 0: a mixture
    double spread = 1;             // of the first population, in half widths of bounds
    double memory = 0.2;           // of a distribution for the one before it
    int kept = 8;                  // of the best plans, that come again
    Weights weights = Weights::Elites;
    double temperature = 0.2;    // of mppi, in deviations of the returns
    Tail tail = Tail::Policy;    // with a policy
    std::optional<double> near;  // part of the budget for plans of two steps
    const char* option_for_values() const { return tail == Tail::Value ? "tail=value" : nullptr; }
};

// The correlations of noise, for one plan after the other.
std::span<const double> correlations_of(const CemOptions& options);

const solvers::OptionTable<CemOptions>& cem_option_table();

}  // namespace rddlc::planners
