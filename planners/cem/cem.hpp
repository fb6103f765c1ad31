// plan:cem: model predictive control by sampling. Plans of actions are drawn from a distribution,
// played in one batch, and the distribution moves to those that were best: the cross-entropy method
// (Rubinstein, 1999), with the additions of iCEM (Pinneri and others, 2020).
#pragma once

#include "planners/cem/cem_options.hpp"
#include "planners/cem/near_search.hpp"
#include "planners/cem/novelty_search.hpp"
#include "planners/cem/plan_actions.hpp"
#include "planners/cem/plan_distribution.hpp"
#include "planners/cem/plan_loops.hpp"
#include "planners/cem/plan_noise.hpp"
#include "planners/cem/population.hpp"
#include "planners/planner/episode_memories.hpp"
#include "planners/planner/planner.hpp"
#include "planners/simulation/base_policy.hpp"
#include "planners/simulation/budget.hpp"
#include "planners/simulation/futures.hpp"
#include "planners/simulation/legal_actions.hpp"
#include "planners/simulation/random_stream.hpp"
#include "planners/simulation/value_tail.hpp"
#include "solvers/spaces/actions.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rddlc::planners {

// Plans whose comparison ends a decision, besides no-op, the policy and the middle.
inline constexpr std::size_t most_compared = 8;

class Cem : public Planner {
  public:
    Cem(const PlannerContext& context, const CemOptions& options);
    void decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) override;

  private:
    enum class Origin { Kept, Policy, Noop, Middle, Near, Sample };
    // The memory of an episode, from one decision to the next.
    struct Memory {
        Memory(const solvers::ActionSpace& space, Spread spread) : distribution(space, spread) {}
        Distribution distribution;
        std::vector<Plan> kept;                              // the best first
        std::vector<std::pair<double, double>> kept_values;  // and their errors
        std::size_t kept_count = 0;
        std::int64_t horizon = 0;
        // Populations, one after the other, of which nothing was better than doing nothing.
        std::int64_t fruitless = 0;
    };
    struct Choice {
        std::size_t plan;
        double value, error;
        std::int64_t trials;
    };

    Memory& memory_of(const DecisionPoint& point);
    void end_by_noop(Plan& plan, std::int64_t first, std::int64_t steps) const;
    void make_population(Memory& memory, const DecisionPoint& point, RandomStream& stream,
                         BudgetMeter& meter);
    void look_near(const DecisionPoint& point, BudgetMeter& meter);
    void begin_near(const Memory& memory, Plan& plan) const;
    void record_policy(const DecisionPoint& point, BudgetMeter& meter);
    // Plays these plans (none: all) in turn, lane after lane, as often as there are lanes for. The
    // steps that were made, fewer where time is up.
    std::int64_t play(const DecisionPoint& point, std::span<const std::uint32_t> plans,
                      std::int64_t steps, BudgetMeter& meter);
    void write_actions(std::span<const std::uint32_t> plans, std::size_t step);
    void note_first_actions(std::span<const std::uint32_t> plans);
    void play_tail(const DecisionPoint& point, std::int64_t steps, BudgetMeter& meter);
    void draw_streams(RandomStream& stream, std::size_t plans);
    void rank();
    void sort_best();
    void find_best(std::size_t wanted);
    void sort_first(std::size_t count);
    void add_others();
    std::size_t elites() const;
    bool is_above_median(double value) const;
    void rank_kept(const Memory& memory);
    void refit(Memory& memory);
    void keep_best(Memory& memory);
    // Where nothing is better than doing nothing, every other population is drawn as in a new
    // episode: the distribution goes to plans that do little.
    static bool is_fresh(const Memory& memory) { return memory.fruitless % 2 == 1; }
    // A better plan may lie further ahead, or where no noise around plans leads. Returns whether
    // there is a new plan to play.
    bool look_elsewhere(Memory& memory, const DecisionPoint& point, RandomStream& stream,
                        BudgetMeter& meter);
    void look_further(Memory& memory, std::int64_t most) const;
    bool look_for_rare_states(Memory& memory, const DecisionPoint& point, RandomStream& stream,
                              BudgetMeter& meter);
    Choice compare(const DecisionPoint& point, std::int64_t steps, RandomStream& stream,
                   BudgetMeter& meter);
    void note_candidates(Explanation& explanation, const Choice& chosen) const;
    const std::byte* first_action(std::size_t plan) const;
    void move_on(Memory& memory, std::int64_t left);

    const rddl_simulator& simulator_;
    const PlanLoops& loops_;
    CemOptions options_;
    std::int64_t batch_horizon_;  // as in PlannerContext
    solvers::ActionSpace space_;
    double near_part_;                         // of the budget and of the memory, for near plans
    std::int64_t memory_limit_;                // of all other plans
    std::optional<std::int64_t> steps_limit_;  // of all other plans in a decision
    solvers::ActionRecords records_;
    std::size_t population_, scenarios_, lanes_;
    Futures futures_;
    LegalActions legal_;
    std::optional<BasePolicy> base_, recorder_;  // of all lanes; of one environment
    std::optional<Futures> recording_;
    std::optional<NearSearch> near_;               // where many choices make an action
    std::optional<ValueTail> tail_;                // what follows plans, where it is by values
    std::optional<NoveltySearch> novelty_search_;  // where it was needed before
    EpisodeMemories<Memory> memories_;
    Distribution fresh_;                                 // of a new episode
    std::vector<float> default_numbers_, near_numbers_;  // of one action
    std::vector<std::int32_t> default_indices_, near_indices_;

    // The population, and one plan by itself.
    Population plans_;
    PlanNoise noise_;
    PlanActions plan_actions_;
    Plan plan_;
    std::vector<Origin> origins_;
    Aligned<double> values_;
    std::vector<double> errors_;
    double noop_value_ = 0;
    std::vector<std::size_t> order_;  // the best first; add_others() appends the others
    std::size_t ordered_ = 0;         // so many of these are in order
    double limit_ = 0;                // the best have greater values, unless those are too few
    std::vector<std::uint8_t> is_ordered_;  // by plan
    std::vector<std::byte> firsts_;         // action records of each plan's first step
    // The lanes.
    std::vector<std::uint64_t> streams_;
    std::vector<float> row_;  // of one action
    Aligned<std::byte> actions_;
    std::vector<std::uint8_t> by_policy_;
    // Buffers of a fit, and of a comparison.
    std::vector<std::size_t> fitted_;
    std::vector<double> weights_;
    std::vector<std::uint32_t> compared_;
    std::vector<double> compared_values_, compared_errors_;
};

}  // namespace rddlc::planners
