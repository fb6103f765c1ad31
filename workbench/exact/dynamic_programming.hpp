// The best that can be done in a MarkovModel: backward induction over the steps that are left
// (Bellman, 1957), or value iteration where there is no horizon.
#pragma once

#include "exact/markov_model.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::workbench {

// From so many steps left on, down to the next larger number, the action is the best one.
struct Decree {
    std::uint32_t left;
    std::uint32_t action;  // of MarkovModel::actions
};

struct Optimum {
    std::int64_t horizon = 0;  // 0: none
    double value = 0;          // of the start: the expected sum of discounted rewards
    double error = 0;          // by which it may be wrong, besides rounding: without a horizon
    std::int64_t sweeps = 0;   // over all states
    // Decrees of state s are first[s] .. first[s + 1], by ascending `left`; without a horizon there
    // is one.
    std::vector<std::uint64_t> first;
    std::vector<Decree> decrees;
};

// horizon: 0: none; then the discount has to be less than 1. Throws a Failure. The same on any
// number of threads.
Optimum optimum_of(const MarkovModel& model, std::int64_t horizon, double discount, int threads);

}  // namespace rddlc::workbench
