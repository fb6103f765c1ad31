#include "solvers/policies/policy.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/policies/random_actions.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace rddlc::solvers {

namespace {

struct RandomActor {
    RandomActor(const rddl_simulator& simulator, std::uint64_t seed, std::int64_t environments)
        : policy(*simulator.problem, seed), actions(simulator, policy, environments) {}

    void act(Decision& decision) {
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

Policy random_policy(const rddl_simulator& simulator, std::uint64_t seed) {
    return {"random", [&simulator, seed](std::int64_t environments) -> Actor {
                const auto actor = std::make_shared<RandomActor>(simulator, seed, environments);
                return [actor](Decision& decision) {
                    actor->act(decision);
                };
            }};
}

Policy noop_policy(const rddl_simulator& simulator) {
    return {"noop", [problem = simulator.problem](std::int64_t) -> Actor {
                return [problem](Decision& decision) {
                    const auto* const action =
                        static_cast<const std::byte*>(problem->default_action);
                    for (std::size_t i = 0; i < decision.running.size(); ++i)
                        std::copy_n(
                            action, problem->action_size,
                            decision.actions + i * static_cast<std::size_t>(problem->action_size));
                };
            }};
}

Policy plan_policy(const rddl_simulator& simulator, std::string name,
                   std::vector<std::byte> actions) {
    const auto plan = std::make_shared<const std::vector<std::byte>>(std::move(actions));
    const auto act = [plan, problem = simulator.problem](Decision& decision) {
        const auto size = static_cast<std::size_t>(problem->action_size);
        for (std::size_t i = 0; i < decision.running.size(); ++i) {
            const auto at = static_cast<std::size_t>(decision.steps[i]) * size;
            const auto* const action = at + size <= plan->size()
                                           ? plan->data() + at
                                           : static_cast<const std::byte*>(problem->default_action);
            std::copy_n(action, size, decision.actions + i * size);
        }
    };
    return {std::move(name), [act](std::int64_t) -> Actor {
                return act;
            }};
}

Policy block_policy(const rddl_simulator& simulator) {
    return {"rddl", [&simulator](std::int64_t) -> Actor {
                return [&simulator](Decision& decision) {
                    require_done(simulator, simulator.policy_act(decision.batch, decision.actions));
                };
            }};
}

}  // namespace rddlc::solvers
