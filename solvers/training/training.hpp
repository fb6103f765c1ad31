// Training of any learner: its progress, its files, and when it ends.
#pragma once

#include "solvers/batches/stops.hpp"
#include "solvers/policies/policy.hpp"
#include "solvers/ranks/ranks.hpp"
#include "support/memory.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rddlc::solvers {

// The results of an update, under the names that Stable-Baselines3 has for them.
using Row = std::vector<std::pair<std::string, double>>;

// Options that change what is learned, as they are given: "--lr", "0.0003".
using Settings = std::vector<std::pair<std::string, std::string>>;

// A solver at work, as the training sees it.
struct Trainee {
    std::string solver;       // "ppo"
    Settings settings;        // a resumed run has the same
    std::string note;         // what it has chosen that users may not expect, or ""
    std::string advice;       // what to try if the policy is no better than no-op or random
    bool ends_early = false;  // update() does where TrainingOptions::stops says so
    // A run that its time ends is evaluated as often as others; if it is resumed with more time, it
    // is not the run that it would have been without an end.
    bool is_evaluated_by_time = false;
    // The first work of a new run. Returns a message about it; may be empty.
    std::function<std::string()> prepare = {};
    std::function<void()> update;         // a little more work
    // The same in a run that has a time: work that is_late ends. May be empty, where updates are
    // short.
    std::function<void(const Stops& is_late)> update_until = {};
    std::function<bool()> done;           // all that was asked for
    std::function<std::int64_t()> steps;  // made, or whatever progress is measured in
    std::function<double()> part_done;    // in [0, 1]
    std::function<Row()> row;
    std::function<std::string()> status;  // for the progress line
    std::function<std::string()> save;    // checkpoints
    std::function<void(std::string_view)> load;
    std::function<std::string()> policy_text;  // what a policy file holds,
    // Lines about what such a file holds; may be empty.
    std::function<std::string(std::string_view)> summary;
    std::function<double()> best_known;  // what it takes for the best return; may be empty
    std::function<Policy()> policy;      // and the policy itself
};

struct TrainingOptions {
    std::filesystem::path folder;
    bool resumes = false;
    double seconds = 0;                 // 0: no limit
    std::optional<double> stop_return;  // ends when an evaluation reaches it
    std::int64_t evaluations = 20;      // in all; the best policy of them is kept
    std::int64_t evaluation_episodes = 20;
    std::uint64_t seed = 0;
    Settings settings = {};                            // of the simulator, as those of the trainee
    std::int64_t memory_limit = default_memory_limit;  // bytes of a checkpoint that is read
    bool quiet = false;
    std::function<bool()> stops;  // Ctrl-C; may be empty
    // Sees each row of the log as it is added, with the steps and seconds so far; may be empty.
    std::function<void(std::int64_t steps, double seconds, const Row&)> see_row = {};
    Ranks ranks;  // which train together; the first one writes and reports
};

struct TrainingResult {
    bool interrupted = false;
    bool reached = false;  // stop_return
    double seconds = 0;
    bool has_best = false;  // false where an interrupt came before the first evaluation
    double best_return = 0, best_length = 0;  // mean of the best evaluation
    std::string best_policy;                  // of that evaluation, as its file holds it
    // A sentence where that policy is no better than no-op or random actions, else "".
    std::string no_better;
    std::int64_t episodes = 0, faulted = 0;  // of the last evaluation
    std::string first_fault;                 // of all of them; its message
    std::string not_finite;  // where the last evaluation's return is not: what has made it so
};

// A count in few digits: "1.5 M", "812".
std::string count_text(double count);

// ".cgp" or ".json": of policy files in the folder of a run.
std::string policy_extension(std::string_view solver);

// Files in the folder: policy.json (the best policy; .cgp for CGP), last.json, progress.csv,
// events.out.tfevents.rddl, run.json (the solver, the problem and the seed), checkpoint. All are
// written whole or not at all. Policies that a run of another solver has left there are removed
// once these are written. Throws a Failure if the folder holds another run, nothing to resume, or a
// run that another process continues; and at its end if no evaluation had a finite return.
TrainingResult train(const rddl_simulator& simulator, const Trainee& trainee,
                     const TrainingOptions& options);

}  // namespace rddlc::solvers
