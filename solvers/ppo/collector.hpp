// Some of the environments, stepped by one thread with the policy as it is.
#pragma once

#include "solvers/batches/batch.hpp"
#include "solvers/files/archive.hpp"
#include "solvers/ppo/curiosity.hpp"
#include "solvers/ppo/experience.hpp"
#include "solvers/ppo/memories.hpp"
#include "solvers/ppo/state_noise.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <vector>

namespace rddlc::solvers {

struct FinishedEpisode {
    double undiscounted_return, discounted_return;
    std::int64_t length;
    std::uint8_t causes;
};

// [first, first + count) of the environments of this process, which begin at `origin` of those of
// all.
struct EnvironmentShare {
    std::int64_t first, count, origin = 0;
};

class Collector {
  public:
    // All that is referred to must outlive this.
    Collector(const rddl_simulator& simulator, const PpoModel& model, const PpoOptions& options,
              const EnvironmentShare& share);

    // New random numbers for what follows, which depend on seed, update and environment only.
    void begin_update(std::uint64_t seed, std::int64_t update);
    // `rollout` steps of its environments, into their places.
    void collect(Experience& experience, std::uint64_t seed, std::int64_t update);

    // Since begin_update(), environment by environment: features about the normaliser's means as
    // they are.
    const std::vector<Moments>& feature_moments() const { return feature_moments_; }
    const std::vector<FinishedEpisode>& finished() const { return finished_; }
    std::int64_t repaired() const { return distribution_.repaired(); }
    double simulator_seconds() const { return simulator_seconds_; }

    // All that a run needs to continue as if it had not stopped.
    template <class Archive>
    void archive(Archive& archive);

  private:
    void act(Experience& experience, std::int64_t step, std::uint64_t seed, std::int64_t update);
    void step(Experience& experience, std::int64_t step);
    void estimate_values(Experience& experience);
    void note_memories(Experience& experience, int part);
    float value_of(std::int64_t e, const float* features);
    void count_features(std::size_t e);
    Failure not_finite(std::size_t e) const;  // of the reward

    const rddl_simulator& simulator_;
    const PpoModel& model_;
    const PpoOptions& options_;
    double gamma_;
    bool bootstraps_;
    std::int64_t first_, count_, origin_;
    BatchHandle batch_;
    ActionDistribution distribution_;
    StateNoise state_noise_;
    Memories memories_;
    Seen seen_;
    std::vector<float> features_;      // rows as they are, of each environment
    std::vector<float> observations_;  // rows of the simulator's values
    std::vector<float> final_observations_, final_features_, inputs_;
    std::vector<float> actions_, activations_, outputs_;
    std::vector<double> rewards_;
    std::vector<std::uint8_t> terminated_, truncated_, causes_;
    std::vector<std::int64_t> steps_;  // of the episode
    std::vector<double> running_returns_, sums_, discounted_sums_, discounts_;
    std::vector<Moments> feature_moments_;
    std::vector<FinishedEpisode> finished_;
    std::vector<std::uint64_t> seeds_;
    double simulator_seconds_ = 0;
};

}  // namespace rddlc::solvers
