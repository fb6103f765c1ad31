// Values and exact derivatives of a step, in several lanes at once.
//
// Derivatives go backward (reverse mode; Griewank and Walther, 2008). Reals are differentiated as
// they are. An operator without a useful derivative takes that of its relaxation, if asked to: at
// the exact forward values ("straight-through"; Bengio, Leonard and Courville, 2013), or at relaxed
// ones. docs/planning.md has the table of relaxations, whose formulas are those of JaxPlan
// (Gimelfarb, Taitler and Sanner, 2024). Without soft values all forward values are those of the
// other engines, bit for bit.
#pragma once

#include "autodiff/straight_line.hpp"
#include "vocabulary/kernels.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rddlc::autodiff {

inline constexpr std::size_t lanes = 8;
using Lane = std::array<double, lanes>;  // a number of each lane

enum class Mode : std::uint8_t {
    Exact,            // comparisons, roundings and draws of bools and ints have derivative 0
    StraightThrough,  // exact forward values, relaxed derivatives
    Soft,             // relaxed forward values as well
};
struct Relaxation {
    Mode mode = Mode::Exact;
    double sharpness = 10;  // of comparisons: sigmoid(sharpness * (a - b)) for a > b
    // Soft Bernoulli draws have it (Jang, Gu and Poole, 2017; Maddison, Mnih and Teh, 2017).
    double temperature = 1;
};

class Evaluation {
  public:
    // The program must outlive it.
    Evaluation(const StraightLine& program, const Relaxation& relaxation);

    // The memory of all slots.
    std::int64_t bytes() const {
        return static_cast<std::int64_t>((values_.size() + adjoints_.size()) * sizeof(Lane));
    }

    // Inputs of the next forward(): numbers of the state, then of the action.
    Lane& state(std::size_t number) { return values_[program_.state_slot(number)]; }
    Lane& action(std::size_t number) { return values_[program_.action_slot(number)]; }

    // Draws of lane k are those of an episode with keys[k], in the step that leaves timestep
    // `steps_made`.
    void forward(std::span<const rddl::StreamKey> keys, std::uint32_t steps_made);

    // Results of forward().
    const Lane& next(std::size_t number) const { return values_[program_.next[number]]; }
    const Lane& reward() const { return values_[program_.reward]; }
    // Exact also for a relaxed step: its bools are then true above one half, and a number that lies
    // on the bound of a condition is within it.
    bool is_over(std::size_t lane) const { return values_[program_.over][lane] > 0.5; }
    // A fault, or an int that is too large for a double: values of the lane mean nothing.
    bool has_failed(std::size_t lane) const { return failed_[lane]; }

    // Derivatives by each input of the sum of all results, each times its adjoint. A term that is
    // not finite counts as 0.
    void clear_adjoints();
    void add_next_adjoint(std::size_t number, const Lane& adjoint);
    void add_reward_adjoint(const Lane& adjoint);
    void backward();
    const Lane& state_adjoint(std::size_t number) const {
        return adjoints_[program_.state_slot(number)];
    }
    const Lane& action_adjoint(std::size_t number) const {
        return adjoints_[program_.action_slot(number)];
    }

  private:
    void compute(const Instruction& instruction, bool is_soft);
    void compute_each_lane(const Instruction& instruction, bool is_soft);
    void propagate(const Instruction& instruction);
    template <class Derivatives>
    void add_partials(const Instruction& instruction, const Derivatives& derivatives);
    bool propagate_real(const Instruction& instruction);
    template <class Terms>
    void add_lanes(Slot slot, const Terms& term);
    void propagate_relaxed(const Instruction& instruction);
    void propagate_others(const Instruction& instruction);
    void propagate_list(const Instruction& instruction, std::size_t lane);
    template <class Factor>
    void add_products_of_others(std::span<const Slot> operands, std::size_t lane, double g,
                                const Factor& factor);
    void add(Slot slot, std::size_t lane, double adjoint);

    const StraightLine& program_;
    Relaxation relaxation_;
    std::vector<Lane> values_, adjoints_;  // by slot
    std::array<Context, lanes> contexts_;
    std::array<bool, lanes> failed_{};
    std::vector<double> work_;  // of the operands of a list
};

// The value of an instruction without draws and faults, whose operands have these values.
double constant_value(const StraightLine& program, const Instruction& instruction,
                      const std::function<double(Slot)>& value);

}  // namespace rddlc::autodiff
