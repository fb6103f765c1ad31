// plan:uct where trials find nothing better than to do nothing, as long as a goal lies behind costs
// or more steps away than the tree has: plans of plan:cem then share the budget with the tree.
#pragma once

#include "planners/cem/cem.hpp"
#include "planners/planner/episode_memories.hpp"
#include "planners/planner/planner.hpp"
#include "planners/simulation/budget.hpp"
#include "planners/simulation/futures.hpp"
#include "planners/uct/tree_search.hpp"
#include "planners/uct/uct_options.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace rddlc::planners {

class TreeAndPlans : public Planner {
  public:
    // Whether the options leave room for plans: they are wanted, no policy is given, and the budget
    // is not tiny.
    static bool is_of_use(const UctOptions& options);

    TreeAndPlans(const PlannerContext& context, const UctOptions& options,
                 std::unique_ptr<TreeSearch> tree);
    void decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) override;

  private:
    // The memory of an episode.
    struct Memory {
        int fruitless = 0;  // decisions in a row in which the tree found nothing; up to `patience`
    };
    void play_noop(const DecisionPoint& point);
    bool is_fruitless() const;
    void prefer_noop(std::byte* action, Explanation* explanation) const;
    bool find_plan(const DecisionPoint& point, std::byte* action, Explanation* explanation);

    PlannerContext context_;
    UctOptions options_;
    std::unique_ptr<TreeSearch> tree_;
    Futures noop_;
    std::unique_ptr<Cem> plans_;  // once they were needed
    EpisodeMemories<Memory> memories_;
    std::int64_t noop_steps_ = 0;
    std::vector<double> noop_returns_;  // the least ones, by steps
    std::vector<std::uint64_t> streams_;
    std::vector<std::byte> noop_actions_;
    std::vector<std::int32_t> violated_;  // by no-op
    Explanation plan_;
    std::vector<std::byte> first_action_;  // of the plan
};

}  // namespace rddlc::planners
