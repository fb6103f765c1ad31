#include "solvers/ppo/learner.hpp"

#include "solvers/network/adam.hpp"
#include "solvers/ppo/state_noise.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace rddlc::solvers {

namespace {

constexpr std::size_t chunk = 4 * tile;

std::size_t parts(std::size_t count, std::size_t size) {
    return (count + size - 1) / size;
}

std::size_t segments_per_chunk(const PpoOptions& options) {
    return std::max<std::size_t>(chunk / static_cast<std::size_t>(longest_segment(options)), 1);
}

void gather_rows(std::span<const std::uint32_t> samples, const auto* from, int row, auto* to) {
    const auto size = static_cast<std::size_t>(row);
    for (std::size_t s = 0; s < samples.size(); ++s)
        std::copy_n(from + samples[s] * size, size, to + s * size);
}

}  // namespace

std::size_t samples_per_chunk(const PpoOptions& options) {
    return segments_per_chunk(options) * static_cast<std::size_t>(longest_segment(options));
}

std::size_t gradient_count(const PpoOptions& options) {
    return parts(segments_per_minibatch(options), segments_per_chunk(options));
}

Learner::Learner(PpoModel& model, const PpoOptions& options, rddl::Team& team, const Ranks& ranks)
    : first_moments(model.parameters.size()),
      second_moments(model.parameters.size()),
      model_(model),
      options_(options),
      team_(team),
      ranks_(ranks),
      workplaces_(static_cast<std::size_t>(team.size())),
      policy_rows_(model.policy.rows),
      value_rows_(model.value.rows),
      memory_rows_(model.memory.rows) {
    const auto longest = static_cast<std::size_t>(longest_segment(options));
    segments_per_chunk_ = segments_per_chunk(options);
    const std::size_t chunks = gradient_count(options);
    gradients_.assign(chunks, std::vector<float>(model.parameters.size()));
    sums_.resize(chunks);
    if (model.noise == Noise::Sde)
        weight_variances_.resize(static_cast<std::size_t>(model.deviation_count()));
    for (Workplace& workplace : workplaces_) {
        const std::size_t samples = segments_per_chunk_ * longest;
        workplace.samples.reserve(samples);
        workplace.inputs.resize((model.recurrent > 0 ? samples : tile) *
                                static_cast<std::size_t>(model.input_row()));
        if (model.recurrent > 0) workplace.unrolled = Unrolled(model, segments_per_chunk_, longest);
        Tile& place = workplace.tile;
        const auto rows = [](auto& values, int row) {
            values.resize(std::size_t{tile} * static_cast<std::size_t>(row));
        };
        rows(place.numbers, model.actions.real_count());
        rows(place.shifts, model.actions.real_count());
        rows(place.log_deviations, model.actions.real_count());
        rows(place.d_log_deviations, model.actions.real_count());
        rows(place.indices, model.actions.index_count());
        rows(place.masks, model.actions.mask_size());
        for (auto* each : {&place.spreads, &place.log_probabilities, &place.advantages,
                           &place.values, &place.returns})
            rows(*each, 1);
        rows(place.policy_activations, static_cast<int>(model.policy.activations));
        rows(place.value_activations, static_cast<int>(model.value.activations));
        rows(place.scratch,
             static_cast<int>(std::max(model.policy.activations, model.value.activations)));
        rows(place.d_outputs, model.policy.padded_outputs());
        rows(place.d_values, model.value.padded_outputs());
    }
}

void Learner::gather(const Experience& experience, std::span<const std::uint32_t> samples,
                     Tile& place) const {
    const auto copy_rows = [&](const auto& from, auto& to, int row) {
        gather_rows(samples, from.data(), row, to.data());
    };
    copy_rows(experience.numbers, place.numbers, model_.actions.real_count());
    copy_rows(experience.shifts, place.shifts, model_.actions.real_count());
    copy_rows(experience.indices, place.indices, model_.actions.index_count());
    copy_rows(experience.masks, place.masks, model_.actions.mask_size());
    for (std::size_t s = 0; s < samples.size(); ++s) {
        const std::size_t sample = samples[s];
        place.spreads[s] = experience.spreads[sample];
        place.log_probabilities[s] = experience.log_probabilities[sample];
        place.advantages[s] = experience.advantages[sample];
        place.values[s] = experience.values[sample];
        place.returns[s] = experience.returns[sample];
    }
}

void Learner::learn_tile(const Experience& experience, std::span<const std::uint32_t> samples,
                         const LossWeights& weights, Tile& place, const float* inputs,
                         float* d_memory, float* gradient, LossSums& sums) const {
    gather(experience, samples, place);
    const NetworkFunctions<float>& functions = network_functions();
    const int count = static_cast<int>(samples.size()), row = model_.input_row();
    const auto results = [&](const Network& network, const std::vector<float>& activations) {
        return activations.data() + network.layers.back().values * samples.size();
    };
    functions.forward(model_.policy, model_.parameters.data(), count, inputs, row,
                      place.policy_activations.data());
    functions.forward(model_.value, model_.value_parameters(), count, inputs, row,
                      place.value_activations.data());
    const Samples<float> rows{
        place.numbers.data(),    place.shifts.data(), place.spreads.data(),
        place.indices.data(),    place.masks.data(),  place.log_probabilities.data(),
        place.advantages.data(), place.values.data(), place.returns.data()};
    // Noise that depends on the state has other deviations in each sample.
    const int units = model_.noisy_units(), reals = model_.actions.real_count();
    const float* const hidden = last_hidden(model_.policy, place.policy_activations.data(), count);
    const auto hidden_of = [&](int s) {
        return hidden + s * hidden_row(model_.policy);
    };
    for (int s = 0; s < count && units > 0; ++s)
        state_log_deviations(units, reals, weight_variances_.data(), hidden_of(s),
                             place.log_deviations.data() + s * reals);
    std::fill(place.d_log_deviations.begin(), place.d_log_deviations.end(), 0.0f);
    float* const d_deviations = gradient + model_.deviations_begin();
    add_loss(model_.actions, weights, rows, count, results(model_.policy, place.policy_activations),
             model_.policy.padded_outputs(),
             units > 0 ? place.log_deviations.data() : model_.log_deviations(),
             units > 0 ? reals : 0, results(model_.value, place.value_activations),
             model_.value.padded_outputs(), place.d_outputs.data(), place.d_values.data(),
             units > 0 ? place.d_log_deviations.data() : d_deviations, sums, &options_.stops);
    for (int s = 0; s < count && units > 0; ++s)
        add_state_noise_gradient(units, reals, weight_variances_.data(), hidden_of(s),
                                 place.log_deviations.data() + s * reals,
                                 place.d_log_deviations.data() + s * reals, d_deviations);
    functions.backward(model_.policy, policy_rows_.data(), count, inputs, row,
                       place.policy_activations.data(), place.d_outputs.data(),
                       place.scratch.data(), gradient, d_memory);
    functions.backward(model_.value, value_rows_.data(), count, inputs, row,
                       place.value_activations.data(), place.d_values.data(), place.scratch.data(),
                       gradient + model_.value_begin(), d_memory);
}

void Learner::learn_chunk(const Experience& experience, std::span<const std::uint32_t> segments,
                          const LossWeights& weights, Workplace& place, float* gradient,
                          LossSums& sums) const {
    if (model_.recurrent == 0) {
        // Each segment is one sample.
        for (std::size_t s = 0; s < segments.size() && !is_stopped(); s += tile) {
            const auto some = segments.subspan(s, std::min<std::size_t>(tile, segments.size() - s));
            gather_rows(some, experience.inputs.data(), model_.input_row(), place.inputs.data());
            learn_tile(experience, some, weights, place.tile, place.inputs.data(), nullptr,
                       gradient, sums);
        }
        return;
    }
    Unrolled& unrolled = place.unrolled;
    unrolled.lay_out(experience, segments, place.samples);
    const std::span<const std::uint32_t> samples = place.samples;
    float* const inputs = place.inputs.data();
    gather_rows(samples, experience.inputs.data(), model_.input_row(), inputs);
    unrolled.remember(inputs);
    for (std::size_t s = 0; s < samples.size() && !is_stopped(); s += tile)
        learn_tile(experience, samples.subspan(s, std::min<std::size_t>(tile, samples.size() - s)),
                   weights, place.tile, inputs + s * static_cast<std::size_t>(model_.input_row()),
                   unrolled.d_memory() + s * static_cast<std::size_t>(model_.memory.padded_units),
                   gradient, sums);
    unrolled.add_gradient(inputs, memory_rows_.data(), gradient + model_.memory_begin());
}

void Learner::add_up(std::vector<float>& gradient, LossSums& sums) {
    if (ranks_.count == 1) return;
    double* const numbers[] = {&sums.policy, &sums.value, &sums.entropy, &sums.kl, &sums.clipped};
    message_ = gradient;
    for (const double* number : numbers) message_.push_back(static_cast<float>(*number));
    ranks_.add_up(message_);
    std::copy_n(message_.begin(), gradient.size(), gradient.begin());
    for (std::size_t i = 0; i < std::size(numbers); ++i)
        *numbers[i] = static_cast<double>(message_[gradient.size() + i]);
}

LossSums Learner::learn(const Experience& experience, std::span<const std::uint32_t> segments,
                        const Moments& advantages, const Step& step) {
    LossWeights weights{options_.clip,
                        options_.value_clip,
                        options_.value_weight,
                        step.entropy_weight,
                        step.kl_penalty,
                        0,
                        1,
                        1 / advantages.count};
    if (options_.normalises_advantages && advantages.count > 1) {
        weights.advantage_mean = advantages.sum / advantages.count;
        const double squares =
            std::max(0.0, advantages.squares - advantages.sum * weights.advantage_mean);
        weights.advantage_scale = 1 / (std::sqrt(squares / (advantages.count - 1)) + 1e-8);
    }

    const NetworkFunctions<float>& functions = network_functions();
    if (model_.noisy_units() > 0)
        weight_variances(model_.noisy_units(), model_.actions.real_count(), model_.log_deviations(),
                         weight_variances_.data());
    functions.transpose(model_.policy, model_.parameters.data(), policy_rows_.data());
    functions.transpose(model_.value, model_.value_parameters(), value_rows_.data());
    if (model_.recurrent > 0)
        gru_functions().transpose(model_.memory, model_.memory_parameters(), memory_rows_.data());
    const std::size_t chunks = parts(segments.size(), segments_per_chunk_);
    std::atomic<std::size_t> next = 0;
    const auto work = [&](int worker) {
        for (std::size_t c = next++; c < chunks && !is_stopped(); c = next++) {
            std::vector<float>& gradient = gradients_[c];
            std::fill(gradient.begin(), gradient.end(), 0.0f);
            sums_[c] = {};
            const std::size_t first = c * segments_per_chunk_;
            const std::size_t count = std::min(segments_per_chunk_, segments.size() - first);
            learn_chunk(experience, segments.subspan(first, count), weights,
                        workplaces_[static_cast<std::size_t>(worker)], gradient.data(), sums_[c]);
        }
    };
    chunks > 1 ? team_.run(work) : work(0);
    if (is_stopped()) return {};

    LossSums all = sums_[0];
    std::vector<float>& gradient = gradients_[0];
    for (std::size_t c = 1; c < chunks; ++c) {
        functions.add(gradient.size(), gradients_[c].data(), gradient.data());
        all.policy += sums_[c].policy;
        all.value += sums_[c].value;
        all.entropy += sums_[c].entropy;
        all.kl += sums_[c].kl;
        all.clipped += sums_[c].clipped;
    }
    add_up(gradient, all);
    const double norm = std::sqrt(functions.squares(gradient.size(), gradient.data()));
    if (!std::isfinite(norm))
        throw Failure(fmt::format(
            "the gradient is not finite: the loss of the policy is {}, that of the values {}",
            all.policy * weights.sample_weight, all.value * weights.sample_weight));

    // https://pytorch.org/docs: clip_grad_norm_ and Adam, to be comparable.
    const double factor =
        options_.gradient_norm > 0 ? std::min(1.0, options_.gradient_norm / (norm + 1e-6)) : 1;
    adam_steps += 1;
    take(AdamStep{adam_steps, step.learning_rate, factor, 1e-5f}, gradient, first_moments,
         second_moments, model_.parameters);
    return all;
}

}  // namespace rddlc::solvers
