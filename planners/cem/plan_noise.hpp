// Noise of many plans side by side, correlated from step to step: a plan that changes its mind in
// each step gets nowhere.
#pragma once

#include "planners/cem/plan_loops.hpp"
#include "planners/simulation/random_stream.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::planners {

class PlanNoise {
  public:
    // The noise of plan p has the correlation correlations[p % correlations.size()]. That of its
    // ranks changes more slowly from plan to plan, so that there is each of both together.
    PlanNoise(std::size_t plans, const solvers::ActionSpace& space,
              std::span<const double> correlations);

    // The plans begin again: the next step depends on nothing before it.
    void restart(RandomStream& stream);
    // Writes the numbers of a step, for an even number of plans: the reals of one plan after the
    // other. Their noise has mean 0 and deviation 1, between -3 and 3: an autoregressive process of
    // sums of three uniform numbers, since a search needs no tails. Plans in the second half of a
    // population are mirror images of those in the first half, so that one draw serves two numbers.
    void next_numbers(RandomStream& stream, const NumberScales& scales, float* numbers);
    // Draws the ranks of a step.
    void next_ranks(RandomStream& stream);

    // How wide the noise of a real is in each pair of plans where numbers have no bounds, so that
    // it is not known how large they have to be: as often more than 1 as less, and more than 7 in
    // one plan of ten. Each real is narrow in some plans, so that its costs do not hide what the
    // others gain. Plans side by side are about as wide: where wide ones end early, or leave the
    // numbers that engines are fast with, whole blocks of environments do.
    const float* widths() const { return widths_.data() + row_of_widths_ * values_.size(); }
    // Plans that do what is usual most of the time: below the habit of a plan its rank says so, and
    // the others have to be stretched by that much over all ranks. The habit of every other plan is
    // 0; those between depart from what is usual once in 1 to 128 steps.
    const std::int32_t* habits() const { return habits_.data(); }
    const float* stretches() const { return stretches_.data(); }
    // Each plan has a uniform number in 0 .. rank_count - 1. It is that of the step before with the
    // probability of the correlation, else a new one: so ranks are uniform in each step.
    const std::int32_t* ranks(std::size_t rank) const { return ranks_.data() + rank * plans_; }

  private:
    void draw_widths(const solvers::ActionSpace& space);

    const PlanLoops& loops_;
    const std::size_t plans_, pairs_;
    bool is_first_numbers_ = true, is_first_ranks_ = true;
    Aligned<float> old_, fresh_;       // weights: [pair][real]
    std::vector<std::uint32_t> keep_;  // the probability of an old rank, in 256ths, by plan
    Aligned<float> nothing_, all_;     // the same of first steps
    Aligned<float> widths_;            // [row][pair][real]
    std::size_t rows_of_widths_ = 1, row_of_widths_ = 0;
    std::vector<std::uint32_t> no_chance_;
    std::vector<std::int32_t> habits_;
    std::vector<float> stretches_;
    Aligned<float> values_;            // [pair][real]
    std::vector<std::int32_t> ranks_;  // [rank][plan]
};

}  // namespace rddlc::planners
