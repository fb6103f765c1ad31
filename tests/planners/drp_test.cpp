// Deep reactive policies by gradients. They are here since the problems of these tests have their
// text at hand, from which derivatives are made.
#include "derivatives.hpp"
#include "planning.hpp"
#include "solvers/drp/return_gradient.hpp"
#include "solvers/drp/trainee.hpp"
#include "solvers/drp/trainer.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "solvers/training/training.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>

namespace rddlc::planners {
namespace {

namespace fs = std::filesystem;
using solvers::DrpOptions;
using solvers::DrpTrainer;
using solvers::PpoModel;

DrpOptions small_training() {
    DrpOptions options;
    options.hidden = {16, 16};
    options.seed = 3;
    return options;
}

std::string complaint(const auto& call) {
    try {
        call();
    } catch (const Failure& failure) {
        return failure.what();
    }
    return "";
}

// The derivative along a direction of many weights agrees with a difference: weights are floats, so
// that one of them alone would move returns too little.
void expect_gradient(const rddl_simulator& simulator, const fs::path& folder) {
    SCOPED_TRACE(simulator.problem->domain);
    const auto source = derivatives_in(folder);
    DrpTrainer trainer(simulator, small_training(), source);
    PpoModel model = trainer.model();
    for (std::size_t p = 0; p < model.policy.parameters; ++p)  // away from the first outputs, 0
        model.parameters[p] *= 3;
    const auto derivatives = source({.mode = solvers::Relaxation::Mode::Soft, .sharpness = 1});
    solvers::ReturnGradient returns(simulator, model, *derivatives, 4, false);
    const std::array<std::uint64_t, solvers::derivative_lanes> seeds{1, 2, 3, 4, 5, 6, 7, 8};
    std::vector<solvers::Moments> seen(static_cast<std::size_t>(model.features()));
    std::vector<float> gradient(model.policy.parameters), ignored(gradient.size());
    const auto sum = [&](std::vector<float>& to) {
        returns.add(seeds, to, seen, {});
        double all = 0;
        for (const double each : returns.returns()) all += each;
        return all;
    };
    sum(gradient);
    EXPECT_EQ(returns.steps(), 4 * static_cast<std::int64_t>(solvers::derivative_lanes));
    const std::vector<float> at = model.parameters;
    double length = 0;
    for (const float each : gradient) length += static_cast<double>(each * each);
    ASSERT_GT(length, 0);
    const auto moved = [&](double width) {
        for (std::size_t p = 0; p < gradient.size(); ++p)
            model.parameters[p] =
                at[p] + static_cast<float>(width / std::sqrt(length)) * gradient[p];
        return sum(ignored);
    };
    constexpr double width = 0.01;
    const double difference = (moved(width) - moved(-width)) / (2 * width);
    EXPECT_NEAR(difference / std::sqrt(length), 1, 0.03);
}

TEST(Drp, GradientsAgreeWithDifferences) {
    expect_gradient(target(), PROBLEMS "/target");
    expect_gradient(reservoir(), EXAMPLES "/reservoir");
    expect_gradient(network(), EXAMPLES "/network");  // sub-actions
    expect_gradient(car(), EXAMPLES "/mountain_car");
}

solvers::TrainingResult train(const rddl_simulator& simulator, const fs::path& folder,
                              const DrpOptions& options, solvers::TrainingOptions training = {}) {
    if (training.folder.empty())
        training.folder = fs::temp_directory_path() / fmt::format("rddlc_drp_{}", getpid());
    training.quiet = true;
    return solvers::train(
        simulator, solvers::drp_trainee(simulator, options, derivatives_in(folder)), training);
}

TEST(Drp, LearnsToActBetterThanNoop) {
    const fs::path folder = fs::temp_directory_path() / fmt::format("rddlc_drp_{}", getpid());
    solvers::TrainingOptions training;
    training.folder = folder;
    DrpOptions options = small_training();
    options.steps = 20'000;
    const auto near_target = train(target(), PROBLEMS "/target", options, training);
    EXPECT_GT(near_target.best_return, -0.14);  // the optimum is -0.116, no-op has -0.72
    EXPECT_EQ(near_target.no_better, "");
    // The file is that of a policy.
    const std::string text = read_file(folder / "policy.json");
    EXPECT_NE(text.find("\"solver\":\"drp\""), std::string::npos);
    const auto model = solvers::read_ppo_policy(target(), text);
    EXPECT_EQ(solvers::ppo_policy_text(target(), *model), text);
    fs::remove_all(folder);

    options.steps = 100'000;
    const auto kept = train(reservoir(), EXAMPLES "/reservoir", options, training);
    EXPECT_GT(kept.best_return, -80'000);  // no-op has -143,214
    EXPECT_EQ(kept.no_better, "");
    fs::remove_all(folder);
}

TEST(Drp, GoesOnAsIfItHadNotStopped) {
    const auto source = derivatives_in(EXAMPLES "/network");
    DrpOptions options = small_training();
    DrpTrainer whole(network(), options, source), first(network(), options, source),
        second(network(), options, source);
    whole.update();
    first.update();
    second.load(first.save());
    whole.update();
    second.update();
    EXPECT_TRUE(whole.model().parameters == second.model().parameters);
    EXPECT_EQ(whole.model().normaliser.means, second.model().normaliser.means);
    EXPECT_EQ(whole.progress().mean_return, second.progress().mean_return);

    // A clock ends an update of 20 gradients where it is.
    int asked = 0;
    const std::int64_t before = second.progress().gradients;
    second.update([&asked] { return ++asked > 200; });
    EXPECT_GT(second.progress().gradients, before);
    EXPECT_LT(second.progress().gradients, before + 10);
    second.update([] { return true; });
    EXPECT_TRUE(std::isfinite(second.progress().mean_return));

    options.hidden = {8};
    DrpTrainer other(network(), options, source);
    EXPECT_EQ(complaint([&] { other.load(whole.save()); }),
              "it is of a run with other networks: --hidden has to be as it was");
    EXPECT_NE(complaint([&] { second.load("nonsense"); }), "");
}

// A clock may end an update in the middle of a gradient, also of the one that learns the first
// scales: the run goes on as if there had been no clock.
TEST(Drp, GoesOnAsIfNoClockHadStoppedIt) {
    const auto source = derivatives_in(EXAMPLES "/network");
    DrpOptions options = small_training();
    DrpTrainer whole(network(), options, source);
    whole.update();
    options.steps = whole.progress().steps;  // done at the end of its first update
    whole.update();
    bool has_stopped_after_scales = false;
    for (const int most : {0, 30, 81, 82, 83, 100, 400}) {
        SCOPED_TRACE(most);
        DrpTrainer first(network(), options, source), second(network(), options, source);
        int asked = 0;
        first.update([&] { return ++asked > most; });
        const solvers::DrpProgress stopped = first.progress();
        has_stopped_after_scales |= stopped.gradients == 0 && stopped.steps > 0;
        EXPECT_EQ(std::isnan(stopped.mean_return), stopped.steps == 0);
        EXPECT_EQ(std::isnan(stopped.gradient_length), stopped.gradients == 0);
        EXPECT_LT(stopped.steps, options.steps);
        second.load(first.save());
        EXPECT_FALSE(second.done());
        second.update();
        EXPECT_TRUE(second.done());
        EXPECT_EQ(second.progress().steps, options.steps);
        second.update();
        EXPECT_EQ(second.progress().steps, whole.progress().steps);
        EXPECT_EQ(second.progress().gradients, whole.progress().gradients);
        EXPECT_EQ(second.progress().mean_return, whole.progress().mean_return);
        EXPECT_TRUE(second.model().parameters == whole.model().parameters);
        EXPECT_EQ(second.model().normaliser.means, whole.model().normaliser.means);
    }
    EXPECT_TRUE(has_stopped_after_scales);
}

TEST(Drp, RefusesWhatHasNoGradient) {
    const DrpOptions options = small_training();
    EXPECT_EQ(complaint([&] { DrpTrainer(maze(), options, derivatives_in(EXAMPLES "/t_maze")); }),
              "'rddl train drp' needs the state, which t_maze_1 (t_maze) hides from policies");
    EXPECT_EQ(complaint([&] { DrpTrainer(car(), options, {}); }),
              "'rddl train drp' needs the RDDL text of the problem, from which derivatives are "
              "made");
    DrpOptions little = options;
    little.memory_limit = 1000;
    EXPECT_NE(complaint([&] {
                  DrpTrainer(car(), little, derivatives_in(EXAMPLES "/mountain_car"));
              }).find("more than the limit of 1000 bytes"),
              std::string::npos);
}

}  // namespace
}  // namespace rddlc::planners
