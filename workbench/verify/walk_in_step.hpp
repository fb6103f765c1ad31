// Several engines side by side: the same environments under the same actions, compared step by
// step.
#pragma once

#include "rollouts/rollouts.hpp"
#include "rollouts/step_outcome.hpp"
#include "verify/blame_pass.hpp"
#include "verify/verified_engine.hpp"
#include "verify/verified_states.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::workbench {

struct WalkOptions {
    std::int64_t environments = 19;
    std::uint64_t seed = 0;
    std::int64_t steps = 0;  // of all environments together, about
    std::chrono::steady_clock::time_point end = std::chrono::steady_clock::time_point::max();
    Policy policy = Policy::Random;       // who acts
    std::vector<RecordedState> recorded;  // if any, each is stepped from once, and nothing else
    std::size_t most_samples = 0;
    bool progress = false;
};

// A step of the first engine, to compare it with those of other programs.
struct StepSample {
    StepStart start;
    StepOutcome outcome;
};

struct Disagreement {
    std::size_t engine;  // which differs from its reference
    Difference difference;
    StepStart start;
};

struct Walk {
    ValueCounts counts;
    std::int64_t steps = 0;
    std::int64_t episodes = 0;       // begun in the initial state
    std::int64_t random_states = 0;  // stepped from
    std::int64_t recorded_states = 0;
    std::optional<Disagreement> disagreement;
    std::vector<StepSample> samples;  // drawn from all steps of episodes and recorded states
    bool interrupted = false;
};

// Half of the environments run whole episodes from the initial state, half are put into a random
// state before each step. Every fourth step skips the precondition check. The engines must be of
// the same problem; each is compared with an earlier one, the first with no engine.
Walk walk_in_step(const std::vector<VerifiedEngine>& engines, const OutcomeComparison& comparison,
                  const WalkOptions& options);

}  // namespace rddlc::workbench
