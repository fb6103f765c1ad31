// The action that gradients see: what a policy's network says, without draws and without choices.
//
// A real is the value of its number. A bool, or an int of few values, is its mean under the
// probabilities of its category. With sub-actions, each drawn by one set of probabilities p, a
// change is made with the probability 1 - (1 - p)^n that one of n draws chooses it. An object has
// no mean: the likeliest one is taken, without a derivative.
#pragma once

#include "solvers/gradients/step_derivatives.hpp"
#include "solvers/spaces/actions.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <span>
#include <vector>

namespace rddlc::solvers {

class RelaxedActions {
  public:
    // `space` must outlive it.
    RelaxedActions(const rddl_simulator& simulator, const ActionSpace& space);

    // Writes the action values of a lane, one for each column, from its row of the network's
    // outputs: numbers of reals, then logits.
    void write(const float* outputs, std::size_t lane, std::span<LaneNumbers> action);
    // The gradient by the outputs, given that by the values of the action. Overwrites `d_outputs`.
    void pull_back(const float* outputs, std::span<const LaneNumbers> d_action, std::size_t lane,
                   float* d_outputs);

  private:
    void find_probabilities(const float* logits, int first, int count);
    void write_sub_actions(const float* outputs, std::size_t lane, std::span<LaneNumbers> action);
    void pull_back_sub_actions(const float* outputs, std::span<const LaneNumbers> d_action,
                               std::size_t lane, float* d_outputs);
    // The gradient by logits, given that by their probabilities in d_probabilities_.
    void pull_back_probabilities(int first, int count, float* d_logits) const;
    void change(int column, double chance, std::size_t lane, std::span<LaneNumbers> action) const;
    // That one of the sub-actions is a choice of that probability, and the derivative.
    double chance(double p) const;
    double chance_slope(double p) const;
    double chosen_value(const Choice& choice, const float* outputs) const;
    double default_of(int column) const {
        return static_cast<double>(space_.defaults[static_cast<std::size_t>(column)]);
    }

    const ActionSpace& space_;
    std::vector<RealHead> reals_;                          // of ints not rounded
    std::vector<bool> is_object_;                          // of each column
    std::vector<double> probabilities_, d_probabilities_;  // of each logit
};

}  // namespace rddlc::solvers
