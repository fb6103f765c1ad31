// Over 400 lines: one class, the state of a training, in the order of an update.
#include "solvers/ppo/trainer.hpp"

#include "solvers/files/checkpoint.hpp"
#include "solvers/ppo/advantages.hpp"
#include "solvers/ppo/collector.hpp"
#include "solvers/ppo/first_noise.hpp"
#include "solvers/ppo/learner.hpp"
#include "solvers/ppo/memory_estimate.hpp"
#include "support/failure.hpp"

#include <rddl/batch/threads.hpp>
#include <rddl/values/philox.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <span>

namespace rddlc::solvers {

namespace {

const CheckpointKind checkpoint{"PPO", "rddl ppo checkpoint", 8};
constexpr std::size_t remembered_episodes = 100;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

void require(bool holds, const char* sentence) {
    if (!holds) throw Failure(sentence, {}, usage_error);
}

void check(const PpoOptions& options) {
    require(options.environments > 0 && options.rollout > 0, "PPO needs environments and steps");
    const std::int64_t samples = std::int64_t{options.environments} * options.rollout;
    require(samples < std::int64_t{1} << 31,
            "an update learns from less than 2^31 steps: --envs times --rollout is too much");
    require(options.minibatch <= samples,
            "a minibatch is larger than what is collected for an update: it needs --minibatch at "
            "most --envs times --rollout");
    require(options.observations.stack >= 1, "PPO sees at least one observation");
    require(!options.hidden.empty(), "PPO needs a hidden layer");
    require(options.noise_steps > 0, "noise stays for at least one step");
    require(options.recurrent >= 0, "units that remember are 0 or more");
    require(options.recurrent == 0 || longest_segment(options) > 1,
            "a recurrent network learns from several steps in a row: it needs --segment, --rollout "
            "and --minibatch of at least 2");
    for (const int width : options.hidden) require(width > 0, "a layer needs units");
}

// 0 .. count - 1, shuffled (Fisher and Yates) by numbers of this seed and place alone.
void shuffle(std::vector<std::uint32_t>& order, std::uint64_t seed, std::uint64_t update,
             std::uint64_t epoch, std::uint64_t rank) {
    using namespace rddl::philox;
    std::iota(order.begin(), order.end(), 0u);
    Block<std::uint64_t> words{};
    for (std::size_t i = order.size(); i-- > 1;) {
        if (i % 4 == 3 || i == order.size() - 1)
            words = generate<draw_rounds>(
                Block<std::uint64_t>{i / 4, epoch, update & 0xFFFFFFFF, update >> 32},
                Key<std::uint64_t>{seed & 0xFFFFFFFF, (seed >> 32) ^ 0x73687566 ^ rank << 8});
        const std::uint64_t other = (words[i % 4] & 0xFFFFFFFF) * (i + 1) >> 32;
        std::swap(order[i], order[other]);
    }
}

// Chooses the noise that it begins with, and shortens the rollout where it may.
PpoModel model_that_fits(const rddl_simulator& simulator, PpoOptions& options) {
    const ObservationSpace observations = observation_space(simulator, options.observations);
    const ActionSpace actions = action_space(simulator, options.stops);
    PpoModel model = model_without_parameters(observations, actions, options);
    if (options.shortens_rollout) options.rollout = fitting_rollout(simulator, model, options);
    require_memory(simulator, model, options);
    if (!options.log_deviation)
        options.log_deviation = first_log_deviation(simulator, observations, actions, options);
    make_parameters(model, options);
    return model;
}

}  // namespace

struct PpoTrainer::State {
    State(const rddl_simulator& its_simulator, const PpoOptions& its_options,
          const Ranks& its_ranks)
        : simulator(its_simulator),
          options(its_options),
          ranks(its_ranks),
          model(model_that_fits(simulator, options)),
          team(options.threads),
          learner(model, options, team, ranks),
          experience(model, options.environments, options.rollout, longest_segment(options)),
          feature_statistics(static_cast<std::size_t>(model.features())),
          order(experience.segments.count()),
          gamma(std::min(options.gamma, simulator.problem->discount)),
          learning_rate(options.learning_rate),
          kl_penalty(options.kl_penalty) {
        const int shards = std::min(team.size(), options.environments);
        for (int s = 0; s < shards; ++s) {
            const rddl::Range share = rddl::share_of(s, shards, options.environments, 8);
            collectors.push_back(std::make_unique<Collector>(
                simulator, model, options,
                EnvironmentShare{share.begin, share.end - share.begin,
                                 std::int64_t{ranks.number} * options.environments}));
        }
        // Nothing is allocated later.
        episodes.reserve(remembered_episodes);
        sorted.reserve(experience.count());
        const std::size_t minibatches = order.size() / segments_per_minibatch(options) + 1;
        moments.reserve(std::max({feature_statistics.size() + 1, minibatches, std::size_t{3}}));
        entropy_weight =
            options.entropy_weight.value_or(model.actions.logit_count > 0 ? 0.01 : 0.0);
    }

    void for_each_collector(const auto& work) {
        team.run([&](int worker) {
            if (static_cast<std::size_t>(worker) < collectors.size())
                work(*collectors[static_cast<std::size_t>(worker)]);
        });
    }

    bool is_stopped() const { return options.stops && options.stops(); }

    void collect(std::int64_t number) {
        for_each_collector([&](Collector& collector) {
            collector.begin_update(options.seed, number);
            collector.collect(experience, options.seed, number);
        });
    }

    // Adds up the moments of all ranks.
    void add_up(std::vector<Moments>& sums) const {
        static_assert(sizeof(Moments) == 3 * sizeof(double));
        ranks.add_up({&sums.front().count, 3 * sums.size()});
    }

    // Environment by environment, so that shards do not matter.
    void learn_scales() {
        // The moments of each feature, and of the returns.
        const std::size_t features = feature_statistics.size();
        std::vector<Moments>& all = moments;
        all.assign(features + 1, {});
        for (const auto& collector : collectors) {
            for (std::size_t i = 0; i < collector->feature_moments().size(); ++i)
                all[i % features].add(collector->feature_moments()[i]);
        }
        all[features] = moments_of_returns();
        add_up(all);
        if (options.normalises_observations)
            for (std::size_t f = 0; f < features; ++f) {
                feature_statistics[f].mean = static_cast<double>(model.normaliser.means[f]);
                feature_statistics[f].add(all[f]);
                model.normaliser.means[f] = static_cast<float>(feature_statistics[f].mean);
                model.normaliser.factors[f] =
                    static_cast<float>(1 / feature_statistics[f].deviation());
            }
        return_statistics.add(all[features]);
        note_value_scale();
    }

    // The moments of discounted sums of rewards, about the mean so far. Losses far beyond the usual
    // ones are cut: else a few ruinous episodes would make all others look alike.
    Moments moments_of_returns() {
        sorted = experience.so_far;
        const double least = least_usual(sorted);
        Moments found;
        for (const float each : experience.so_far)
            found.add(std::max(static_cast<double>(each), least) - return_statistics.mean);
        return found;
    }

    // A reward of 1 in the units of values.
    double reward_factor() const {
        return options.normalises_rewards ? 1 / return_statistics.deviation() : 1;
    }

    void note_value_scale() {
        model.value_scale = 1 / reward_factor();
        model.value_discount = gamma;
    }

    void estimate() {
        if (options.normalises_rewards) {
            const double factor = reward_factor();
            for (float& reward : experience.rewards)
                reward = static_cast<float>(
                    std::clamp(static_cast<double>(reward) * factor, -10.0, 10.0));
        }
        add_curiosity();
        for (int e = 0; e < experience.environments; ++e)
            estimate_advantages({experience.rollout, experience.environments,
                                 experience.rewards.data() + e, experience.values.data() + e,
                                 experience.next_values.data() + e, experience.ends.data() + e},
                                gamma, options.lambda, experience.advantages.data() + e,
                                experience.returns.data() + e);
    }

    void add_curiosity() {
        if (!options.curious) return;
        double returns[remembered_episodes];
        for (std::size_t e = 0; e < episodes.size(); ++e)
            returns[e] = episodes[e].undiscounted_return;
        const auto weight = static_cast<float>(curiosity({returns, episodes.size()}));
        if (weight == 0) return;
        for (std::size_t s = 0; s < experience.count(); ++s)
            experience.rewards[s] += weight * experience.novelties[s];
    }

    double scheduled_rate() const {
        if (options.schedule != LearningRate::Linear) return learning_rate;
        const double done =
            static_cast<double>(progress.steps) / static_cast<double>(options.steps);
        return options.learning_rate * std::max(0.0, 1 - done);
    }

    // Sums up the advantages of all ranks, as they are in `order`: the normalisation of each
    // minibatch's advantages is known before the first of them is learned from.
    void sum_up_advantages() {
        const std::size_t size = segments_per_minibatch(options);
        const Segments& segments = experience.segments;
        moments.assign((order.size() + size - 1) / size, {});
        for (std::size_t s = 0; s < order.size(); ++s)
            for (int t = 0; t < segments.length(order[s]); ++t)
                moments[s / size].add(
                    static_cast<double>(experience.advantages[segments.sample(order[s], t)]));
        add_up(moments);
    }

    void learn(double rate) {
        LossSums sums;
        double samples = 0, kl_sum = 0, kl_samples = 0;
        progress.epochs = 0;
        bool stops = false;
        for (int epoch = 0; epoch < options.epochs && !stops; ++epoch) {
            shuffle(order, options.seed, static_cast<std::uint64_t>(progress.updates),
                    static_cast<std::uint64_t>(epoch), static_cast<std::uint64_t>(ranks.number));
            sum_up_advantages();
            kl_sum = kl_samples = 0;
            const std::size_t size = segments_per_minibatch(options);
            for (std::size_t s = 0; s < order.size() && !stops; s += size) {
                const std::span<const std::uint32_t> batch(order.data() + s,
                                                           std::min(size, order.size() - s));
                const Moments& advantage = moments[s / size];
                const LossSums some =
                    learner.learn(experience, batch, advantage, {rate, entropy_weight, kl_penalty});
                const double count = advantage.count;
                sums.policy += some.policy;
                sums.value += some.value;
                sums.entropy += some.entropy;
                sums.clipped += some.clipped;
                samples += count;
                kl_sum += some.kl;
                kl_samples += count;
                stops = (options.kl_stop > 0 && some.kl / count > 1.5 * options.kl_stop) ||
                        is_stopped();
            }
            progress.epochs += 1;
        }
        progress.policy_loss = sums.policy / samples;
        progress.value_loss = sums.value / samples;
        progress.entropy = sums.entropy / samples;
        progress.clip_fraction = sums.clipped / samples;
        progress.kl = kl_sum / kl_samples;
        progress.learning_rate = rate;
        adapt();
    }

    // To how far the policy has moved in the last epoch.
    void adapt() {
        if (options.schedule == LearningRate::Kl) {
            if (progress.kl > 2 * options.kl_target) learning_rate /= 1.5;
            if (progress.kl < 0.5 * options.kl_target) learning_rate *= 1.5;
            learning_rate = std::clamp(learning_rate, 1e-6, 1e-2);
        }
        if (options.kl_penalty > 0) {
            if (progress.kl > 2 * options.kl_target) kl_penalty *= 1.5;
            if (progress.kl < 0.5 * options.kl_target) kl_penalty *= 0.5;
        }
    }

    void note(std::span<const FinishedEpisode> ended) {
        progress.episodes += static_cast<std::int64_t>(ended.size());
        ended = ended.last(std::min(ended.size(), remembered_episodes));
        const std::size_t all = episodes.size() + ended.size();
        if (all > remembered_episodes)
            episodes.erase(episodes.begin(), episodes.begin() + static_cast<std::ptrdiff_t>(
                                                                    all - remembered_episodes));
        episodes.insert(episodes.end(), ended.begin(), ended.end());
    }

    // Notes the episodes of all ranks, in their order.
    void note_episodes() {
        if (ranks.count == 1) {
            for (const auto& collector : collectors) note(collector->finished());
            return;
        }
        SavingArchive own;
        for (const auto& collector : collectors) own(collector->finished());
        std::vector<FinishedEpisode> ended;
        for (const std::string& theirs : ranks.gather(own.bytes()))
            for (LoadingArchive archive(theirs); !archive.at_end(); note(ended)) archive(ended);
    }

    void report() {
        std::int64_t repaired_now = 0;
        progress.simulator_seconds = 0;
        progress.episodes = 0;
        for (const auto& collector : collectors) {
            repaired_now += collector->repaired();
            progress.simulator_seconds += collector->simulator_seconds();
        }
        note_episodes();
        const auto count = static_cast<double>(std::max<std::size_t>(episodes.size(), 1));
        progress.mean_return = progress.mean_discounted_return = progress.mean_length =
            progress.success_rate = 0;
        for (const FinishedEpisode& episode : episodes) {
            progress.mean_return += episode.undiscounted_return / count;
            progress.mean_discounted_return += episode.discounted_return / count;
            progress.mean_length += static_cast<double>(episode.length) / count;
            progress.success_rate += (episode.causes & RDDL_TERMINATED ? 1 : 0) / count;
        }
        if (episodes.empty())
            progress.mean_return = progress.mean_discounted_return = progress.mean_length =
                std::nan("");

        moments.assign(3, {});
        Moments &returns = moments[0], &errors = moments[1], &repairs = moments[2];
        repairs.count = static_cast<double>(experience.count());
        repairs.sum = static_cast<double>(repaired_now - repaired);
        repaired = repaired_now;
        for (std::size_t s = 0; s < experience.count(); ++s) {
            returns.add(static_cast<double>(experience.returns[s]));
            errors.add(static_cast<double>(experience.returns[s]) -
                       static_cast<double>(experience.values[s]));
        }
        add_up(moments);
        progress.repaired_rate = repairs.sum / repairs.count;
        const auto variance = [](const Moments& m) {
            return m.squares / m.count - m.sum / m.count * (m.sum / m.count);
        };
        progress.explained_variance =
            variance(returns) > 0 ? 1 - variance(errors) / variance(returns) : std::nan("");
        double deviation = 0;
        for (int r = 0; r < model.deviation_count(); ++r)
            deviation += std::exp(static_cast<double>(model.log_deviations()[r]));
        progress.deviation = deviation / std::max(1, model.deviation_count());
    }

    // Without a scale, the first update would see features of any size: the untrained policy makes
    // some steps, from which nothing else is learned.
    void warm_up() {
        if (!options.normalises_observations && !options.normalises_rewards) return;
        collect(0);
        if (is_stopped()) return;
        learn_scales();
        // The second round sums up about a mean that is near.
        collect(0);
        if (is_stopped()) return;
        std::fill(feature_statistics.begin(), feature_statistics.end(), RunningStatistics{});
        return_statistics = {0, return_statistics.mean, 1};
        learn_scales();
    }

    // The scales of what was shown are those that the policy begins with.
    void learn_scales_of(const Demonstrations& shown) {
        const std::size_t features = feature_statistics.size();
        std::vector<Moments> all(features + 1);
        double running = 0;
        for (std::size_t s = 0; s < shown.count(); ++s) {
            for (std::size_t f = 0; f < features; ++f)
                all[f].add(static_cast<double>(shown.features[s * features + f]));
            running = running * gamma + shown.rewards[s];
            all[features].add(running);
            if (shown.is_last[s]) running = 0;
        }
        for (std::size_t f = 0; f < features && options.normalises_observations; ++f) {
            feature_statistics[f] = {};
            feature_statistics[f].add(all[f]);
            model.normaliser.means[f] = static_cast<float>(feature_statistics[f].mean);
            model.normaliser.factors[f] = static_cast<float>(1 / feature_statistics[f].deviation());
        }
        return_statistics.add(all[features]);
        note_value_scale();
    }

    // Samples of which one is as good as the other.
    Experience experience_of(const Demonstrations& shown) const {
        Experience made(model, static_cast<int>(shown.count()), 1, 1);
        const ActionSpace& actions = model.actions;
        const auto at = [](auto& values, std::size_t s, int size) {
            return values.data() + s * static_cast<std::size_t>(size);
        };
        std::fill(made.masks.begin(), made.masks.end(), std::uint8_t{1});
        // So that no ratio of probabilities, of which nothing depends here, overflows.
        std::fill(made.log_probabilities.begin(), made.log_probabilities.end(), 1e4f);
        const double factor = reward_factor();
        double future = 0;
        for (std::size_t s = shown.count(); s-- > 0;) {
            model.normaliser.write(at(shown.features, s, model.features()),
                                   at(made.inputs, s, model.input_row()));
            std::int32_t* const indices = at(made.indices, s, actions.index_count());
            read_action(actions, at(shown.actions, s, actions.column_count),
                        at(made.numbers, s, actions.real_count()), indices);
            // No sub-action follows the one that stops.
            for (int p = 1; p < actions.max_sub_actions; ++p)
                if (indices[p - 1] <= 0) indices[p] = -1;
            if (shown.is_last[s]) future = 0;
            future = factor * shown.rewards[s] + gamma * future;
            made.returns[s] = static_cast<float>(future);
        }
        return made;
    }

    // Raises the likelihood of what was shown. It is the gradient of the penalty on the divergence
    // from the policy that acted, without any advantages.
    void imitate(const Demonstrations& shown) {
        require(ranks.count == 1, "a run on several ranks cannot imitate");
        require(options.recurrent == 0, "a policy with a memory cannot imitate");
        constexpr std::size_t gradient_steps = 3000, samples = 256;
        constexpr double rate = 1e-3;
        constexpr float least_log_deviation = -1.5f;  // so that PPO still explores
        learn_scales_of(shown);
        const Experience made = experience_of(shown);
        std::vector<std::uint32_t> places(made.count());
        const std::size_t size =
            std::min({samples, made.count(), static_cast<std::size_t>(options.minibatch)});
        for (std::size_t step = 0, epoch = 0; step < gradient_steps && !is_stopped(); ++epoch) {
            shuffle(places, options.seed, 0x696D6974, epoch, 0);
            for (std::size_t s = 0; s + size <= places.size() && step < gradient_steps;
                 s += size, ++step) {
                const double left =
                    1 - static_cast<double>(step) / static_cast<double>(gradient_steps);
                learner.learn(made, {places.data() + s, size}, {static_cast<double>(size), 0, 0},
                              {rate * left, 0, 1});
            }
        }
        float* const deviations = model.parameters.data() + model.deviations_begin();
        for (int d = 0; d < model.deviation_count(); ++d)
            deviations[d] = std::max(deviations[d], least_log_deviation);
        std::fill(learner.first_moments.begin(), learner.first_moments.end(), 0.0f);
        std::fill(learner.second_moments.begin(), learner.second_moments.end(), 0.0f);
        learner.adam_steps = 0;
        has_imitated = true;
    }

    void update() {
        if (progress.updates == 0 && !has_imitated) warm_up();
        auto begin = Clock::now();
        const double rate = scheduled_rate();
        collect(progress.updates);
        if (is_stopped()) return;  // half a rollout teaches nothing
        learn_scales();
        estimate();
        progress.collect_seconds = seconds_since(begin);
        begin = Clock::now();
        try {
            learn(rate);
        } catch (const Failure& failure) {
            throw Failure(fmt::format("after {} steps {}", progress.steps, failure.what()),
                          "try a lower --lr, or check for huge rewards and observations");
        }
        progress.learn_seconds = seconds_since(begin);
        progress.steps += static_cast<std::int64_t>(experience.count()) * ranks.count;
        progress.updates += 1;
        report();
    }

    template <class Archive>
    void archive(Archive& archive) {
        archive(progress);
        const std::size_t size = model.parameters.size();
        Activation activation = model.activation;
        archive(activation);
        archive(model.parameters);
        if (activation != model.activation || model.parameters.size() != size)
            throw Failure(
                "it is of a run with other networks: --hidden, --activation, --stack and "
                "--recurrent have to be as they were");
        archive.fixed(model.normaliser.means);
        archive.fixed(model.normaliser.factors);
        archive(model.value_scale);
        archive(model.value_discount);
        archive.fixed(learner.first_moments);
        archive.fixed(learner.second_moments);
        archive(learner.adam_steps);
        archive.fixed(feature_statistics);
        archive(return_statistics);
        archive(learning_rate);
        archive(kl_penalty);
        archive(has_imitated);
        archive(episodes);
        archive_environments(archive);
    }

    // Archives the environments of all ranks, one after the other.
    template <class Archive>
    void archive_environments(Archive& archive) {
        int count = ranks.count;
        archive(count);
        if (count != ranks.count)
            throw Failure(
                fmt::format("it is of a run of {} ranks, and this has {}", count, ranks.count));
        SavingArchive saved;
        if constexpr (!Archive::is_loading)
            for (const auto& collector : collectors) collector->archive(saved);
        std::vector<std::string> all(static_cast<std::size_t>(count));
        if constexpr (!Archive::is_loading) all = ranks.gather(saved.bytes());
        for (std::string& bytes : all) archive(bytes);
        if constexpr (Archive::is_loading) {
            LoadingArchive own(all[static_cast<std::size_t>(ranks.number)]);
            for (const auto& collector : collectors) collector->archive(own);
        }
    }

    const rddl_simulator& simulator;
    const Fingerprint problem = fingerprint(simulator);
    PpoOptions options;
    Ranks ranks;
    PpoModel model;
    rddl::Team team;
    Learner learner;
    Experience experience;
    std::vector<std::unique_ptr<Collector>> collectors;
    std::vector<RunningStatistics> feature_statistics;
    RunningStatistics return_statistics;
    std::vector<std::uint32_t> order;
    std::vector<FinishedEpisode> episodes;  // the last ones
    std::vector<Moments> moments;           // room for what is summed up
    std::vector<float> sorted;              // the same for quantiles
    double gamma, learning_rate, kl_penalty, entropy_weight = 0;
    std::int64_t repaired = 0;
    bool has_imitated = false;
    PpoProgress progress;
};

PpoTrainer::PpoTrainer(const rddl_simulator& simulator, const PpoOptions& options,
                       const Ranks& ranks) {
    check(options);
    state_ = std::make_unique<State>(simulator, options, ranks);
}
PpoTrainer::~PpoTrainer() = default;

void PpoTrainer::imitate(const Demonstrations& shown) {
    state_->imitate(shown);
}
void PpoTrainer::update() {
    state_->update();
}
bool PpoTrainer::done() const {
    return state_->progress.steps >= state_->options.steps;
}
const PpoModel& PpoTrainer::model() const {
    return state_->model;
}
const PpoOptions& PpoTrainer::options() const {
    return state_->options;
}
const PpoProgress& PpoTrainer::progress() const {
    return state_->progress;
}

std::string PpoTrainer::save() const {
    SavingArchive archive;
    begin_checkpoint(archive, checkpoint, state_->problem);
    state_->archive(archive);
    return archive.bytes();
}

void PpoTrainer::load(std::string_view bytes) {
    LoadingArchive archive(bytes);
    begin_checkpoint(archive, checkpoint, state_->problem);
    state_->archive(archive);
}

}  // namespace rddlc::solvers
