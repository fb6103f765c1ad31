#include "planners/uct/tree_and_plans.hpp"

#include "planners/simulation/random_stream.hpp"
#include "planners/uct/search_rules.hpp"
#include "solvers/batches/batch.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace rddlc::planners {

using solvers::require_done;

namespace {

// Draws of what no-op is worth.
constexpr std::int64_t noop_draws = 4;
// No-op is not played for more steps, or a greater part of the budget.
constexpr std::int64_t longest_noop = 1000, least_parts = 10;
// With fewer steps or trials, the tree has all of them.
constexpr std::int64_t least_steps = 2000, trials_of_population = 1024;
// Where trials found nothing in so many decisions, plans have this part of the budget of the next
// one. A tree that is kept may find a way in the second or third decision, if it has all of the
// budget.
constexpr int patience = 3;
constexpr double plan_share = 0.75;
// Plans have a part of the memory as well.
constexpr std::int64_t parts_of_memory = 4;

// Plans that are played as often as trials would be.
CemOptions plan_options(const UctOptions& options) {
    CemOptions plans;
    static_cast<CommonOptions&>(plans) = options;
    plans.seed += 1;
    plans.budget = share_of(options.budget, plan_share);
    if (auto& populations = plans.budget.iterations)
        populations = std::max<std::int64_t>(1, *populations / trials_of_population);
    return plans;
}

PlannerContext plan_context(PlannerContext context) {
    context.memory_limit /= parts_of_memory;
    return context;
}

}  // namespace

bool TreeAndPlans::is_of_use(const UctOptions& options) {
    const Budget& budget = options.budget;
    return options.plans && options.policy.empty() &&
           budget.steps.value_or(least_steps) >= least_steps &&
           budget.iterations.value_or(trials_of_population) >= trials_of_population;
}

TreeAndPlans::TreeAndPlans(const PlannerContext& context, const UctOptions& options,
                           std::unique_ptr<TreeSearch> tree)
    : context_(context),
      options_(options),
      tree_(std::move(tree)),
      noop_(context.simulator, context.simulator.problem->stochastic ? noop_draws : 1,
            context.horizon),
      memories_(context.environments),
      streams_(static_cast<std::size_t>(noop_.count())),
      violated_(streams_.size(), -1),
      first_action_(static_cast<std::size_t>(context.simulator.problem->action_size)) {
    const auto* const action =
        static_cast<const std::byte*>(context.simulator.problem->default_action);
    for (std::int64_t k = 0; k < noop_.count(); ++k)
        noop_actions_.insert(noop_actions_.end(), action,
                             action + context.simulator.problem->action_size);
}

// Its least return for each number of steps, where it costs little to know.
void TreeAndPlans::play_noop(const DecisionPoint& point) {
    noop_returns_.clear();
    noop_steps_ = 0;
    const std::int64_t depth = std::min(point.left, options_.horizon.value_or(usual_depth));
    if (depth > longest_noop ||
        depth * noop_.count() * least_parts > options_.budget.steps.value_or(most_steps))
        return;
    RandomStream stream(options_.seed + 2, point.episode, point.step);
    for (std::uint64_t& each : streams_) each = stream.bits();
    noop_.begin(point.origin, streams_);
    require_done(context_.simulator, context_.simulator.violated_preconditions(
                                         noop_.batch(), noop_actions_.data(), violated_.data()));
    for (std::int64_t t = 0; t < depth; ++t) {
        if (noop_.any_running()) {
            noop_.step(noop_actions_.data());
            noop_steps_ += noop_.stepped();
        }
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < streams_.size(); ++k) least = std::min(least, noop_.value(k));
        noop_returns_.push_back(least);
    }
}

// The worst of several draws of no-op counts, since the values of trees are those of the best that
// came.
bool TreeAndPlans::is_fruitless() const {
    const TreeSearch::Found& found = tree_->found();
    if (!found.has_choice) return false;
    const auto depth = static_cast<std::size_t>(found.depth);
    return found.is_noop ||
           (depth <= noop_returns_.size() && found.value <= noop_returns_[depth - 1]);
}

// True: there is a plan that is better than no-op.
bool TreeAndPlans::find_plan(const DecisionPoint& point, std::byte* action,
                             Explanation* explanation) {
    if (!plans_) plans_ = std::make_unique<Cem>(plan_context(context_), plan_options(options_));
    plan_ = {};
    plans_->decide(point, first_action_.data(), &plan_);
    const auto& chosen = plan_.candidates.at(plan_.chosen);
    const auto noop =
        std::ranges::find(plan_.candidates, std::string("noop"), &Explanation::Candidate::name);
    const bool is_better =
        chosen.name != "noop" && noop != plan_.candidates.end() && chosen.value > noop->value;
    if (explanation) {
        explanation->steps += plan_.steps;
        if (is_better) {
            explanation->note.clear();  // it says why the tree was not searched
            explanation->depth = plan_.depth;
            explanation->chosen = explanation->candidates.size();
            explanation->candidates.push_back(chosen);
            explanation->candidates.back().name = "plan";
        }
    }
    if (is_better) std::ranges::copy(first_action_, action);
    return is_better;
}

// The values of a tree are means of all that it tried, where actions cannot be listed.
void TreeAndPlans::prefer_noop(std::byte* action, Explanation* explanation) const {
    const auto depth = static_cast<std::size_t>(tree_->found().depth);
    const bool is_legal = std::ranges::all_of(violated_, [](std::int32_t one) { return one < 0; });
    if (depth > noop_returns_.size() || !is_legal) return;
    const double value = noop_returns_[depth - 1];
    if (!(tree_->found().value < value)) return;
    const auto size = static_cast<std::ptrdiff_t>(context_.simulator.problem->action_size);
    std::copy_n(noop_actions_.begin(), size, action);
    if (!explanation) return;
    explanation->chosen = explanation->candidates.size();
    explanation->candidates.push_back(
        {"noop", {noop_actions_.begin(), noop_actions_.begin() + size}, value, 0, noop_.count()});
}

void TreeAndPlans::decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) {
    auto& memory = memories_.of(point);
    if (!memory) memory.emplace();
    play_noop(point);
    const bool has_plans = memory->fruitless >= patience;
    DecisionPoint its = point;
    its.steps_spent = noop_steps_;
    its.share = has_plans ? 1 - plan_share : 1;
    tree_->decide(its, action, explanation);
    memory->fruitless = is_fruitless() ? std::min(memory->fruitless + 1, patience) : 0;
    if (explanation) explanation->steps += noop_steps_;
    if (memory->fruitless == 0) return;
    its.share = 1;
    if (!has_plans || !find_plan(its, action, explanation)) prefer_noop(action, explanation);
}

}  // namespace rddlc::planners
