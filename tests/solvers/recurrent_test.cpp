// PPO with a memory: what it is learned from, what is kept of it, and a problem that needs one.
#include "simulators.hpp"
#include "solvers/evaluation/summary.hpp"
#include "solvers/ppo/collector.hpp"
#include "solvers/ppo/policy.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainer.hpp"
#include "solvers/ppo/unrolled.hpp"
#include "support/failure.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>

namespace rddlc::solvers {
namespace {

PpoOptions with_memory() {
    PpoOptions options;
    options.environments = 24;
    options.rollout = 50;
    options.minibatch = 400;
    options.segment = 12;  // parts of 10 steps
    options.epochs = 2;
    options.hidden = {16, 16};
    options.recurrent = 12;
    options.seed = 5;
    return options;
}

std::vector<const rddl_simulator*> and_the_maze() {
    std::vector<const rddl_simulator*> all = simulators();
    all.push_back(&maze());
    return all;
}

std::string sentence_of(const auto& work) {
    try {
        work();
    } catch (const Failure& failure) {
        return failure.what();
    }
    return "";
}

TEST(Segments, HoldEachSampleOnce) {
    for (const auto& [rollout, longest] :
         {std::pair{1, 1}, {7, 1}, {7, 3}, {50, 12}, {31, 32}, {64, 32}, {65, 32}}) {
        constexpr int environments = 3;
        const Segments segments(environments, rollout, longest);
        EXPECT_LE(segments.longest(), longest);
        std::set<std::uint32_t> samples;
        for (std::uint32_t segment = 0; segment < segments.count(); ++segment) {
            EXPECT_GE(segments.length(segment), segments.longest() - 1);
            EXPECT_LE(segments.length(segment), segments.longest());
            const int first = static_cast<int>(segments.sample(segment, 0)) / environments;
            EXPECT_TRUE(segments.begins(static_cast<int>(segment) / environments, first));
            for (int t = 0; t < segments.length(segment); ++t) {
                const std::uint32_t sample = segments.sample(segment, t);
                EXPECT_EQ(sample % environments, segment % environments);
                samples.insert(sample);
            }
        }
        EXPECT_EQ(samples.size(), static_cast<std::size_t>(environments * rollout));
        EXPECT_EQ(*samples.rbegin(), samples.size() - 1);
        if (longest == 1) {
            EXPECT_EQ(segments.count(), samples.size());
        }
    }
}

// As long as the parameters are the same, a segment remembers what the rollout remembered, to the
// bit: through ends of episodes, in any order of segments, also from the second rollout on.
TEST(Unrolled, RemembersWhatTheRolloutDid) {
    PpoOptions options = with_memory();
    options.rollout = 67;  // parts of 11 and 12 steps
    const PpoModel model =
        make_model(observation_space(maze(), options.observations), action_space(maze()), options);
    Collector collector(maze(), model, options, {0, options.environments});
    const int longest = longest_segment(options);
    Experience experience(model, options.environments, options.rollout, longest);
    std::vector<std::uint32_t> segments(experience.segments.count()), samples;
    std::iota(segments.rbegin(), segments.rend(), 0u);
    Unrolled unrolled(model, segments.size(), static_cast<std::size_t>(longest));
    const auto row = static_cast<std::size_t>(model.input_row());
    const auto features = static_cast<std::size_t>(model.features());
    for (const std::int64_t update : {0, 1}) {
        collector.begin_update(options.seed, update);
        collector.collect(experience, options.seed, update);
        EXPECT_GT(std::ranges::count(experience.ends, 1), options.environments);
        unrolled.lay_out(experience, segments, samples);
        ASSERT_EQ(samples.size(), experience.count());
        std::vector<float> inputs(samples.size() * row, -9.0f);
        for (std::size_t s = 0; s < samples.size(); ++s)
            std::copy_n(experience.inputs.data() + samples[s] * row, features,
                        inputs.data() + s * row);
        unrolled.remember(inputs.data());
        for (std::size_t s = 0; s < samples.size(); ++s)
            for (std::size_t i = 0; i < row; ++i)
                ASSERT_EQ(inputs[s * row + i], experience.inputs[samples[s] * row + i])
                    << samples[s] << " " << i;
    }
}

TEST(Recurrent, ThreadsDoNotMatterAndRunsGoOn) {
    for (const rddl_simulator* simulator : and_the_maze()) {
        SCOPED_TRACE(simulator->problem->domain);
        PpoOptions options = with_memory();
        PpoTrainer whole(*simulator, options), first(*simulator, options);
        for (int i = 0; i < 4; ++i) whole.update();
        EXPECT_TRUE(std::isfinite(whole.progress().value_loss));
        first.update();
        first.update();
        options.threads = 3;
        PpoTrainer threaded(*simulator, options);
        for (int i = 0; i < 4; ++i) threaded.update();
        EXPECT_EQ(whole.model().parameters, threaded.model().parameters);
        options.threads = 1;
        PpoTrainer second(*simulator, options);
        second.load(first.save());
        second.update();
        second.update();
        EXPECT_EQ(whole.model().parameters, second.model().parameters);
    }
}

TEST(Recurrent, PoliciesAreReadAsTheyWereWritten) {
    for (const rddl_simulator* simulator : and_the_maze()) {
        SCOPED_TRACE(simulator->problem->domain);
        PpoTrainer trainer(*simulator, with_memory());
        trainer.update();
        const std::string text = ppo_policy_text(*simulator, trainer.model());
        const auto model = read_ppo_policy(*simulator, text);
        EXPECT_EQ(model->parameters, trainer.model().parameters);
        EXPECT_EQ(ppo_policy_text(*simulator, *model), text);
    }
}

// One member after the other has another size.
TEST(Recurrent, PoliciesOfWrongSizesAreRefused) {
    using nlohmann::json;
    PpoTrainer trainer(maze(), with_memory());
    // The members keep the order of the file, since spaces are compared as text.
    const auto text = nlohmann::ordered_json::parse(ppo_policy_text(maze(), trainer.model()));
    const auto refuses = [&](const char* pointer, const json& value,
                             const std::string& sentence = "its layers do not fit") {
        auto changed = text;
        changed[nlohmann::ordered_json::json_pointer(pointer)] = value;
        EXPECT_EQ(sentence_of([&] { read_ppo_policy(maze(), changed.dump()); }), sentence)
            << pointer;
    };
    EXPECT_EQ(sentence_of([&] { read_ppo_policy(maze(), text.dump()); }), "");
    refuses("/recurrent/units", 13);
    refuses("/recurrent/units", 0, "its number of units is 0, not an int from 1 to 16384");
    refuses("/recurrent/units", 2'000'000'000,
            "its number of units is 2000000000, not an int from 1 to 16384");
    refuses("/recurrent/state_bias", json::array({1, 2}));
    for (const char* const part : {"candidate", "reset", "update"}) {
        const std::string begin = "/recurrent/" + std::string(part);
        refuses((begin + "/bias").c_str(), json::array({1, 2}));
        refuses((begin + "/input").c_str(), json::array({json::array({1, 2})}));
        refuses((begin + "/state/3").c_str(), json::array({1, 2}));
    }
    auto without = text;
    without.erase("recurrent");
    EXPECT_EQ(sentence_of([&] { read_ppo_policy(maze(), without.dump()); }),
              "its layers do not fit");
    without = text;
    without["recurrent"].erase("reset");
    EXPECT_EQ(sentence_of([&] { read_ppo_policy(maze(), without.dump()); }),
              "it is not a policy of PPO or DRP, or something in it is missing");
}

TEST(Recurrent, RefusesWhatCannotBe) {
    PpoOptions options = with_memory();
    PpoTrainer trainer(maze(), options);
    const std::string bytes = trainer.save();
    options.recurrent = 0;
    PpoTrainer forgetful(maze(), options);
    EXPECT_EQ(sentence_of([&] { forgetful.load(bytes); }),
              "it is of a run with other networks: --hidden, --activation, --stack and "
              "--recurrent have to be as they were");
    options = with_memory();
    options.rollout = 1;
    options.environments = 400;
    EXPECT_EQ(sentence_of([&] { PpoTrainer(maze(), options); }),
              "a recurrent network learns from several steps in a row: it needs --segment, "
              "--rollout and --minibatch of at least 2");
}

// The sign at the entrance is needed at the junction, eleven steps later.
double learned_in_the_maze(const PpoOptions& options) {
    PpoTrainer trainer(maze(), options);
    while (!trainer.done()) trainer.update();
    const auto model = std::make_shared<PpoModel>(trainer.model());
    EpisodeOptions episodes;
    episodes.episodes = 200;
    const Policy policy = ppo_policy(maze(), model, false, 0, "ppo");
    return summary_of(run_episodes(maze(), policy, episodes, {})).undiscounted_return.mean;
}

TEST(Recurrent, RemembersTheSign) {
    PpoOptions options;
    options.steps = 80'000;
    options.environments = 16;
    options.minibatch = 256;
    options.epochs = 10;
    options.learning_rate = 1e-3;
    options.hidden = {32, 32};
    options.recurrent = 16;
    EXPECT_EQ(learned_in_the_maze(options), 4);
    options.recurrent = 0;
    options.observations.stack = 4;
    EXPECT_LT(learned_in_the_maze(options), 2.5);
}

}  // namespace
}  // namespace rddlc::solvers
