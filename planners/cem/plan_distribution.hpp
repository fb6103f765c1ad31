// Plans of actions as a search sees them, and the distribution that they are drawn from: for each
// step normal numbers for reals and probabilities for categories or sub-actions (solvers/spaces).
#pragma once

#include "planners/simulation/random_stream.hpp"
#include "solvers/spaces/actions.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::planners {

struct Plan {
    std::vector<float> numbers;         // rows of real_count
    std::vector<std::int32_t> indices;  // rows of index_count
};

struct Spread {
    double first = 1;      // deviation of reals in the first distribution
    double least = 0.05;   // to which a fit goes down
    double shifted = 0.2;  // of what was fitted a step before
};

class Distribution {
  public:
    Distribution(const solvers::ActionSpace& space, Spread spread);

    // Begins a new episode.
    void restart(std::int64_t steps);
    // More steps; those that are added are as in a new episode.
    void extend(std::int64_t steps);
    // A step was made: the first one goes, the others are a bit wider again.
    void shift();
    std::int64_t steps() const { return steps_; }

    // Needed before a draw.
    void prepare();
    // Noise of two steps has this correlation.
    void draw(RandomStream& stream, double correlation, Plan& plan) const;
    void middle(Plan& plan) const;
    // Fits the distribution to the plans, by weights whose sum is 1. It keeps the share `memory` of
    // its old parameters.
    void fit(std::span<const Plan* const> plans, std::span<const double> weights, double memory,
             bool keeps_deviations);

  private:
    void begin_steps(std::int64_t from);
    void draw_categories(const float* latent, const float* cumulative, std::int32_t* chosen) const;
    void draw_sub_actions(const float* latent, const float* cumulative, std::int32_t* chosen) const;
    void fit_reals(std::int64_t step, std::span<const Plan* const> plans,
                   std::span<const double> weights, double memory, bool keeps_deviations);
    void fit_indices(std::int64_t step, std::span<const Plan* const> plans,
                     std::span<const double> weights, double memory);
    std::size_t reals() const { return static_cast<std::size_t>(space_.real_count()); }
    std::size_t indices() const { return static_cast<std::size_t>(space_.index_count()); }
    std::size_t logits() const { return static_cast<std::size_t>(space_.logit_count); }

    const solvers::ActionSpace& space_;
    Spread spread_;
    std::int64_t steps_ = 0;
    std::vector<float> first_means_, first_probabilities_;  // of a step in a new episode
    std::vector<float> means_, deviations_;                 // rows of reals
    std::vector<float> probabilities_, cumulative_;         // rows of logits
    std::vector<float> fitted_;                             // room for a row of logits
    mutable std::vector<float> latent_;                     // noise of a step
};

}  // namespace rddlc::planners
