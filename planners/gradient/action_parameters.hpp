// Numbers that a gradient may move, and the values of an action that they mean.
//
// A real between two bounds has the parameter -1 at the lower one and 1 at the upper one. A bool is
// true with probability sigmoid(4 u), and takes part in gradients as that probability. Bools of
// which one at most may change share a softmax, in which no change has the parameter 0: a bool by
// itself is the case of one. Ints are between bounds as reals are, and rounded in the end. Objects
// stay at their defaults.
#pragma once

#include "solvers/spaces/actions.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::planners {

class ActionParameters {
  public:
    ActionParameters(const rddl_simulator& simulator, const solvers::ActionSpace& space);

    // One for each value of an action, in the order of its columns.
    std::size_t count() const { return kinds_.size(); }
    bool can_move(std::size_t i) const { return kinds_[i] != Kind::Fixed; }
    bool any_moves() const;
    bool is_bool(std::size_t i) const { return kinds_[i] == Kind::Bool; }
    // The parameters of the default action, with bools a little toward their other value.
    const std::vector<double>& defaults() const { return defaults_; }

    // The values of an action that take part in gradients.
    void values(std::span<const double> parameters, std::span<double> values) const;
    // Adds the derivatives of sum_i adjoint[i] * values[i] by the parameters.
    void pull_back(std::span<const double> parameters, std::span<const double> adjoint,
                   std::span<double> gradient) const;
    // Gives all bools of a group the greatest of their squared gradients, by which an ascent
    // divides: a change that is little better than the others is then not moved as far as the best
    // one.
    void share_scales(std::span<double> squares) const;
    // Moves the parameters of an action to where bounds hold, and where bools are expected to
    // differ from their defaults at most as often as max-nondef-actions allows (the projection of
    // SOGBOFA: Cui and Khardon, 2016).
    void project(std::span<double> parameters) const;
    // Values of the action; bools differ from their default if they are likelier to than this.
    // If only one of several bools may change, the likeliest one does. Where more values differ
    // than max-nondef-actions allows, the smallest changes are not made.
    void write(std::span<const double> parameters, double threshold, float* values) const;

  private:
    enum class Kind { Fixed, Real, Int, Bool };
    // Bools of which at most one differs from its default, or exactly one.
    struct Group {
        std::vector<std::size_t> members;
        bool may_be_none;
    };

    bool is_true_by_default(std::size_t i) const { return default_values_[i] > 0.5f; }
    double value(std::size_t i, double parameter) const;
    double slope(std::size_t i, double parameter) const;
    double change_logit(std::size_t i, double parameter) const;
    void write_chances(const Group& group, std::span<const double> parameters,
                       std::span<double> chances) const;
    void keep_likeliest(const Group& group, std::span<const double> parameters,
                        float* values) const;
    double chance_to_differ(std::size_t i, double parameter) const;
    double size_of_change(std::size_t i, double parameter) const;
    float written(std::size_t i, double parameter, double threshold) const;
    void limit_changes(std::span<double> parameters) const;

    std::vector<Kind> kinds_;
    std::vector<Group> groups_;
    std::vector<bool> is_in_group_;
    std::vector<solvers::RealHead> heads_;  // of Real and Int
    std::vector<double> defaults_;
    std::vector<float> default_values_;
    std::int64_t most_changes_;  // -1: any number
};

}  // namespace rddlc::planners
