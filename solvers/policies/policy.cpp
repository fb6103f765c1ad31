#include "solvers/policies/policy.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/files/fingerprint.hpp"
#include "solvers/policies/random_actions.hpp"
#include "solvers/spaces/actions.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace rddlc::solvers {

namespace {

struct RandomActor {
    RandomActor(const rddl_simulator& simulator, std::uint64_t seed, const Groups& groups,
                std::int64_t environments)
        : policy(*simulator.problem, seed, groups), actions(simulator, policy, environments) {}

    void act(Decision& decision) {
        actions.set_stops(decision.stops);
        actions.draw(
            decision.batch, decision.actions, [&](std::size_t i) { return decision.running[i]; },
            [&](std::size_t i) { return decision.episodes[i]; },
            [&](std::size_t i) { return decision.steps[i]; });
        for (std::size_t i = 0; i < decision.violated.size(); ++i)
            decision.violated[i] = actions.violated(i);
        decision.knows_violated = true;
    }

    RandomPolicy policy;
    RandomActions actions;
};

}  // namespace

void require_spaces(const Policy& policy, const rddl_simulator& simulator) {
    if (policy.spaces != spaces_of(simulator))
        throw Failure(
            fmt::format("the policy '{}' is of another problem than {} ({}): what is seen "
                        "or done differs",
                        policy.name, simulator.problem->instance, simulator.problem->domain));
}

Policy random_policy(const rddl_simulator& simulator, std::uint64_t seed) {
    // To repair an action of fewer bools takes less time than to find out which belong together.
    constexpr int many_bools = 256;
    const Groups groups = groups_without_limit(simulator, many_bools).value_or(Groups{});
    const auto start = [&simulator, seed, groups](std::int64_t environments) -> Actor {
        const auto actor = std::make_shared<RandomActor>(simulator, seed, groups, environments);
        return [actor](Decision& decision) {
            actor->act(decision);
        };
    };
    Policy policy{"random", spaces_of(simulator), start};
    policy.is_memoryless = true;
    return policy;
}

Policy noop_policy(const rddl_simulator& simulator) {
    const auto start = [problem = simulator.problem](std::int64_t environments) -> Actor {
        const auto* const action = static_cast<const std::byte*>(problem->default_action);
        std::vector<std::byte> rows;
        rows.reserve(static_cast<std::size_t>(environments * problem->action_size));
        for (std::int64_t i = 0; i < environments; ++i)
            rows.insert(rows.end(), action, action + problem->action_size);
        return [rows = std::move(rows), size = problem->action_size](Decision& decision) {
            const auto count = static_cast<std::int64_t>(decision.running.size());
            std::copy_n(rows.data(), count * size, decision.actions);
        };
    };
    Policy policy{"noop", spaces_of(simulator), start};
    policy.is_memoryless = true;
    policy.is_constant = true;
    return policy;
}

Policy plan_policy(const rddl_simulator& simulator, std::string name,
                   std::vector<std::vector<std::byte>> plans) {
    const auto count = static_cast<std::int64_t>(plans.size());
    const auto all = std::make_shared<const std::vector<std::vector<std::byte>>>(std::move(plans));
    const auto act = [all, count, problem = simulator.problem](Decision& decision) {
        const auto size = static_cast<std::size_t>(problem->action_size);
        for (std::size_t i = 0; i < decision.running.size(); ++i) {
            const auto& plan = (*all)[static_cast<std::size_t>(decision.episodes[i] % count)];
            const auto at = static_cast<std::size_t>(decision.steps[i]) * size;
            const auto* const action = at + size <= plan.size()
                                           ? plan.data() + at
                                           : static_cast<const std::byte*>(problem->default_action);
            std::copy_n(action, size, decision.actions + i * size);
        }
    };
    const auto start = [act](std::int64_t) -> Actor {
        return act;
    };
    return {std::move(name), spaces_of(simulator), start, count};
}

Policy block_policy(const rddl_simulator& simulator) {
    return {"rddl", spaces_of(simulator), [&simulator](std::int64_t) -> Actor {
                return [&simulator](Decision& decision) {
                    require_done(simulator, simulator.policy_act(decision.batch, decision.actions));
                };
            }};
}

}  // namespace rddlc::solvers
