// Learning a policy on the page, with the curve as it grows.
#pragma once

#include "studio/edited_problem.hpp"
#include "studio/job.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::studio {

struct TrainingRequest {
    std::string solver;                                         // "ppo" or "cgp"
    std::vector<std::string> options;                           // of the learner: "lr=0.001"
    std::vector<std::pair<std::string, std::string>> settings;  // of the simulator
    double seconds = 60;
    std::uint64_t seed = 0;
    std::filesystem::path folder;  // of the run, as `rddl train --out` has it; new
};

// The first folder runs/INSTANCE_SOLVER_SEED, or with a number behind it, that is not there.
std::filesystem::path new_run_folder(const std::string& instance, const std::string& solver,
                                     std::uint64_t seed);

// Throws a Failure that names a wrong option, before anything is compiled.
void require_options(const TrainingRequest& request);

// Returns the folder and what was reached. A stop leaves a run that `rddl train --resume`
// continues. Reports the curve so far: {"folder", "steps": [...], "seconds": [...], "learning":
// [...], "evaluation": [...]}, mean returns while it learned and of the evaluations. Numbers that
// are not known are null.
Json train(Job& job, const workbench::LoadedProblem& problem, const TrainingRequest& request);

}  // namespace rddlc::studio
