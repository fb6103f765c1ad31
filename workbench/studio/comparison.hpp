// Two policies with the same luck: episode e of both draws the same random numbers.
#pragma once

#include "studio/edited_problem.hpp"
#include "studio/job.hpp"

#include <array>
#include <cstdint>
#include <string>

namespace rddlc::studio {

struct ComparisonOptions {
    std::array<std::string, 2> policies;  // as users name them
    std::int64_t episodes = 100;
    std::uint64_t seed = 0;
    std::int64_t horizon = 0;  // steps; 0: the instance's
};

// The returns of both policies, and the mean difference (second minus first) of the episodes with
// its 95 % confidence interval. Reports which policy is at work and which part is done.
// `problems` differ in their policy blocks alone: each is loaded with that of its policy.
Json compare(Job& job, const std::array<workbench::LoadedProblem, 2>& problems,
             const ComparisonOptions& options);

}  // namespace rddlc::studio
