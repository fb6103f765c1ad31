// Exact gradients of the return of a deep reactive policy by the weights of its network: through
// all steps of its episodes, and through the network in each of them (Bueno, de Barros, Maua and
// Sanner, 2019).
#pragma once

#include "solvers/batches/batch.hpp"
#include "solvers/batches/stops.hpp"
#include "solvers/drp/relaxed_actions.hpp"
#include "solvers/gradients/step_derivatives.hpp"
#include "solvers/network/network.hpp"
#include "solvers/ppo/model.hpp"
#include "solvers/ppo/running_statistics.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::solvers {

class ReturnGradient {
  public:
    // All that is referred to must outlive this.
    // `sees_ends`: whether episodes end where the problem says so. Relaxed conditions do not tell.
    ReturnGradient(const rddl_simulator& simulator, const PpoModel& model,
                   StepDerivatives& derivatives, std::int64_t horizon, bool sees_ends);

    // The bytes that it takes, besides those of the derivatives.
    static double bytes(const PpoModel& model, const StepDerivatives& derivatives,
                        std::int64_t horizon);

    // Plays an episode in each lane, which draws by its seed, and adds the gradient of the sum of
    // their discounted returns by the policy's parameters, of which there are
    // model.policy.parameters, to `gradient`. Notes the features that were seen in `seen`, one for
    // each feature, about `normaliser.means`. Nothing means anything where `stops` says so.
    void add(std::span<const std::uint64_t, derivative_lanes> seeds, std::span<float> gradient,
             std::span<Moments> seen, const Stops& stops);

    // Results of the last call: discounted returns, and steps of all lanes.
    const LaneNumbers& returns() const { return returns_; }
    std::int64_t steps() const { return steps_; }

  private:
    void begin(std::span<const std::uint64_t, derivative_lanes> seeds);
    void act(std::size_t step);
    // The steps until the last episode ends.
    std::size_t play(std::span<Moments> seen, const Stops& stops);
    void pull_back(std::size_t steps, std::span<float> gradient, const Stops& stops);
    void pull_back_policy(std::span<float> gradient);
    std::span<LaneNumbers> state_of(std::size_t step) {
        return std::span(states_).subspan(step * state_count_, state_count_);
    }

    const rddl_simulator& simulator_;
    const PpoModel& model_;
    StepDerivatives& derivatives_;
    std::size_t horizon_, state_count_;
    bool sees_ends_;
    Network network_;  // as the policy's, with a gradient by its inputs
    RelaxedActions actions_;
    BatchHandle starts_;  // where episodes begin
    std::vector<std::byte> start_states_;
    std::vector<double> start_numbers_;

    std::vector<LaneNumbers> states_;         // of each step, state_count_ each
    std::vector<LaneNumbers> reward_weight_;  // of each step: its discount; 0: the episode is over
    LaneNumbers returns_{};
    std::int64_t steps_ = 0;
    std::vector<LaneNumbers> action_, adjoint_, next_adjoint_, action_adjoint_;
    // Rows of a lane each.
    std::vector<float> values_, features_, inputs_, activations_, scratch_, d_outputs_, d_inputs_;
    std::vector<float> rows_;  // transposed weights
};

}  // namespace rddlc::solvers
