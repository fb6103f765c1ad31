// The rollout buffer of an update: all steps of all environments between two updates.
#pragma once

#include "solvers/action_distribution/action_distribution.hpp"
#include "solvers/ppo/loss.hpp"
#include "solvers/ppo/model.hpp"
#include "solvers/ppo/segments.hpp"

#include <cstdint>
#include <vector>

namespace rddlc::solvers {

// Sample t * environments + e is step t of environment e; rows as in Samples.
struct Experience {
    int environments = 0, rollout = 0;
    Segments segments;
    std::vector<float> inputs;    // of the networks: normalised features, and what is remembered
    std::vector<float> memories;  // what was remembered when each segment began, padded
    std::vector<float> numbers, shifts, spreads, log_probabilities;
    std::vector<std::int32_t> indices;
    std::vector<std::uint8_t> masks;
    std::vector<float> rewards;    // as they are; scaled by the trainer
    std::vector<float> so_far;     // discounted sums of the episode's rewards up to each step
    std::vector<float> novelties;  // of what each step has seen (curiosity.hpp)
    std::vector<float> values, next_values, advantages, returns;
    std::vector<std::uint8_t> ends;

    Experience() = default;
    Experience(const PpoModel& model, int its_environments, int its_rollout, int longest_segment)
        : environments(its_environments),
          rollout(its_rollout),
          segments(its_environments, its_rollout, longest_segment) {
        const std::size_t samples = count();
        const auto rows = [&](int size) {
            return samples * static_cast<std::size_t>(size);
        };
        inputs.resize(rows(model.input_row()));
        memories.resize(segments.count() * static_cast<std::size_t>(model.memory.padded_units));
        numbers.resize(rows(model.actions.real_count()));
        shifts.resize(numbers.size());
        indices.resize(rows(model.actions.index_count()));
        masks.resize(rows(model.actions.mask_size()));
        spreads.assign(samples, 1.0f);
        for (auto* each : {&log_probabilities, &rewards, &so_far, &novelties, &values, &next_values,
                           &advantages, &returns})
            each->resize(samples);
        ends.resize(samples);
    }

    std::size_t count() const {
        return static_cast<std::size_t>(environments) * static_cast<std::size_t>(rollout);
    }
};

}  // namespace rddlc::solvers
