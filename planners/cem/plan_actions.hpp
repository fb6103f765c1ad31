// Actions of many plans at once, as records of the simulator.
#pragma once

#include "planners/cem/plan_loops.hpp"
#include "planners/cem/population.hpp"
#include "solvers/spaces/actions.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::planners {

// The numbers and indices that PlanActions writes as this row, as far as there are any.
void read_plan_action(const solvers::ActionSpace& space, const float* row, float* numbers,
                      std::int32_t* indices);

class PlanActions {
  public:
    // It writes at most so many plans at once. `space` and `records` must outlive it.
    PlanActions(const solvers::ActionSpace& space, const solvers::ActionRecords& records,
                std::size_t most_plans);

    // Writes the record of each of these plans (none: of all, in their order) for a step.
    void write(const Population& population, std::size_t step, std::span<const std::uint32_t> plans,
               std::byte* to);

  private:
    const float* numbers_of(const Population& population, std::size_t step);
    bool are_records(const solvers::ActionSpace& space) const;
    void write_real(std::size_t real, std::byte* to);
    void write_category(const solvers::CategoryHead& head, const std::int32_t* indices,
                        std::byte* to);
    void write_sub_actions(const Population& population, std::size_t step, std::byte* to);
    std::size_t plan_at(std::size_t place) const { return plans_.empty() ? place : plans_[place]; }

    const PlanLoops& loops_;
    const solvers::ActionSpace& space_;
    const solvers::ActionRecords& records_;
    RealScales scales_;
    std::vector<std::byte> blank_;  // default actions
    Aligned<float> numbers_;        // of the plans that are asked for, a row for each
    Aligned<double> values_;        // the same, unless rows of values are records
    bool values_are_records_;
    std::span<const std::uint32_t> plans_;
    std::size_t count_ = 0;
};

}  // namespace rddlc::planners
