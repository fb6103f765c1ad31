// A search for states that pay where nothing says which way they are: many environments go on side
// by side, step by step, and those that are where others are also go on from a rarer state instead.
// So they spread over the states that can be reached. It is a population of the explorer's that
// first returns and then explores (Go-Explore; Ecoffet and others, 2021), with all of its states at
// the same step.
#pragma once

#include "planners/cem/plan_actions.hpp"
#include "planners/cem/plan_distribution.hpp"
#include "planners/cem/plan_noise.hpp"
#include "planners/cem/population.hpp"
#include "planners/planner/planner.hpp"
#include "planners/simulation/budget.hpp"
#include "planners/simulation/futures.hpp"
#include "planners/simulation/legal_actions.hpp"
#include "planners/simulation/random_stream.hpp"
#include "planners/simulation/state_cells.hpp"
#include "solvers/spaces/actions.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rddlc::planners {

class NoveltySearch {
  public:
    // `simulator`, `space` and `records` must outlive it. The horizon is that of batches.
    NoveltySearch(const rddl_simulator& simulator, const solvers::ActionSpace& space,
                  const solvers::ActionRecords& records, std::span<const double> correlations,
                  std::int64_t lanes, std::int64_t horizon);

    std::int64_t lanes() const { return futures_.count(); }
    // Goes so many steps ahead. Writes the first steps of `best`, which has at least so many, and
    // returns its value. Nothing where time is up before, or each course faults.
    std::optional<double> run(const DecisionPoint& point, std::int64_t steps, RandomStream& stream,
                              BudgetMeter& meter, Plan& best);

  private:
    // A course that ends in that lane after so many steps.
    struct Course {
        double value;
        std::size_t lane;
        std::int64_t steps;
    };
    void begin(const DecisionPoint& point, std::int64_t steps, RandomStream& stream);
    void note_best(std::int64_t made, bool is_last);
    bool go_on(const DecisionPoint& point, std::int64_t made, RandomStream& stream);
    void find_rare(RandomStream& stream);
    void write_best(Plan& best) const;

    const rddl_simulator& simulator_;
    std::size_t state_size_, reals_, indices_;
    Futures futures_;
    LegalActions legal_;
    StateCells cells_;
    Distribution distribution_;
    PlanNoise noise_;
    Population population_;  // what each lane does
    PlanActions plan_actions_;
    double bins_ = 0;
    std::optional<Course> best_;
    std::vector<std::uint32_t> from_;  // [step][lane]: the lane from which it goes on
    std::vector<std::uint8_t> ran_;    // before the step
    std::vector<std::uint64_t> streams_, cell_of_;
    std::vector<std::int64_t> steps_;
    std::vector<std::byte> states_;
    Aligned<std::byte> actions_;
    std::vector<std::uint32_t> rare_;     // one lane of each cell, with the greatest value
    std::vector<std::int32_t> in_table_;  // a hash table of cells: a place in rare_; -1: empty
};

}  // namespace rddlc::planners
