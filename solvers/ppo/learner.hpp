// One pass of gradient descent over minibatches of an experience.
#pragma once

#include "solvers/ppo/experience.hpp"
#include "solvers/ppo/running_statistics.hpp"
#include "solvers/ranks/ranks.hpp"

#include <rddl/threads.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::solvers {

class Learner {
  public:
    // All that is referred to must outlive this. Changes the model's parameters.
    Learner(PpoModel& model, const PpoOptions& options, rddl::Team& team, const Ranks& ranks);

    struct Step {
        double learning_rate, entropy_weight, kl_penalty;
    };
    // One step down the gradient of the mean loss of all ranks' samples, whose advantages have
    // these moments about 0. Returns sums over all samples; throws a Failure if the gradient is not
    // finite.
    LossSums learn(const Experience& experience, std::span<const std::uint32_t> samples,
                   const Moments& advantages, const Step& step);

    // Moments of Adam, and how many steps it has made.
    std::vector<float> first_moments, second_moments;
    std::int64_t adam_steps = 0;

  private:
    // What one thread needs for a tile of samples.
    struct Workplace {
        std::vector<float> features, numbers, shifts, spreads, log_probabilities, advantages,
            values, returns, log_deviations, d_log_deviations;
        std::vector<std::int32_t> indices;
        std::vector<std::uint8_t> masks;
        std::vector<float> policy_activations, value_activations, scratch, d_outputs, d_values;
    };
    void gather(const Experience& experience, std::span<const std::uint32_t> samples,
                Workplace& place) const;
    void learn_tile(const Experience& experience, std::span<const std::uint32_t> samples,
                    const LossWeights& weights, Workplace& place, float* gradient,
                    LossSums& sums) const;

    // Gradient and sums of all ranks, in one message.
    void add_up(std::vector<float>& gradient, LossSums& sums);

    PpoModel& model_;
    const PpoOptions& options_;
    rddl::Team& team_;
    const Ranks& ranks_;
    std::vector<Workplace> workplaces_;
    std::vector<float> policy_rows_, value_rows_;  // transposed weights
    std::vector<std::vector<float>> gradients_;    // of each chunk of a minibatch
    std::vector<LossSums> sums_;
    std::vector<float> weight_variances_;  // of noise that depends on the state
    std::vector<float> message_;           // to the other ranks
};

}  // namespace rddlc::solvers
