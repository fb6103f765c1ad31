// Plans of actions that go up the gradient of their return, many side by side.
#pragma once

#include "planners/gradient/action_parameters.hpp"
#include "solvers/batches/stops.hpp"
#include "solvers/gradients/step_derivatives.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::planners {

// The parameters of each step's action, one row after the other, with the averages of Adam (Kingma
// and Ba, 2015).
struct AscendingPlan {
    std::vector<double> parameters, mean, square;
    double value = 0;  // the return of the last evaluation
};

class Ascent {
  public:
    // Each plan is played in so many scenarios.
    Ascent(const ActionParameters& actions, solvers::StepDerivatives& derivatives,
           std::size_t scenarios, double discount);

    // One gradient of each plan, from a state that is reached after `steps_made` steps, and a step
    // of Adam up it. Scenario s draws by seeds[s]. False if `stops` says so: then nothing moved.
    bool improve(std::span<AscendingPlan* const> plans, std::span<const double> state,
                 std::int64_t steps_made, std::int64_t horizon,
                 std::span<const std::uint64_t> seeds, double rate, std::int64_t iteration,
                 const solvers::Stops* stops);

  private:
    using Lane = solvers::LaneNumbers;

    // A group of lanes: which plan and which scenario each has.
    void begin_group(std::size_t first, std::size_t lane_count,
                     std::span<const std::uint64_t> seeds);
    void write_actions(std::span<AscendingPlan* const> plans, std::size_t step);
    std::size_t play(std::span<AscendingPlan* const> plans, std::span<const double> state,
                     std::int64_t steps_made, std::size_t horizon, const solvers::Stops* stops);
    void pull_back(std::span<AscendingPlan* const> plans, std::int64_t steps_made,
                   std::size_t steps, const solvers::Stops* stops);
    void move(AscendingPlan& plan, std::span<const double> gradient, double rate,
              std::int64_t iteration);

    const ActionParameters& actions_;
    solvers::StepDerivatives& derivatives_;
    std::size_t scenarios_;
    double discount_;

    std::size_t group_first_ = 0, group_size_ = 0;
    std::vector<Lane> states_;         // of each step of the group, state_count() each
    std::vector<Lane> reward_weight_;  // of each step: its discount; 0 where the episode is over
    Lane returns_{};
    std::vector<double> row_;  // of one lane's action
    std::vector<Lane> action_, adjoint_, next_adjoint_, action_adjoint_;
    std::vector<double> values_;     // of all plans: their returns
    std::vector<double> gradients_;  // of all plans, a row of parameters for each
};

}  // namespace rddlc::planners
