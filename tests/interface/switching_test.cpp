// The change from the interpreter to the compiled engine, at a moment that the test chooses.
#include "engines/background_build.hpp"
#include "engines/load_simulator.hpp"
#include "engines/switching_simulator.hpp"
#include "solvers/batches/batch.hpp"
#include "support/failure.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace rddlc::workbench {
namespace {

using Bytes = std::vector<std::byte>;

Simulator loaded_example(const std::string& name, Engine engine, const std::string& policy = "") {
    const auto folder = std::filesystem::path(RDDL_EXAMPLES) / name;
    ProblemFiles files;
    files.name = name;
    files.domain = folder / "domain.rddl";
    files.instance = folder / "instance.rddl";
    if (!policy.empty()) files.policy = folder / policy;
    LoadOptions options;
    options.engine = engine;
    options.quiet = true;
    options.details = true;
    return load_problem(files, options).simulator;
}

void wait_for(const std::atomic<bool>& flag, const std::stop_token& stop = {}) {
    while (!flag && !stop.stop_requested())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

// A simulator whose compiled one is ready when the test says so.
struct OnDemand {
    explicit OnDemand(const std::string& name, const std::string& policy = "")
        : interpreted(loaded_example(name, Engine::Interpreter, policy)),
          compiled(loaded_example(name, Engine::Compiled, policy)),
          build(std::make_shared<BackgroundBuild>(
              [this](const std::stop_token& stop) {
                  wait_for(is_wanted, stop);
                  return compiled;
              },
              [](const std::string&) {})),
          simulator(switching_simulator(interpreted, build)) {}

    void finish() {
        is_wanted = true;
        while (!build->is_settled()) std::this_thread::yield();
    }

    std::atomic<bool> is_wanted = false;
    Simulator interpreted, compiled;
    std::shared_ptr<BackgroundBuild> build;
    Simulator simulator;
};

rddl_batch_options few(std::int64_t count, bool keeps_steps) {
    rddl_batch_options options{};
    options.environment_count = count;
    options.seed = 7;
    options.first_environment = 3;
    options.autoreset = RDDL_AUTORESET_SAME_STEP;
    options.thread_count = 2;
    options.keeps_steps = keeps_steps;
    return options;
}

// Actions of each environment: a choice of its own, or what the policy says.
void choose(const rddl_simulator& simulator, rddl_batch* batch, std::int64_t count,
            std::int64_t time, bool by_policy, Bytes& actions) {
    if (by_policy) {
        ASSERT_EQ(simulator.policy_act(batch, actions.data()), RDDL_OK);
        return;
    }
    const std::int64_t choices = simulator.action_choice_count(&simulator);
    for (std::int64_t i = 0; i < count; ++i)
        ASSERT_EQ(
            simulator.action_choice(&simulator, (7 * time + i) % choices,
                                    actions.data() + i * simulator.problem->action_size, nullptr),
            RDDL_OK);
}

// Everything that can be asked after each step.
std::vector<Bytes> course(const rddl_simulator& simulator, rddl_batch* batch,
                          const rddl_batch_options& options, std::int64_t steps, bool by_policy,
                          const std::function<void(std::int64_t)>& before_step = {}) {
    const rddl_problem& problem = *simulator.problem;
    const std::int64_t count = options.environment_count;
    const auto bytes = [&](std::int64_t size) {
        return Bytes(static_cast<std::size_t>(count * size));
    };
    std::vector<Bytes> all;
    Bytes actions = bytes(problem.action_size);
    for (std::int64_t time = 0; time < steps; ++time) {
        if (before_step) before_step(time);
        choose(simulator, batch, count, time, by_policy, actions);
        Bytes observations = bytes(problem.observation_size), rewards = bytes(8), causes = bytes(1),
              states = bytes(problem.state_size), ends = bytes(16),
              interm = bytes(problem.interm_size);
        rddl_transition out{};
        out.observations = observations.data();
        out.rewards = reinterpret_cast<double*>(rewards.data());
        out.causes = reinterpret_cast<std::uint8_t*>(causes.data());
        EXPECT_EQ(simulator.step(batch, actions.data(), &out), RDDL_OK);
        EXPECT_EQ(simulator.get_state(batch, 0, count, states.data()), RDDL_OK);
        auto* const progress = reinterpret_cast<std::int64_t*>(ends.data());
        EXPECT_EQ(simulator.get_progress(batch, 0, count, progress, progress + count), RDDL_OK);
        if (options.keeps_steps) {
            EXPECT_EQ(simulator.get_interm(batch, 0, count, interm.data()), RDDL_OK);
        }
        for (Bytes* const part :
             {&actions, &observations, &rewards, &causes, &states, &ends, &interm})
            all.push_back(*part);
    }
    return all;
}

void expect_the_same_course(const std::string& name, std::int64_t count, bool keeps_steps,
                            const std::string& policy = "") {
    constexpr std::int64_t steps = 30;
    const Simulator interpreted = loaded_example(name, Engine::Interpreter, policy);
    const rddl_batch_options options = few(count, keeps_steps);
    const solvers::BatchHandle alone = solvers::create_batch(*interpreted, options);
    const bool by_policy = interpreted->policy != nullptr;
    const auto expected = course(*interpreted, alone.get(), options, steps, by_policy);
    for (const std::int64_t change : {0, 1, 13, 29}) {
        OnDemand on_demand(name, policy);
        const solvers::BatchHandle batch = solvers::create_batch(*on_demand.simulator, options);
        const auto found = course(*on_demand.simulator, batch.get(), options, steps, by_policy,
                                  [&](std::int64_t time) {
                                      if (time == change) on_demand.finish();
                                  });
        EXPECT_EQ(found, expected) << name << ", " << count << " environments, step " << change;
    }
}

TEST(Switching, ChangesNoBitOfAnEpisode) {
    for (const char* const name : {"mountain_car", "network", "reservoir", "delivery"})
        expect_the_same_course(name, 1, true);
}
TEST(Switching, ChangesNoBitOfABatch) {
    for (const char* const name : {"network", "reservoir", "robot"})
        expect_the_same_course(name, 21, false);
}
TEST(Switching, TakesObservationsAndAPolicysMemoryAlong) {
    expect_the_same_course("t_maze", 3, false);
    expect_the_same_course("reservoir", 1, false, "policy.rddl");
}

TEST(Switching, CopiesBetweenEngines) {
    OnDemand on_demand("reservoir");
    const Simulator& simulator = on_demand.simulator;
    const rddl_batch_options options = few(4, true);
    const solvers::BatchHandle before = solvers::create_batch(*simulator, options);
    course(*simulator, before.get(), options, 9, false);
    on_demand.finish();
    const solvers::BatchHandle compiled = solvers::create_batch(*simulator, options);
    // Nothing has changed `before` since then: it is interpreted.
    const std::int64_t sources[] = {0, 1, 2, 3};
    ASSERT_EQ(simulator->copy_environments(compiled.get(), 0, 4, before.get(), sources), RDDL_OK);
    const solvers::BatchHandle copy(simulator->copy(before.get()), simulator->destroy);
    const auto expected = course(*simulator, before.get(), options, 9, false);
    EXPECT_EQ(course(*simulator, compiled.get(), options, 9, false), expected);
    EXPECT_EQ(course(*simulator, copy.get(), options, 9, false), expected);
    EXPECT_EQ(simulator->copy_environments(compiled.get(), 3, 2, before.get(), sources),
              RDDL_BAD_ARGUMENT);
}

TEST(Switching, RefusesWithTheReasonOfItsEngine) {
    OnDemand on_demand("reservoir");
    const Simulator& simulator = on_demand.simulator;
    const solvers::BatchHandle batch = solvers::create_batch(*simulator, few(4, false));
    const rddl_transition nothing{};
    for (int k = 0; k < 2; ++k) {
        EXPECT_EQ(simulator->step(batch.get(), nullptr, &nothing), RDDL_BAD_ARGUMENT);
        const std::string step = simulator->last_error(simulator.get());
        EXPECT_NE(step.find("action"), std::string::npos) << step;
        double record[64];
        EXPECT_EQ(simulator->get_state(batch.get(), 3, 2, record), RDDL_BAD_ARGUMENT);
        EXPECT_STREQ(simulator->last_error(simulator.get()),
                     "there are no 2 environments from 3 on among 4");
        on_demand.finish();
    }
    EXPECT_EQ(simulator->create(nullptr, nullptr), nullptr);
    EXPECT_EQ(simulator->step(nullptr, nullptr, &nothing), RDDL_BAD_ARGUMENT);
    rddl_batch_options wrong{};
    wrong.environment_count = -1;
    EXPECT_EQ(simulator->create(simulator.get(), &wrong), nullptr);
    EXPECT_STREQ(simulator->last_error(simulator.get()), "environment_count is negative: -1");
    wrong.environment_count = 1;
    wrong.first_environment = -1;
    EXPECT_EQ(simulator->create(simulator.get(), &wrong), nullptr);
    EXPECT_STREQ(simulator->last_error(simulator.get()), "first_environment is negative: -1");
}

TEST(Switching, StaysInterpretedIfTheBuildFails) {
    std::string told;
    const auto build = std::make_shared<BackgroundBuild>(
        [](const std::stop_token&) -> Simulator { throw Failure("the disk is full"); },
        [&](const std::string& why) { told += why; });
    const Simulator simulator =
        switching_simulator(loaded_example("reservoir", Engine::Interpreter), build);
    const solvers::BatchHandle batch = solvers::create_batch(*simulator, few(2, false));
    while (!build->is_settled()) std::this_thread::yield();
    course(*simulator, batch.get(), few(2, false), 5, false);
    build->stop();
    EXPECT_EQ(told, "the disk is full");
    EXPECT_EQ(build->ready(), nullptr);
}

TEST(Switching, IsBuiltAgainByAForkedProcess) {
    OnDemand on_demand("network");
    const Simulator& simulator = on_demand.simulator;
    const rddl_batch_options options = [] {
        rddl_batch_options one = few(1, false);
        one.thread_count = 1;
        return one;
    }();
    const solvers::BatchHandle batch = solvers::create_batch(*simulator, options);
    const pid_t child = ::fork();
    if (child == 0) {
        on_demand.is_wanted = true;
        for (int k = 0; k < 2000 && !on_demand.build->ready(); ++k) {
            course(*simulator, batch.get(), options, 1, false);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        ::_exit(on_demand.build->ready() ? 0 : 1);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
}

TEST(Snapshots, AreReadByEveryEngineOfTheProblemAlone) {
    const Simulator interpreted = loaded_example("reservoir", Engine::Interpreter),
                    compiled = loaded_example("reservoir", Engine::Compiled),
                    other = loaded_example("network", Engine::Interpreter);
    const rddl_batch_options options = few(9, true);
    const solvers::BatchHandle from = solvers::create_batch(*compiled, options),
                               to = solvers::create_batch(*interpreted, options),
                               wrong = solvers::create_batch(*other, options);
    course(*compiled, from.get(), options, 12, false);
    const std::int64_t size = compiled->snapshot_size(compiled.get());
    ASSERT_EQ(size, interpreted->snapshot_size(interpreted.get()));
    Bytes snapshots(static_cast<std::size_t>(9 * size) + 4096);
    ASSERT_EQ(compiled->get_snapshots(from.get(), 0, 9, snapshots.data()), RDDL_OK);
    ASSERT_EQ(interpreted->set_snapshots(to.get(), 0, 9, snapshots.data()), RDDL_OK);
    EXPECT_EQ(course(*interpreted, to.get(), options, 12, false),
              course(*compiled, from.get(), options, 12, false));
    EXPECT_EQ(other->set_snapshots(wrong.get(), 0, 1, snapshots.data()), RDDL_BAD_ARGUMENT);
    EXPECT_STREQ(other->last_error(other.get()),
                 "snapshot 0 is not one of this problem and version");
    EXPECT_EQ(compiled->get_snapshots(from.get(), 8, 2, snapshots.data()), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(compiled->get_snapshots(from.get(), 0, 1, nullptr), RDDL_BAD_ARGUMENT);
}

}  // namespace
}  // namespace rddlc::workbench
