// One pass of gradient descent over minibatches of an experience.
#pragma once

#include "solvers/ppo/experience.hpp"
#include "solvers/ppo/running_statistics.hpp"
#include "solvers/ppo/unrolled.hpp"
#include "solvers/ranks/ranks.hpp"

#include <rddl/batch/threads.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::solvers {

// About so many samples sum up their gradients in one place; then these sums are added in their
// order. So results do not depend on which thread has done which of them.
std::size_t samples_per_chunk(const PpoOptions& options);
// How many such places a minibatch has.
std::size_t gradient_count(const PpoOptions& options);

class Learner {
  public:
    // All that is referred to must outlive this. Changes the model's parameters.
    Learner(PpoModel& model, const PpoOptions& options, rddl::Team& team, const Ranks& ranks);

    struct Step {
        double learning_rate, entropy_weight, kl_penalty;
    };
    // One step down the gradient of the mean loss of all ranks' samples, whose advantages have
    // these moments about 0. Returns sums over all samples, or zeros if options.stops ended the
    // step before it was made; throws a Failure if the gradient is not finite.
    LossSums learn(const Experience& experience, std::span<const std::uint32_t> segments,
                   const Moments& advantages, const Step& step);

    // Moments of Adam, and how many steps it has made.
    std::vector<float> first_moments, second_moments;
    std::int64_t adam_steps = 0;

  private:
    // The buffers of one thread for a tile of samples.
    struct Tile {
        std::vector<float> numbers, shifts, spreads, log_probabilities, advantages, values, returns,
            log_deviations, d_log_deviations;
        std::vector<std::int32_t> indices;
        std::vector<std::uint8_t> masks;
        std::vector<float> policy_activations, value_activations, scratch, d_outputs, d_values;
    };
    // The buffers for a chunk of samples.
    struct Workplace {
        Tile tile;
        std::vector<std::uint32_t> samples;
        std::vector<float> inputs;  // of the networks
        Unrolled unrolled;
    };
    void gather(const Experience& experience, std::span<const std::uint32_t> samples,
                Tile& place) const;
    void learn_chunk(const Experience& experience, std::span<const std::uint32_t> segments,
                     const LossWeights& weights, Workplace& place, float* gradient,
                     LossSums& sums) const;
    // Learns from samples whose inputs are there. Adds the gradient by what is remembered to
    // d_memory.
    void learn_tile(const Experience& experience, std::span<const std::uint32_t> samples,
                    const LossWeights& weights, Tile& place, const float* inputs, float* d_memory,
                    float* gradient, LossSums& sums) const;

    bool is_stopped() const { return options_.stops && options_.stops(); }
    // Gradient and sums of all ranks, in one message.
    void add_up(std::vector<float>& gradient, LossSums& sums);

    PpoModel& model_;
    const PpoOptions& options_;
    rddl::Team& team_;
    const Ranks& ranks_;
    std::vector<Workplace> workplaces_;
    std::vector<float> policy_rows_, value_rows_, memory_rows_;  // transposed weights
    std::size_t segments_per_chunk_;
    std::vector<std::vector<float>> gradients_;  // of each chunk of a minibatch
    std::vector<LossSums> sums_;
    std::vector<float> weight_variances_;  // of noise that depends on the state
    std::vector<float> message_;           // to the other ranks
};

}  // namespace rddlc::solvers
