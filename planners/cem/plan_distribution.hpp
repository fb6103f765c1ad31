// The distribution that plans are drawn from: for each step normal numbers for reals, and
// probabilities for categories or sub-actions.
#pragma once

#include "planners/cem/plan_loops.hpp"
#include "planners/cem/plan_noise.hpp"
#include "planners/cem/population.hpp"
#include "planners/simulation/random_stream.hpp"
#include "solvers/spaces/actions.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::planners {

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
    // No more steps than that.
    void shorten(std::int64_t steps);
    // A step was made: the first one goes, the others are a bit wider again.
    void shift();
    // Goes to that plan, which has as many steps.
    void centre_on(const Plan& plan);
    std::int64_t steps() const { return steps_; }

    // Draws the first steps of all plans of the population, as many as it has.
    void draw(RandomStream& stream, PlanNoise& noise, Population& population);
    // The likeliest plan, of as many steps as the distribution has.
    void middle(Plan& plan) const;
    // Fits the first steps to some plans of a population, by weights whose sum is 1. It keeps the
    // share `memory` of its old parameters.
    void fit(const Population& population, std::span<const std::size_t> plans,
             std::span<const double> weights, double memory, bool keeps_deviations);

  private:
    void begin_steps(std::int64_t from);
    void widen();
    void draw_reals(std::size_t step, RandomStream& stream, PlanNoise& noise, float* numbers);
    void draw_index(std::size_t step, int first_logit, int count, std::int32_t usual,
                    const PlanNoise& noise, const std::int32_t* ranks, std::size_t plans,
                    std::int32_t* chosen);
    // The likeliest categories or sub-actions of a step.
    void write_usual(std::size_t step, std::int32_t* chosen) const;
    void leave_out_repetitions(std::size_t step, Population& population) const;
    void fit_reals(const Population& population, std::size_t step,
                   std::span<const std::size_t> plans, std::span<const double> weights,
                   double memory, bool keeps_deviations);
    void fit_indices(const Population& population, std::size_t step,
                     std::span<const std::size_t> plans, std::span<const double> weights,
                     double memory);
    std::size_t reals() const { return static_cast<std::size_t>(space_.real_count()); }
    std::size_t indices() const { return static_cast<std::size_t>(space_.index_count()); }
    std::size_t logits() const { return static_cast<std::size_t>(space_.logit_count); }

    const PlanLoops& loops_;
    const solvers::ActionSpace& space_;
    Spread spread_;
    std::int64_t steps_ = 0;
    std::vector<float> first_means_, first_probabilities_;  // of a step in a new episode
    std::vector<float> means_, deviations_;                 // rows of reals
    Aligned<float> least_, most_;                           // numbers of a row, repeated
    Aligned<float> repeated_means_, repeated_deviations_;   // of one row
    std::vector<double> sums_, squares_;                    // of one row, in a fit
    std::vector<float> probabilities_;                      // rows of logits
    std::vector<float> fitted_;                             // room for a row of logits
    std::vector<std::int32_t> thresholds_;                  // of ranks, between values
    std::vector<std::int32_t> defaults_;                    // indices of the default action
    std::vector<std::int32_t> usual_;                       // indices of a step
    std::vector<std::int32_t> stretched_;                   // ranks of plans
};

}  // namespace rddlc::planners
