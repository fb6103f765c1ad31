// What learners do again and again allocates nothing.
#include "../counted_allocations.hpp"
#include "simulators.hpp"
#include "solvers/cgp/evaluator.hpp"
#include "solvers/ppo/trainer.hpp"

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
            trainer.update();  // warms up, too
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
