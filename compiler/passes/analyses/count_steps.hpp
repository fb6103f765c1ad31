// Counts that a walk up their distribution function finds, as thresholds of the uniform number that
// it begins with. Each step of the walk rounds, but never falls where the number grows, so the
// count does not either: bisection finds the least number with each count.
#pragma once

#include "vocabulary/vocabulary.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::passes {

// A walk has at most so many thresholds.
inline constexpr std::size_t most_count_steps = 48;

struct CountSteps {
    // By row of parameters: the least numbers with which the count is at least 1, 2, ... Rows are
    // equally long; what no number reaches is 1.
    std::vector<std::vector<double>> thresholds;
    std::int64_t last;  // the count of a number that reaches all thresholds of its row
    bool are_failures;  // Binomial: those that are counted
};

bool has_count_steps(Distribution distribution);

// Nothing if some parameters are wrong, or so large that the count is not found by a walk; or if
// successes are drawn for some and failures for others. Those are drawn that are rarer.
std::optional<CountSteps> counts_by_inversion(Distribution distribution,
                                              const std::vector<std::vector<double>>& parameters);

}  // namespace rddlc::passes
