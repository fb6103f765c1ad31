// The repeated work of learners and planners allocates nothing.
#include "../counted_allocations.hpp"
#include "planners/cem/cem.hpp"
#include "planners/rollout/rollout.hpp"
#include "planners/uct/history_search.hpp"
#include "planners/uct/uct.hpp"
#include "simulators.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/cgp/evaluator.hpp"
#include "solvers/cgp/memory_estimate.hpp"
#include "solvers/ppo/memory_estimate.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainer.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace rddlc::solvers {
namespace {

TEST(Allocations, NoneInUpdatesOfPpo) {
    for (const rddl_simulator* simulator : simulators())
        for (const auto& [threads, recurrent] : {std::pair{1, 0}, {2, 0}, {1, 12}, {2, 12}}) {
            SCOPED_TRACE(simulator->problem->domain);
            PpoOptions options;
            options.environments = 16;
            options.rollout = 40;
            options.minibatch = 300;
            options.threads = threads;
            options.recurrent = recurrent;
            PpoTrainer trainer(*simulator, options);
            trainer.update();  // also warms up
            const std::int64_t before = allocations;
            std::int64_t episodes = 0;
            for (int i = 0; i < 5; ++i) {
                trainer.update();
                episodes += trainer.progress().episodes;
            }
            EXPECT_EQ(allocations, before);
            EXPECT_GT(episodes, 0);
        }
}

// A size that is refused is known before anything is allocated: each part of it in turn.
TEST(Allocations, OfPpoAreKnownBefore) {
    PpoOptions small;
    small.environments = 16;
    small.rollout = 40;
    small.minibatch = 300;
    small.hidden = {8, 8};
    std::vector<PpoOptions> all(8, small);
    all[0].environments = 4000;
    all[1].rollout = 8000;
    all[2].hidden = {500, 700};
    all[3].recurrent = 300;
    all[4].recurrent = 20;
    all[4].environments = 3000;
    all[5].noise = Noise::Sde;
    all[5].hidden = {8, 300};
    all[5].environments = 500;
    all[6].threads = 3;
    all[6].hidden = {1000, 8};
    all[7].observations.stack = 50;
    all[7].rollout = 2000;
    for (const rddl_simulator* simulator : simulators())
        for (const PpoOptions& options : all) {
            SCOPED_TRACE(simulator->problem->domain + fmt::format(", {}", &options - all.data()));
            const PpoModel model =
                model_without_parameters(observation_space(*simulator, options.observations),
                                         action_space(*simulator), options);
            const PpoMemory memory = memory_of(*simulator, model, options);
            const std::int64_t before = live_bytes;
            const PpoTrainer trainer(*simulator, options);
            const auto taken = static_cast<double>(live_bytes - before) +
                               4 * static_cast<double>(parameter_count(model));  // evaluations
            EXPECT_LT(taken, 1.1 * (memory.all() - memory.files) + 100'000);
            EXPECT_GT(taken, 0.9 * (memory.all() - memory.files) - 100'000);
        }
}

TEST(Allocations, OfCgpAreKnownBefore) {
    CgpOptions small;
    small.generations = 10;
    small.children = 4;
    small.nodes = 20;
    small.islands = 1;
    std::vector<CgpOptions> all(5, small);
    all[0].episodes = 1000;
    all[1].children = 600;
    all[2].nodes = 30'000;
    all[3].islands = 200;
    all[4].skdecide = true;
    all[4].children = 400;
    for (const rddl_simulator* simulator : simulators())
        for (CgpOptions& options : all) {
            SCOPED_TRACE(simulator->problem->domain + fmt::format(", {}", &options - all.data()));
            if (options.skdecide && simulator != simulators().front()) continue;
            if (options.episodes == 0) options.episodes = simulator->problem->stochastic ? 16 : 1;
            const std::int64_t before = live_bytes;
            CgpSearch search(*simulator, options);
            search.run(1);
            const double all_of_it =
                memory_of(*simulator, search.scope(), options, options.islands).all();
            const auto taken = static_cast<double>(live_bytes - before);
            EXPECT_LT(taken, 1.1 * all_of_it + 200'000);
            EXPECT_GT(taken, 0.25 * all_of_it - 200'000);
        }
}

TEST(Allocations, NoneInEpisodesOfPrograms) {
    for (const rddl_simulator* simulator : simulators()) {
        SCOPED_TRACE(simulator->problem->domain);
        const ProgramScope scope = program_scope(*simulator, Lifting::Auto, true, 3);
        const GenomeShape shape{scope.input_count(),  4, 50,
                                scope.output_count(), 0, default_functions()};
        Random random(7, 0);
        std::vector<Program> programs;
        for (int p = 0; p < 4; ++p) programs.emplace_back(random_genome(shape, random));
        std::vector<const Program*> pointers;
        for (const Program& program : programs) pointers.push_back(&program);
        Evaluator evaluator(*simulator, scope, 4, 3);
        const std::vector<std::uint64_t> seeds = {1, 2, 3};
        std::vector<double> returns(12), lengths(12);
        evaluator.evaluate(pointers, seeds, returns.data(), lengths.data());
        const std::int64_t before = allocations;
        for (int i = 0; i < 3; ++i)
            evaluator.evaluate(pointers, seeds, returns.data(), lengths.data());
        EXPECT_EQ(allocations, before);
        EXPECT_GT(lengths[0], 0);
    }
}

}  // namespace
}  // namespace rddlc::solvers

namespace rddlc::planners {
namespace {

// The allocations of a decision, after others of the same episode and of one before.
template <class ItsPlanner, class Options>
std::int64_t allocations_of(const rddl_simulator& simulator, Options options,
                            std::int64_t iterations, std::int64_t depth) {
    constexpr std::int64_t horizon = 40;
    options.budget.iterations = iterations;
    options.horizon = depth;
    ItsPlanner planner({.simulator = simulator,
                        .environments = 1,
                        .horizon = horizon,
                        .memory_limit = std::int64_t{1} << 30,
                        .base = solvers::noop_policy(simulator)},
                       options);
    rddl_batch_options batch_options{};
    batch_options.horizon = horizon;
    const solvers::BatchHandle batch = solvers::create_batch(simulator, batch_options);
    const auto* const noop = static_cast<const std::byte*>(simulator.problem->default_action);
    std::vector<std::byte> action(static_cast<std::size_t>(simulator.problem->action_size));
    std::int64_t made = 0;
    for (const std::int64_t episode : {0, 1})
        for (std::int64_t step = 0; step < 2; ++step) {
            DecisionPoint point{{batch.get(), 0}, 0, episode, step, horizon - step, horizon};
            point.base_action = noop;
            const std::int64_t before = allocations;
            planner.decide(point, action.data(), nullptr);
            made = allocations - before;
        }
    return made;
}

// Futures of more steps allocate no more, and each further round of trials or roll-outs only what
// the copies of environments for it take, and the growth of a tree.
TEST(Allocations, NoneInStepsOfPlanners) {
    CemOptions cem;
    cem.population = 16;
    RolloutOptions rollout;
    rollout.lanes = 16;
    UctOptions uct;
    uct.lanes = 8;
    // One allocation a step would be 40 in two rounds.
    constexpr std::int64_t of_round = 40, few = 10;
    for (const rddl_simulator* simulator : simulators()) {
        SCOPED_TRACE(simulator->problem->domain);
        EXPECT_LT(allocations_of<Cem>(*simulator, cem, 2, 24),
                  allocations_of<Cem>(*simulator, cem, 2, 4) + few);
        EXPECT_LT(allocations_of<Rollout>(*simulator, rollout, 2, 24),
                  allocations_of<Rollout>(*simulator, rollout, 2, 4) + few);
        EXPECT_LE(
            allocations_of<HistorySearch>(*simulator, uct, 12 * uct.lanes, 24),
            allocations_of<HistorySearch>(*simulator, uct, 2 * uct.lanes, 24) + 10 * of_round);
        if (Uct::can_list_actions(*simulator, uct)) {
            EXPECT_LE(allocations_of<Uct>(*simulator, uct, 12 * uct.lanes, 24),
                      allocations_of<Uct>(*simulator, uct, 2 * uct.lanes, 24) + 10 * of_round);
        }
    }
}

}  // namespace
}  // namespace rddlc::planners
