// Exact derivatives of a step, for planners and learners that follow gradients. The workbench makes
// them from the text of the problem; solvers and planners know this interface alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace rddlc::solvers {

// Steps of so many environments are differentiated side by side.
inline constexpr std::size_t derivative_lanes = 8;
using LaneNumbers = std::array<double, derivative_lanes>;

// The treatment of comparisons, roundings and draws of bools and ints, which have no derivative
// (docs/planning.md has the table).
struct Relaxation {
    enum class Mode : std::uint8_t {
        Exact,            // the derivative is 0
        StraightThrough,  // exact values, derivatives of the relaxed ones
        Soft,             // relaxed values: bools lie between 0 and 1
    } mode = Mode::Exact;
    double sharpness = 10;   // of the sigmoids that replace comparisons
    double temperature = 1;  // of soft draws of bools
};

// For one thread. A state and an action are rows of numbers, one for each value of their records;
// bools are 0 and 1, objects their index.
class StepDerivatives {
  public:
    virtual ~StepDerivatives() = default;

    virtual std::size_t state_count() const = 0;
    virtual std::size_t action_count() const = 0;
    // The memory of its values and derivatives.
    virtual std::int64_t bytes() const = 0;
    // Whether a relaxation makes a difference.
    virtual bool can_be_relaxed() const = 0;
    virtual void read_state(const std::byte* record, std::span<double> numbers) const = 0;

    // Lane k draws as an environment whose seed is seeds[k] does in its first episode.
    virtual void set_seeds(std::span<const std::uint64_t, derivative_lanes> seeds) = 0;

    // The step of each lane, which leaves timestep `steps_made` of its episode.
    virtual void step(std::int64_t steps_made, std::span<const LaneNumbers> state,
                      std::span<const LaneNumbers> action) = 0;
    // Results of the last step. Those of a lane that has failed, by a fault of the problem or an
    // int beyond 2^53, mean nothing.
    virtual void read_next(std::span<LaneNumbers> next) const = 0;
    virtual LaneNumbers reward() const = 0;
    virtual bool is_over(std::size_t lane) const = 0;
    virtual bool has_failed(std::size_t lane) const = 0;

    // The derivatives of sum_i next_adjoint[i] * next[i] + reward_adjoint * reward of the last
    // step, by its state and its action.
    virtual void pull_back(std::span<const LaneNumbers> next_adjoint,
                           const LaneNumbers& reward_adjoint, std::span<LaneNumbers> state_adjoint,
                           std::span<LaneNumbers> action_adjoint) = 0;
};

// Makes them; may be called from several threads. Throws a Failure where the problem has no
// derivatives.
using DerivativesSource = std::function<std::unique_ptr<StepDerivatives>(const Relaxation&)>;

}  // namespace rddlc::solvers
