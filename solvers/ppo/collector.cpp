#include "solvers/ppo/collector.hpp"

#include <rddl/random/random.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace rddlc::solvers {

namespace {

rddl_batch_options batch_options(std::int64_t count) {
    rddl_batch_options options{};
    options.environment_count = count;
    options.thread_count = 1;
    options.autoreset = RDDL_AUTORESET_SAME_STEP;
    return options;
}

// Different for each environment and update.
std::uint64_t seed_of(std::uint64_t seed, std::int64_t environment, std::int64_t update) {
    const rddl::StreamKey key = rddl::stream_key(seed, static_cast<std::uint64_t>(environment),
                                                 static_cast<std::uint64_t>(update));
    return static_cast<std::uint64_t>(key.high) << 32 | key.low;
}

}  // namespace

Collector::Collector(const rddl_simulator& simulator, const PpoModel& model,
                     const PpoOptions& options, const EnvironmentShare& share)
    : simulator_(simulator),
      model_(model),
      options_(options),
      gamma_(std::min(options.gamma, simulator.problem->discount)),
      bootstraps_(options.bootstraps.value_or(!model.observations.time)),
      first_(share.first),
      count_(share.count),
      origin_(share.origin),
      batch_(create_batch(simulator, batch_options(share.count))),
      distribution_(simulator, model.actions, options.noise, options.correlation, share.count),
      state_noise_(model, share.count),
      memories_(model, share.count),
      seen_(model, static_cast<std::size_t>(share.count)) {
    distribution_.set_stops(&options.stops);
    const auto environments = static_cast<std::size_t>(share.count);
    const auto features = static_cast<std::size_t>(model.features());
    const auto columns = static_cast<std::size_t>(model.observations.column_count());
    features_.resize(environments * features);
    observations_.resize(environments * columns);
    final_observations_.resize(environments * columns);
    final_features_.resize(features);
    inputs_.resize(static_cast<std::size_t>(model.input_row()));
    actions_.resize(environments * static_cast<std::size_t>(model.actions.column_count));
    activations_.resize(tile * std::max(model.policy.activations, model.value.activations));
    outputs_.resize(environments * static_cast<std::size_t>(model.policy.padded_outputs()));
    rewards_.resize(environments);
    for (auto* each : {&terminated_, &truncated_, &causes_}) each->resize(environments);
    steps_.resize(environments);
    for (auto* each : {&running_returns_, &sums_, &discounted_sums_}) each->resize(environments);
    discounts_.assign(environments, 1.0);
    feature_moments_.resize(environments * features);
    seeds_.resize(environments);
    // The upper bound, so that nothing is allocated later.
    finished_.reserve(environments * static_cast<std::size_t>(options.rollout));
}

void Collector::begin_update(std::uint64_t seed, std::int64_t update) {
    for (std::int64_t e = 0; e < count_; ++e)
        seeds_[static_cast<std::size_t>(e)] = seed_of(seed, origin_ + first_ + e, update);
    require_done(simulator_, simulator_.set_seeds(batch_.get(), 0, count_, seeds_.data()));
    std::fill(feature_moments_.begin(), feature_moments_.end(), Moments{});
    finished_.clear();
    simulator_seconds_ = 0;
    if (update > 0) return;
    // The first episodes begin with these numbers.
    require_done(simulator_, simulator_.reset(batch_.get(), nullptr, nullptr));
    require_done(simulator_,
                 simulator_.get_observation_values(batch_.get(), RDDL_FLOAT, observations_.data()));
    for (std::int64_t e = 0; e < count_; ++e) {
        write_features(model_.observations,
                       observations_.data() + e * model_.observations.column_count(), 0, true,
                       features_.data() + e * model_.features());
        distribution_.begin_episode(e);
        state_noise_.begin_episode(e);
        memories_.begin_episode(e);
        const auto at = static_cast<std::size_t>(e);
        seen_.begin_episode(at, features_.data() + e * model_.features());
        steps_[at] = 0;
        running_returns_[at] = sums_[at] = discounted_sums_[at] = 0;
        discounts_[at] = 1;
    }
}

void Collector::collect(Experience& experience, std::uint64_t seed, std::int64_t update) {
    if (state_noise_.is_used()) state_noise_.look_at_policy();
    for (int t = 0, part = 0; t < experience.rollout; ++t) {
        if (options_.stops && options_.stops()) return;
        if (experience.segments.begins(part, t)) note_memories(experience, part++);
        act(experience, t, seed, update);
        if (options_.stops && options_.stops()) return;  // actions need not be chosen to the end
        step(experience, t);
    }
    estimate_values(experience);
}

void Collector::note_memories(Experience& experience, int part) {
    const auto row = static_cast<std::size_t>(model_.memory.padded_units);
    const std::int64_t first = std::int64_t{part} * experience.environments + first_;
    std::copy_n(memories_.of(0), static_cast<std::size_t>(count_) * row,
                experience.memories.data() + static_cast<std::size_t>(first) * row);
}

void Collector::act(Experience& experience, std::int64_t t, std::uint64_t seed,
                    std::int64_t update) {
    const std::size_t begin = static_cast<std::size_t>(t * experience.environments + first_);
    const int width = model_.features(), row = model_.input_row();
    const int output_row = model_.policy.padded_outputs();
    float* const rows = experience.inputs.data() + begin * static_cast<std::size_t>(row);
    for (std::int64_t e = 0; e < count_; ++e)
        model_.normaliser.write(features_.data() + e * width, rows + e * row);
    const auto key_of = [&](std::int64_t e) {
        return ChoiceKey{seed, static_cast<std::uint64_t>(origin_ + first_ + e),
                         static_cast<std::uint64_t>(update * experience.rollout + t)};
    };
    const NetworkFunctions<float>& functions = network_functions();
    for (std::int64_t e = 0; e < count_; e += tile) {
        const int some = static_cast<int>(std::min<std::int64_t>(tile, count_ - e));
        memories_.remember(e, some, rows + e * row);
        functions.forward(model_.policy, model_.parameters.data(), some, rows + e * row, row,
                          activations_.data());
        std::copy_n(activations_.data() +
                        model_.policy.layers.back().values * static_cast<std::size_t>(some),
                    some * output_row, outputs_.data() + e * output_row);
        for (int i = 0; i < some && state_noise_.is_used(); ++i)
            state_noise_.make(e + i,
                              last_hidden(model_.policy, activations_.data(), some) +
                                  i * hidden_row(model_.policy),
                              key_of(e + i));
    }
    const auto at = [&](auto& values, int size) {
        return values.data() + begin * static_cast<std::size_t>(size);
    };
    const ActionSpace& actions = model_.actions;
    const Chosen chosen{at(experience.numbers, actions.real_count()),
                        at(experience.shifts, actions.real_count()),
                        at(experience.spreads, 1),
                        at(experience.indices, actions.index_count()),
                        at(experience.masks, actions.mask_size()),
                        at(experience.log_probabilities, 1)};
    distribution_.choose(
        batch_.get(), outputs_.data(), output_row,
        state_noise_.is_used() ? state_noise_.deviations() : Deviations{model_.log_deviations()},
        key_of, chosen, actions_.data());
}

void Collector::count_features(std::size_t e) {
    const auto width = static_cast<std::size_t>(model_.features());
    for (std::size_t f = 0; f < width; ++f)
        feature_moments_[e * width + f].add(static_cast<double>(features_[e * width + f]) -
                                            static_cast<double>(model_.normaliser.means[f]));
}

void Collector::step(Experience& experience, std::int64_t t) {
    const int columns = model_.observations.column_count(), width = model_.features();
    if (options_.normalises_observations)
        for (std::size_t e = 0; e < steps_.size(); ++e) count_features(e);
    rddl_transition out{};
    out.struct_size = sizeof out;
    out.rewards = rewards_.data();
    out.terminated = terminated_.data();
    out.truncated = truncated_.data();
    out.causes = causes_.data();
    out.final_observation_values = final_observations_.data();
    const auto begin = std::chrono::steady_clock::now();
    require_done(simulator_, simulator_.step_values(batch_.get(), RDDL_FLOAT, actions_.data(),
                                                    observations_.data(), &out));
    simulator_seconds_ +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

    for (std::size_t e = 0; e < steps_.size(); ++e) {
        const std::size_t sample =
            static_cast<std::size_t>(t * experience.environments + first_) + e;
        float* const features = features_.data() + e * static_cast<std::size_t>(width);
        const float* const values = observations_.data() + e * static_cast<std::size_t>(columns);
        const bool faulted = causes_[e] & RDDL_FAULTED;  // a step that faults is not made
        const double reward = faulted ? 0 : rewards_[e];
        if (!std::isfinite(reward)) throw not_finite(e);
        experience.rewards[sample] = static_cast<float>(reward);
        running_returns_[e] = running_returns_[e] * gamma_ + reward;
        experience.so_far[sample] = static_cast<float>(running_returns_[e]);
        sums_[e] += reward;
        discounted_sums_[e] += discounts_[e] * reward;
        discounts_[e] *= simulator_.problem->discount;
        if (!faulted) ++steps_[e];
        const bool ends = terminated_[e] || truncated_[e];
        experience.ends[sample] = ends;
        if (!ends) {
            write_features(model_.observations, values, steps_[e], false, features);
            experience.novelties[sample] =
                seen_.widen(e, features, model_.normaliser.factors.data());
            continue;
        }
        const bool by_horizon_alone = causes_[e] == RDDL_TRUNCATED_HORIZON;
        const bool goes_on = !terminated_[e] && (bootstraps_ || !by_horizon_alone);
        if (goes_on) {
            std::copy_n(features, width, final_features_.data());
            write_features(model_.observations,
                           final_observations_.data() + e * static_cast<std::size_t>(columns),
                           steps_[e], false, final_features_.data());
            experience.next_values[sample] =
                value_of(static_cast<std::int64_t>(e), final_features_.data());
        } else {
            experience.next_values[sample] = 0;
        }
        finished_.push_back({sums_[e], discounted_sums_[e], steps_[e], causes_[e]});
        sums_[e] = discounted_sums_[e] = running_returns_[e] = 0;
        discounts_[e] = 1;
        steps_[e] = 0;
        distribution_.begin_episode(static_cast<std::int64_t>(e));
        state_noise_.begin_episode(static_cast<std::int64_t>(e));
        memories_.begin_episode(static_cast<std::int64_t>(e));
        write_features(model_.observations, values, 0, true, features);
        seen_.begin_episode(e, features);
        experience.novelties[sample] = 0;
    }
}

Failure Collector::not_finite(std::size_t e) const {
    return Failure(
        fmt::format("PPO learns from finite rewards alone: the reward of step {} of an episode of "
                    "environment {} is {}",
                    steps_[e], first_ + static_cast<std::int64_t>(e), rewards_[e]),
        "'rddl run --policy random --trace' shows what leads to such rewards");
}

// The value of the next state of the episode.
float Collector::value_of(std::int64_t e, const float* features) {
    model_.normaliser.write(features, inputs_.data());
    memories_.look(e, 1, inputs_.data());
    network_functions().forward(model_.value, model_.value_parameters(), 1, inputs_.data(),
                                model_.input_row(), activations_.data());
    return activations_[model_.value.layers.back().values];
}

// Estimates the values of all samples of its environments, and of their present states.
void Collector::estimate_values(Experience& experience) {
    const int width = model_.features(), row = model_.input_row();
    const std::size_t result = model_.value.layers.back().values;
    const NetworkFunctions<float>& functions = network_functions();
    const auto write = [&](std::int64_t sample, int count) {
        functions.forward(model_.value, model_.value_parameters(), count,
                          experience.inputs.data() + sample * row, row, activations_.data());
        for (int i = 0; i < count; ++i)
            experience.values[static_cast<std::size_t>(sample + i)] =
                activations_[result * static_cast<std::size_t>(count) +
                             static_cast<std::size_t>(i * padding)];
    };
    const std::int64_t samples = static_cast<std::int64_t>(experience.count());
    if (count_ == experience.environments)
        for (std::int64_t s = 0; s < samples; s += tile)
            write(s, static_cast<int>(std::min<std::int64_t>(tile, samples - s)));
    else
        for (std::int64_t t = 0; t < experience.rollout; ++t)
            for (std::int64_t e = 0; e < count_; e += tile)
                write(t * experience.environments + first_ + e,
                      static_cast<int>(std::min<std::int64_t>(tile, count_ - e)));

    const std::int64_t last =
        (experience.rollout - 1) * static_cast<std::int64_t>(experience.environments) + first_;
    for (std::int64_t e = 0; e < count_; ++e) {
        const auto sample = static_cast<std::size_t>(last + e);
        if (!experience.ends[sample])
            experience.next_values[sample] = value_of(e, features_.data() + e * width);
    }
}

template <class Archive>
void Collector::archive(Archive& archive) {
    std::vector<std::byte> states(static_cast<std::size_t>(count_) *
                                  static_cast<std::size_t>(simulator_.problem->state_size));
    if constexpr (!Archive::is_loading)
        require_done(simulator_, simulator_.get_state(batch_.get(), 0, count_, states.data()));
    archive(states);
    if (states.size() !=
        static_cast<std::size_t>(count_) * static_cast<std::size_t>(simulator_.problem->state_size))
        throw Failure("it is of a run with another --envs or --threads");
    archive.fixed(features_);
    archive.fixed(distribution_.noise());
    archive.fixed(distribution_.has_noise());
    state_noise_.archive(archive);
    memories_.archive(archive);
    seen_.archive(archive);
    archive.fixed(steps_);
    for (auto* each : {&running_returns_, &sums_, &discounted_sums_, &discounts_})
        archive.fixed(*each);
    if constexpr (Archive::is_loading)
        require_done(simulator_,
                     simulator_.set_state(batch_.get(), 0, count_, states.data(), steps_.data()));
}

template void Collector::archive(SavingArchive&);
template void Collector::archive(LoadingArchive&);

}  // namespace rddlc::solvers
