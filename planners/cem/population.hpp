// Plans of actions as a search sees them: the learner's numbers for reals, and categories or
// sub-actions (solvers/spaces).
#pragma once

#include "planners/cem/plan_loops.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::planners {

// One plan by itself.
struct Plan {
    std::vector<float> numbers;         // rows of real_count
    std::vector<std::int32_t> indices;  // rows of index_count
};

// Many plans side by side: all that is done to a value of one plan is done to that of all others in
// the same loop. Reals lie as in records of actions, one plan after the other; each index has a row
// of its own.
class Population {
  public:
    Population(std::size_t plans, int reals, int indices)
        : plans_(plans),
          row_size_((plans + 1) / 2 * 2 * static_cast<std::size_t>(reals)),
          reals_(static_cast<std::size_t>(reals)),
          indices_(static_cast<std::size_t>(indices)) {}

    // The plans get so many steps. Their values are any until they are written.
    void set_steps(std::int64_t steps) {
        steps_ = static_cast<std::size_t>(steps);
        number_values_.resize(steps_ * row_size_ + slack);
        index_values_.resize(steps_ * indices_ * plans_);
    }
    std::size_t plans() const { return plans_; }
    std::size_t steps() const { return steps_; }

    std::size_t reals() const { return reals_; }

    // All numbers of a step, one plan after the other. There is room for an even number of plans,
    // since noise is drawn for pairs.
    float* numbers(std::size_t step) { return number_values_.data() + step * row_size_; }
    const float* numbers(std::size_t step) const {
        return number_values_.data() + step * row_size_;
    }
    // An index of a step, of all plans.
    std::int32_t* indices(std::size_t step, std::size_t index) {
        return index_values_.data() + (step * indices_ + index) * plans_;
    }
    const std::int32_t* indices(std::size_t step, std::size_t index) const {
        return index_values_.data() + (step * indices_ + index) * plans_;
    }

    // Copies the first steps of a plan that has at least as many.
    void put(std::size_t plan, const Plan& from) {
        for (std::size_t t = 0; t < steps_; ++t)
            copy_few(from.numbers.data() + t * reals_, numbers(t) + plan * reals_);
        for (std::size_t k = 0; k < steps_ * indices_; ++k)
            index_values_[k * plans_ + plan] = from.indices[k];
    }
    void get(std::size_t plan, Plan& to) const {
        for (std::size_t t = 0; t < steps_; ++t)
            copy_few(numbers(t) + plan * reals_, to.numbers.data() + t * reals_);
        for (std::size_t k = 0; k < steps_ * indices_; ++k)
            to.indices[k] = index_values_[k * plans_ + plan];
    }

  private:
    // A call would take longer than the copy.
    void copy_few(const float* from, float* to) const {
        for (std::size_t r = 0; r < reals_; ++r) to[r] = from[r];
    }

    std::size_t plans_, row_size_, reals_, indices_, steps_ = 0;
    Aligned<float> number_values_;
    std::vector<std::int32_t> index_values_;
};

}  // namespace rddlc::planners
