// PPO as a whole: advantages, one update as Stable-Baselines3 makes it, and bytes that depend on
// nothing but the options.
//
// Over 400 lines: a test for each thing that can be seen.
#include "simulators.hpp"
#include "solver_kite.h"
#include "solvers/evaluation/summary.hpp"
#include "solvers/ppo/advantages.hpp"
#include "solvers/ppo/curiosity.hpp"
#include "solvers/ppo/learner.hpp"
#include "solvers/ppo/policy.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/state_noise.hpp"
#include "solvers/ppo/trainee.hpp"
#include "solvers/ppo/trainer.hpp"
#include "solvers/training/training.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>
#include <thread>

namespace rddlc::solvers {
namespace {

// The sum of equation 11 of the paper, as it stands.
TEST(Advantages, AgreeWithTheSum) {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    constexpr std::size_t steps = 50;
    constexpr double gamma = 0.97, lambda = 0.9;
    std::vector<float> rewards(steps), values(steps), next(steps), advantages(steps),
        returns(steps);
    std::vector<std::uint8_t> ends(steps);
    for (std::size_t t = 0; t < steps; ++t) {
        rewards[t] = normal(random);
        values[t] = normal(random);
        next[t] = random() % 2 ? normal(random) : 0.0f;  // truncated, or terminated
        ends[t] = random() % 7 == 0;
    }
    estimate_advantages({steps, 1, rewards.data(), values.data(), next.data(), ends.data()}, gamma,
                        lambda, advantages.data(), returns.data());
    for (std::size_t t = 0; t < steps; ++t) {
        double sum = 0, factor = 1;
        for (std::size_t k = t; k < steps; ++k) {
            const bool known = ends[k] || k == steps - 1;
            const double following = static_cast<double>(known ? next[k] : values[k + 1]);
            sum += factor * (static_cast<double>(rewards[k]) + gamma * following -
                             static_cast<double>(values[k]));
            if (known) break;
            factor *= gamma * lambda;
        }
        EXPECT_NEAR(advantages[t], sum, 1e-5) << t;
        EXPECT_NEAR(returns[t], sum + static_cast<double>(values[t]), 1e-5) << t;
    }
}

TEST(RunningStatistics, KnowTheLeastUsualNumber) {
    std::vector<float> numbers(1000);
    std::iota(numbers.begin(), numbers.end(), 0.0f);
    EXPECT_EQ(least_usual(numbers), 50 - 100.0 * (949 - 50));
    std::fill_n(numbers.begin(), 30, -1e20f);  // few enough
    EXPECT_NEAR(least_usual(numbers), 50 - 100.0 * 900, 3000);
    std::fill(numbers.begin() + 30, numbers.end(), 7.0f);
    EXPECT_EQ(least_usual(numbers), -std::numeric_limits<double>::infinity());
    std::vector<float> one{3.0f};
    EXPECT_EQ(least_usual(one), -std::numeric_limits<double>::infinity());
}

// ------------------------------------------------------------------ Stable-Baselines3's update

// record_sb3_updates.py has written the weights before and after, and the batch.
void set_layers(const nlohmann::json& layers, const Network& network, float* parameters) {
    for (std::size_t l = 0; l < network.layers.size(); ++l) {
        const Layer& layer = network.layers[l];
        const Weights<float> weights = layer.weights_in(parameters);
        for (int o = 0; o < layer.outputs; ++o) {
            for (int i = 0; i < layer.inputs; ++i)
                weights(i, o) =
                    layers[l]["weights"][static_cast<std::size_t>(o)][static_cast<std::size_t>(i)];
            parameters[layer.bias + static_cast<std::size_t>(o)] =
                layers[l]["bias"][static_cast<std::size_t>(o)];
        }
    }
}

void set_parameters(const nlohmann::json& weights, PpoModel& model) {
    set_layers(weights["policy"], model.policy, model.parameters.data());
    set_layers(weights["value"], model.value, model.parameters.data() + model.value_begin());
    for (std::size_t r = 0; r < model.actions.reals.size(); ++r)
        model.parameters[model.deviations_begin() + r] = weights["log_std"][r];
}

TEST(Ppo, UpdatesAsStableBaselines3Does) {
    const nlohmann::json all = nlohmann::json::parse(std::ifstream(SB3_UPDATES));
    ASSERT_EQ(all.size(), 2u);
    for (const nlohmann::json& each : all) {
        PpoModel model;
        const std::size_t inputs = each["observations"][0].size();
        for (std::size_t i = 0; i < inputs; ++i) model.observations.features.push_back("x");
        model.actions.reals.resize(each["reals"].get<std::size_t>());
        for (const int count : each["categories"].get<std::vector<int>>()) {
            CategoryHead head;
            head.first_logit = model.actions.logit_count;
            head.count = count;
            model.actions.categories.push_back(head);
            model.actions.logit_count += count;
        }
        model.hidden = each["hidden"].get<std::vector<int>>();
        make_networks(model);
        set_parameters(each["before"], model);

        const int count = static_cast<int>(each["observations"].size());
        Experience experience(model, count, 1, 1);
        for (std::size_t s = 0; s < static_cast<std::size_t>(count); ++s) {
            for (std::size_t i = 0; i < inputs; ++i)
                experience.inputs[s * inputs + i] = each["observations"][s][i];
            for (std::size_t r = 0; r < model.actions.reals.size(); ++r)
                experience.numbers[s * model.actions.reals.size() + r] = each["actions"][s][r];
            for (std::size_t h = 0; h < model.actions.categories.size(); ++h)
                experience.indices[s * model.actions.categories.size() + h] =
                    each["actions"][s][h].get<int>();
            experience.log_probabilities[s] = each["log_probabilities"][s];
            experience.advantages[s] = each["advantages"][s];
            experience.values[s] = each["values"][s];
            experience.returns[s] = each["returns"][s];
        }
        PpoOptions options;
        options.minibatch = count;
        rddl::Team team(1);
        const Ranks alone;
        Learner learner(model, options, team, alone);
        Moments advantages;
        for (const float advantage : experience.advantages)
            advantages.add(static_cast<double>(advantage));
        std::vector<std::uint32_t> samples(static_cast<std::size_t>(count));
        std::iota(samples.begin(), samples.end(), 0u);
        for (int epoch = 0; epoch < each["epochs"].get<int>(); ++epoch)
            learner.learn(experience, samples, advantages,
                          {each["learning_rate"].get<double>(), each["entropy"].get<double>(), 0});

        PpoModel expected = model;
        set_parameters(each["after"], expected);
        double moved = 0;
        PpoModel before = model;
        set_parameters(each["before"], before);
        for (std::size_t p = 0; p < model.parameters.size(); ++p) {
            EXPECT_NEAR(model.parameters[p], expected.parameters[p], 1e-5) << p;
            moved = std::max(moved, static_cast<double>(
                                        std::abs(expected.parameters[p] - before.parameters[p])));
        }
        EXPECT_GT(moved, 1e-3);
    }
}

// ---------------------------------------------------------------------------- determinism

PpoOptions small_training() {
    PpoOptions options;
    options.steps = 3 * 24 * 32;
    options.environments = 24;
    options.rollout = 32;
    options.minibatch = 512;
    options.epochs = 2;
    options.hidden = {16, 16};
    options.seed = 5;
    return options;
}

// Noise of the width of the bounds throws the kite out of sight; no-op loses 1 in each step.
TEST(Ppo, BeginsWithLittleNoiseWhereMoreIsRuinous) {
    const rddl_simulator& kite = *rddl_simulator_kite_kite_1();
    PpoOptions options;
    options.steps = 100'000;
    const Trainee trainee = ppo_trainee(kite, options);
    EXPECT_EQ(trainee.note,
              "--log-std is -2, since noise of deviation 1 has far worse returns than no-op");
    TrainingOptions training;
    training.folder =
        std::filesystem::temp_directory_path() / fmt::format("rddlc_kite_{}", getpid());
    training.quiet = true;
    const TrainingResult result = train(kite, trainee, training);
    std::filesystem::remove_all(training.folder);
    EXPECT_GT(result.best_return, -50);  // that of no-op
    EXPECT_EQ(result.no_better, "");

    options.log_deviation = -1;
    EXPECT_EQ(ppo_trainee(kite, options).note, "");
    for (const rddl_simulator* simulator : simulators()) {
        const PpoTrainer trainer(*simulator, small_training());
        EXPECT_EQ(trainer.options().log_deviation, 0) << simulator->problem->domain;
    }
}

TEST(Ppo, ThreadsDoNotMatter) {
    for (const rddl_simulator* simulator : simulators()) {
        SCOPED_TRACE(simulator->problem->domain);
        PpoOptions options = small_training();
        PpoTrainer alone(*simulator, options);
        options.threads = 3;
        PpoTrainer together(*simulator, options);
        while (!alone.done()) {
            alone.update();
            together.update();
        }
        EXPECT_TRUE(std::isfinite(alone.progress().value_loss));
        EXPECT_EQ(alone.model().parameters, together.model().parameters);
        EXPECT_EQ(alone.model().normaliser.means, together.model().normaliser.means);
    }
}

TEST(Ppo, GoesOnAsIfItHadNotStopped) {
    for (const rddl_simulator* simulator : simulators()) {
        SCOPED_TRACE(simulator->problem->domain);
        const PpoOptions options = small_training();
        PpoTrainer whole(*simulator, options), first(*simulator, options);
        whole.update();
        whole.update();
        first.update();
        PpoTrainer second(*simulator, options);
        second.load(first.save());
        second.update();
        EXPECT_EQ(whole.model().parameters, second.model().parameters);
        EXPECT_EQ(ppo_policy_text(*simulator, whole.model()),
                  ppo_policy_text(*simulator, second.model()));
    }
}

std::string complaint(const auto& work) {
    try {
        work();
    } catch (const Failure& failure) {
        return failure.what();
    }
    return "";
}

// Gradients of logarithms of deviations that depend on the state, against finite differences.
TEST(StateNoise, GradientAgreesWithFiniteDifferences) {
    constexpr int units = 5, reals = 2;
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<double> logarithms(units * reals), hidden(units), weights(reals),
        gradient(units * reals);
    for (auto* each : {&logarithms, &hidden, &weights})
        for (double& number : *each) number = 0.5 * normal(random);
    std::vector<double> variances(logarithms.size()), deviations(reals);
    const auto value = [&] {
        weight_variances(units, reals, logarithms.data(), variances.data());
        state_log_deviations(units, reals, variances.data(), hidden.data(), deviations.data());
        return weights[0] * deviations[0] + weights[1] * deviations[1];
    };
    value();
    add_state_noise_gradient(units, reals, variances.data(), hidden.data(), deviations.data(),
                             weights.data(), gradient.data());
    for (std::size_t k = 0; k < logarithms.size(); ++k) {
        const double before = logarithms[k], step = 1e-6;
        logarithms[k] = before + step;
        const double above = value();
        logarithms[k] = before - step;
        const double below = value();
        logarithms[k] = before;
        EXPECT_NEAR(gradient[k], (above - below) / (2 * step), 1e-8) << k;
    }
}

// The noise has the deviation that its likelihood says, and is the same function for some steps.
TEST(StateNoise, IsAsLikelyAsItSays) {
    PpoOptions options = small_training();
    options.noise = Noise::Sde;
    options.noise_steps = 2;
    const rddl_simulator& car = *rddl_simulator_mountain_car_mountain_car_1();
    const PpoModel model =
        make_model(observation_space(car, options.observations), action_space(car), options);
    const std::size_t units = static_cast<std::size_t>(model.noisy_units());
    ASSERT_EQ(units, static_cast<std::size_t>(options.hidden.back()));
    std::vector<float> hidden(units);
    for (std::size_t u = 0; u < units; ++u) hidden[u] = std::sin(static_cast<float>(u));
    constexpr std::int64_t environments = 2000;
    StateNoise noise(model, environments);
    noise.look_at_policy();
    Moments squares;
    for (std::uint64_t step = 0; step < 4; ++step)
        for (std::int64_t e = 0; e < environments; ++e) {
            const float before = noise.deviations().noise[e];
            noise.make(e, hidden.data(), {5, static_cast<std::uint64_t>(e), step});
            const Deviations now = noise.deviations();
            EXPECT_EQ(step % 2 == 1, now.noise[e] == before);
            squares.add(static_cast<double>(now.noise[e] / std::exp(now.logarithms[e])));
        }
    EXPECT_NEAR(squares.sum / squares.count, 0, 0.05);
    EXPECT_NEAR(squares.squares / squares.count, 1, 0.05);
}

TEST(StateNoise, IsPartOfCheckpointsAndPolicies) {
    for (const rddl_simulator* simulator : simulators()) {
        SCOPED_TRACE(simulator->problem->domain);
        PpoOptions options = small_training();
        options.noise = Noise::Sde;
        PpoTrainer whole(*simulator, options), first(*simulator, options);
        for (int i = 0; i < 3; ++i) whole.update();
        first.update();
        options.threads = 2;
        PpoTrainer threaded(*simulator, options);
        for (int i = 0; i < 3; ++i) threaded.update();
        EXPECT_EQ(whole.model().parameters, threaded.model().parameters);
        options.threads = 1;
        PpoTrainer second(*simulator, options);
        second.load(first.save());
        for (int i = 0; i < 2; ++i) second.update();
        EXPECT_EQ(whole.model().parameters, second.model().parameters);
        const std::string text = ppo_policy_text(*simulator, whole.model());
        const auto model = read_ppo_policy(*simulator, text);
        EXPECT_EQ(model->noise, Noise::Sde);
        EXPECT_EQ(ppo_policy_text(*simulator, *model), text);
        const Policy policy = ppo_policy(*simulator, model, true, 1, "ppo");
        const Summary summary = summary_of(run_episodes(*simulator, policy, {}, {}));
        EXPECT_TRUE(std::isfinite(summary.undiscounted_return.mean));
    }
}

// Each action of the network problem is one choice, so that all priors together are 1; the
// likeliest action is the policy's.
TEST(Ppo, GivesPriorsOfActions) {
    const rddl_simulator& network = *rddl_simulator_network_network_1();
    PpoTrainer trainer(network, small_training());
    for (int i = 0; i < 3; ++i) trainer.update();
    const auto model = read_ppo_policy(network, ppo_policy_text(network, trainer.model()));
    const Policy policy = ppo_policy(network, model, false, 1, "ppo");
    ASSERT_TRUE(policy.priors);
    const auto choices = static_cast<std::size_t>(network.action_choice_count(&network));
    const auto size = static_cast<std::size_t>(network.problem->action_size);
    std::vector<std::byte> actions(choices * size), chosen(3 * size);
    for (std::size_t c = 0; c < choices; ++c)
        network.action_choice(&network, static_cast<std::int64_t>(c), actions.data() + c * size,
                              nullptr);
    rddl_batch_options options{};
    options.environment_count = 3;
    const BatchHandle batch = create_batch(network, options);
    rddl_transition nothing{};
    network.step(batch.get(), std::vector<std::byte>(3 * size).data(), &nothing);
    const std::vector<std::int64_t> steps(3, 1), episodes(3, 0);
    std::vector<float> rows(3 * choices);
    policy.priors(3, actions)(batch.get(), steps, rows.data());
    std::vector<std::int32_t> violated(3);
    const std::vector<std::uint8_t> running(3, 1);
    Decision decision{batch.get(), running, episodes, steps, chosen.data(), violated};
    policy.start(3)(decision);
    for (std::size_t e = 0; e < 3; ++e) {
        const float* const row = rows.data() + e * choices;
        double sum = 0;
        for (std::size_t c = 0; c < choices; ++c) sum += std::exp(static_cast<double>(row[c]));
        EXPECT_NEAR(sum, 1, 1e-5);
        const auto best = static_cast<std::size_t>(std::max_element(row, row + choices) - row);
        EXPECT_TRUE(std::equal(actions.data() + best * size, actions.data() + (best + 1) * size,
                               chosen.data() + e * size));
    }
    PpoOptions recurrent = small_training();
    recurrent.recurrent = 4;
    PpoTrainer remembers(network, recurrent);
    EXPECT_FALSE(ppo_policy(network,
                            read_ppo_policy(network, ppo_policy_text(network, remembers.model())),
                            false, 1, "ppo")
                     .priors);
}

TEST(Ppo, SquashedPoliciesAreReadAsTheyWereWritten) {
    PpoOptions options = small_training();
    options.squashes = true;
    const rddl_simulator& car = *rddl_simulator_mountain_car_mountain_car_1();
    PpoTrainer trainer(car, options);
    trainer.update();
    const std::string text = ppo_policy_text(car, trainer.model());
    EXPECT_NE(text.find("\"squashed\""), std::string::npos);
    EXPECT_EQ(ppo_policy_text(car, *read_ppo_policy(car, text)), text);
    // Other programs lay out JSON in their own way, with members in another order.
    nlohmann::json json = nlohmann::json::parse(text);
    EXPECT_EQ(ppo_policy_text(car, *read_ppo_policy(car, json.dump(2))), text);
    nlohmann::json zeros = json;
    zeros["policy"][0]["bias"][0] = -0.0;
    const std::string signed_zero = ppo_policy_text(car, *read_ppo_policy(car, zeros.dump()));
    EXPECT_EQ(ppo_policy_text(car, *read_ppo_policy(car, signed_zero)), signed_zero);
    json["hidden"][0] = 1'000'000'000;
    EXPECT_THROW(read_ppo_policy(car, json.dump()), Failure);
    json = nlohmann::json::parse(text);
    json["policy"][0]["bias"][0] = 1e300;
    EXPECT_THROW(read_ppo_policy(car, json.dump()), Failure);
}

TEST(Ppo, RefusesCheckpointsOfOthersAndPiecesOfThem) {
    const PpoOptions options = small_training();
    PpoTrainer car(*rddl_simulator_mountain_car_mountain_car_1(), options);
    PpoTrainer reservoir(*rddl_simulator_reservoir_reservoir_1(), options);
    const std::string bytes = car.save();
    EXPECT_EQ(complaint([&] { reservoir.load(bytes); }),
              "it is of the problem mountain_car_1 (mountain_car), not of reservoir_1 (reservoir)");
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{9}, bytes.size() / 2, bytes.size() - 1})
        EXPECT_NE(complaint([&] { car.load(bytes.substr(0, size)); }), "") << size;
}

// Somebody has changed some bytes, and the checksum of the file with them.
TEST(Ppo, ChangedCheckpointsAreRefusedOrTaken) {
    const rddl_simulator& car = *rddl_simulator_mountain_car_mountain_car_1();
    PpoTrainer trainer(car, small_training());
    trainer.update();
    const std::string bytes = trainer.save();
    int refused = 0;
    for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 2000) {
        for (const char byte : {'\0', '\x7f', '\xff'}) {
            std::string changed = bytes;
            changed[at] = byte;
            PpoTrainer other(car, small_training());
            refused += !complaint([&] { other.load(changed); }).empty();
        }
    }
    EXPECT_GT(refused, 20);
}

TEST(Ppo, PoliciesAreReadAsTheyWereWritten) {
    for (const rddl_simulator* simulator : simulators()) {
        SCOPED_TRACE(simulator->problem->domain);
        PpoTrainer trainer(*simulator, small_training());
        trainer.update();
        const std::string text = ppo_policy_text(*simulator, trainer.model());
        const auto model = read_ppo_policy(*simulator, text);
        EXPECT_EQ(model->parameters, trainer.model().parameters);
        EXPECT_EQ(ppo_policy_text(*simulator, *model), text);
    }
    const rddl_simulator& car = *rddl_simulator_mountain_car_mountain_car_1();
    PpoTrainer trainer(car, small_training());
    const std::string text = ppo_policy_text(car, trainer.model());
    const auto read = [&](const std::string& other) {
        return complaint([&] { read_ppo_policy(car, other); });
    };
    EXPECT_EQ(read(text.substr(0, text.size() / 2)), "it is incomplete, or not JSON");
    EXPECT_EQ(read("{}"), "it is not a policy of PPO or DRP");
    std::string newer = text;
    newer.replace(newer.find("\"version\":6"), 11, "\"version\":9");
    EXPECT_EQ(read(newer), "it is of version 9, and this program reads versions up to 6");
    EXPECT_NE(complaint([&] {
                  read_ppo_policy(*rddl_simulator_reservoir_reservoir_1(), text);
              }).find("it is of the problem mountain_car_1"),
              std::string::npos);
}

TEST(Ppo, ValuesAreInTheRewardsOfTheProblem) {
    const rddl_simulator& network = *rddl_simulator_network_network_1();
    PpoOptions options = small_training();
    options.steps = 40 * 24 * 32;
    options.learning_rate = 3e-3;
    options.minibatch = 128;
    PpoTrainer trainer(network, options);
    while (!trainer.done()) trainer.update();
    const std::string text = ppo_policy_text(network, trainer.model());
    const Policy policy = ppo_policy(network, read_ppo_policy(network, text), false, 0, "ppo");
    ASSERT_TRUE(policy.values);
    rddl_batch_options batch_options{};
    batch_options.environment_count = 3;
    const BatchHandle batch = create_batch(network, batch_options);
    const std::vector<std::int64_t> at_first(3, 0), at_last(3, network.problem->horizon - 1);
    std::vector<double> first(3), last(3);
    const StateValues values_of = policy.values(3);
    values_of(batch.get(), at_first, first.data());
    values_of(batch.get(), at_last, last.data());
    const double expected = trainer.progress().mean_discounted_return;
    EXPECT_NEAR(first[0], expected, 0.25 * std::abs(expected));
    EXPECT_EQ(first[0], first[2]);
    EXPECT_LT(std::abs(last[0]), 0.5 * std::abs(expected));  // it sees the time

    nlohmann::json older = nlohmann::json::parse(text);
    older["version"] = 5;
    older.erase("values");
    EXPECT_FALSE(
        ppo_policy(network, read_ppo_policy(network, older.dump()), false, 0, "ppo").values);
    older["values"] = {{"scale", -1}, {"discount", 1}};
    EXPECT_THROW(read_ppo_policy(network, older.dump()), Failure);
    PpoTrainer hidden(maze(), small_training());
    hidden.update();
    EXPECT_FALSE(
        ppo_policy(maze(), std::make_shared<PpoModel>(hidden.model()), false, 0, "ppo").values);
}

TEST(Ppo, FilesOfVersionsThatCalledSubActionsPicksAreRead) {
    for (const rddl_simulator* simulator : simulators()) {
        SCOPED_TRACE(simulator->problem->domain);
        PpoTrainer trainer(*simulator, small_training());
        const std::string text = ppo_policy_text(*simulator, trainer.model());
        nlohmann::json older = nlohmann::json::parse(text);
        nlohmann::json& action = older["action"];
        older["version"] = 1;
        action["picks"] = action["max_sub_actions"];
        action.erase("max_sub_actions");
        EXPECT_EQ(ppo_policy_text(*simulator, *read_ppo_policy(*simulator, older.dump())), text);
        action["picks"] = 99;
        EXPECT_THROW(read_ppo_policy(*simulator, older.dump()), Failure);
    }
}

TEST(Ppo, ReluNetworksAreReadAsTheyWereWritten) {
    const rddl_simulator& car = *rddl_simulator_mountain_car_mountain_car_1();
    PpoOptions options = small_training();
    PpoTrainer tanh(car, options);
    options.activation = Activation::Relu;
    PpoTrainer relu(car, options);
    relu.update();
    const std::string text = ppo_policy_text(car, relu.model());
    EXPECT_NE(text.find(R"("activation":"relu",)"), std::string::npos);
    EXPECT_EQ(ppo_policy_text(car, *read_ppo_policy(car, text)), text);
    // A file without an activation means tanh, as all older files do.
    EXPECT_EQ(ppo_policy_text(car, tanh.model()).find("activation"), std::string::npos);
    std::string other = text;
    other.replace(other.find("\"relu\""), 6, "\"gelu\"");
    EXPECT_EQ(complaint([&] { read_ppo_policy(car, other); }), "its activation is unknown: 'gelu'");
    // clang++ 14 captures no structured bindings.
    for (const auto& runs : {std::pair{&relu, &tanh}, {&tanh, &relu}})
        EXPECT_EQ(complaint([&] { runs.second->load(runs.first->save()); }),
                  "it is of a run with other networks: --hidden, --activation, --stack and "
                  "--recurrent have to be as they were");
}

// A reward that is not finite cannot be learned from; here by a learning rate that breaks
// everything.
TEST(Ppo, TellsWhenAGradientIsNotFinite) {
    PpoOptions options = small_training();
    options.learning_rate = 1e30;
    options.schedule = LearningRate::Constant;
    options.gradient_norm = 0;
    PpoTrainer trainer(*rddl_simulator_reservoir_reservoir_1(), options);
    const std::string text = complaint([&] {
        for (int i = 0; i < 10; ++i) trainer.update();
    });
    EXPECT_NE(text.find("the gradient is not finite"), std::string::npos) << text;
    EXPECT_NE(text.find("after "), std::string::npos) << text;
}

// A call that the simulator refuses in another thread than the caller's ends the run with its
// sentence, and the last checkpoint is as it was.
TEST(Ppo, ARefusedCallLeavesTheCheckpoint) {
    static std::thread::id caller;
    static std::atomic<int> calls_left;
    caller = std::this_thread::get_id();
    rddl_simulator simulator = *rddl_simulator_mountain_car_mountain_car_1();
    simulator.step_values = [](rddl_batch* batch, rddl_number number, const void* actions,
                               void* observations, const rddl_transition* out) {
        if (std::this_thread::get_id() != caller && --calls_left < 0)
            return rddl_error{RDDL_BAD_ARGUMENT};
        return rddl_simulator_mountain_car_mountain_car_1()->step_values(batch, number, actions,
                                                                         observations, out);
    };
    simulator.last_error = [](const rddl_simulator*) {
        return "the simulator's sentence";
    };
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("refused_{}", ::getpid());
    std::filesystem::remove_all(folder);
    PpoOptions options = small_training();
    options.threads = 2;
    TrainingOptions training;
    training.folder = folder;
    training.quiet = true;
    const auto go = [&] {
        train(simulator, ppo_trainee(simulator, options, {}), training);
    };
    calls_left = 1'000'000;
    go();
    const std::string before = read_file(folder / "checkpoint");
    training.resumes = true;
    options.steps *= 4;
    calls_left = 2 * options.rollout + 3;  // in the third update from there
    EXPECT_EQ(complaint(go), "the simulator's sentence");
    EXPECT_EQ(read_file(folder / "checkpoint"), before);
    calls_left = 1'000'000;
    {
        const int other = ::open(folder.c_str(), O_RDONLY);
        ASSERT_EQ(::flock(other, LOCK_EX), 0);
        EXPECT_NE(complaint(go).find("another run writes into the folder"), std::string::npos);
        ::close(other);
    }
    EXPECT_EQ(complaint(go), "");
    EXPECT_NE(read_file(folder / "checkpoint"), before);
    std::filesystem::remove_all(folder);
}

TEST(Curiosity, FadesAsReturnsDiffer) {
    std::vector<double> returns(100, -200.0);
    EXPECT_EQ(curiosity(returns), 1);
    EXPECT_EQ(curiosity(std::span(returns).first(5)), 0);  // too few to decide
    for (int e = 0; e < 5; ++e) returns[static_cast<std::size_t>(e)] = -90 - e;
    EXPECT_NEAR(curiosity(returns), 0.5, 1e-12);
    for (int e = 0; e < 20; ++e) returns[static_cast<std::size_t>(e)] = -90 - e;
    EXPECT_EQ(curiosity(returns), 0);
}

// All rewards of an episode for its observations add up to its ranges, whatever the order.
TEST(Curiosity, AddsUpToTheRanges) {
    const rddl_simulator& simulator = *rddl_simulator_reservoir_reservoir_1();
    PpoOptions options = small_training();
    options.observations.time = ObservationOptions::Time::On;
    options.observations.stack = 2;
    const PpoModel model = make_model(observation_space(simulator, options.observations),
                                      action_space(simulator), options);
    const auto width = static_cast<std::size_t>(model.features());
    const auto newest = static_cast<std::size_t>(model.observations.frame_size());
    std::mt19937 random(2);
    std::normal_distribution<float> normal;
    std::vector<float> row(width), factors(width, 0.5f), least, most;
    Seen seen(model, 2);
    for (const std::size_t environment : {0, 1, 1}) {
        float sum = 0;
        for (int step = 0; step < 30; ++step) {
            for (float& feature : row) feature = normal(random);
            if (step == 0) {
                least = most = row;
                seen.begin_episode(environment, row.data());
                continue;
            }
            for (std::size_t f = 0; f < width; ++f) {
                least[f] = std::min(least[f], row[f]);
                most[f] = std::max(most[f], row[f]);
            }
            sum += seen.widen(environment, row.data(), factors.data());
            EXPECT_EQ(seen.widen(environment, row.data(), factors.data()), 0);
        }
        float expected = 0;
        for (std::size_t f = 0; f < newest; ++f)
            expected += 0.5f * (most[f] - least[f]) / static_cast<float>(newest);
        EXPECT_NEAR(sum, expected, 1e-4);
    }
}

// Before the flag the reward is never positive, and noise alone reaches it in no episode.
TEST(Curiosity, FindsWhatPaysAtTheGoalAlone) {
    rddl_simulator simulator = *rddl_simulator_mountain_car_mountain_car_1();
    simulator.step_values = [](rddl_batch* batch, rddl_number number, const void* actions,
                               void* observations, const rddl_transition* out) {
        const rddl_error error = rddl_simulator_mountain_car_mountain_car_1()->step_values(
            batch, number, actions, observations, out);
        for (int e = 0; e < 32; ++e) out->rewards[e] = out->terminated[e] ? 100 : 0;
        return error;
    };
    double reached[2] = {0, 0};
    for (const bool curious : {false, true}) {
        PpoOptions options;
        options.curious = curious;
        options.noise = Noise::White;
        options.steps = 100'000;
        options.environments = 32;
        options.rollout = 64;
        options.minibatch = 256;
        options.hidden = {32, 32};
        options.learning_rate = 1e-3;
        PpoTrainer trainer(simulator, options);
        while (!trainer.done()) {
            trainer.update();
            reached[curious] = std::max(reached[curious], trainer.progress().success_rate);
        }
    }
    EXPECT_EQ(reached[0], 0);
    EXPECT_GT(reached[1], 0.05);
}

// The returns of no-op and random actions are the comparison.
TEST(Ppo, LearnsToDriveUphill) {
    const rddl_simulator& simulator = *rddl_simulator_mountain_car_mountain_car_1();
    PpoOptions options;
    options.steps = 200'000;
    options.environments = 32;
    options.rollout = 64;
    options.minibatch = 256;
    options.hidden = {32, 32};
    options.learning_rate = 1e-3;
    PpoTrainer trainer(simulator, options);
    while (!trainer.done()) trainer.update();
    const auto model = std::make_shared<PpoModel>(trainer.model());
    EpisodeOptions episodes;
    episodes.episodes = 8;
    const Summary summary = summary_of(
        run_episodes(simulator, ppo_policy(simulator, model, false, 0, "ppo"), episodes, {}));
    EXPECT_GT(summary.undiscounted_return.mean, 80);
    EXPECT_EQ(summary.terminated, 8);
}

}  // namespace
}  // namespace rddlc::solvers
