// The optimal value and policy of a MarkovModel: by backward induction over the steps that are left
// (Bellman, 1957), or by value iteration if there is no horizon.
#pragma once

#include "exact/markov_model.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::workbench {

// The best action of a state when `left` steps are left, or more, up to the `left` of the next
// entry.
struct PolicyEntry {
    std::uint32_t left;
    std::uint32_t action;  // of MarkovModel::actions
};

struct Optimum {
    std::int64_t horizon = 0;  // 0: none
    double value = 0;          // of the start: the expected sum of discounted rewards
    double error = 0;          // by which it may be wrong, besides rounding: without a horizon
    std::int64_t sweeps = 0;   // over all states
    // Entries of state s are first[s] .. first[s + 1], by ascending `left`; without a horizon there
    // is one.
    std::vector<std::uint64_t> first;
    std::vector<PolicyEntry> entries;
};

// A horizon of 0 means none; then the discount must be less than 1. Throws a Failure. The result is
// the same on any number of threads.
Optimum optimum_of(const MarkovModel& model, std::int64_t horizon, double discount, int threads);

}  // namespace rddlc::workbench
