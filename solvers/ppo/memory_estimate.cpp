#include "solvers/ppo/memory_estimate.hpp"

#include "solvers/action_distribution/memory_estimate.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/ppo/collector.hpp"
#include "solvers/ppo/learner.hpp"
#include "support/failure.hpp"
#include "support/memory.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc::solvers {

namespace {

double bytes_of(double numbers) {
    return 4 * numbers;
}

// The policy as text, of the best, the last and the one that is made, about 13 bytes a number each;
// the checkpoint with the moments of Adam and a policy, twice. Measured: 74.
constexpr double bytes_of_files = 80;  // for each parameter

double networks(const PpoModel& model, const PpoOptions& options) {
    const auto parameters = static_cast<double>(parameter_count(model));
    const auto gradients = static_cast<double>(gradient_count(options));
    const double copies = 1 + 2 + 1 + gradients;  // moments, and the policy that is evaluated
    const auto rows = static_cast<double>(model.policy.rows + model.value.rows + model.memory.rows);
    const auto policy = static_cast<double>(model.policy.activations);
    const auto value = static_cast<double>(model.value.activations);
    const ActionSpace& actions = model.actions;
    const double sample = bytes_of(policy + value + std::max(policy, value) +
                                   model.policy.padded_outputs() + model.value.padded_outputs() +
                                   4 * actions.real_count() + actions.index_count() + 5) +
                          actions.mask_size();
    const double acting = bytes_of(std::max(policy, value) + model.memory.values());
    double inputs = tile * bytes_of(model.input_row());
    if (model.recurrent > 0) {
        const auto samples = static_cast<double>(samples_per_chunk(options));
        inputs = samples * (bytes_of(model.input_row() + model.memory.values() +
                                     2.0 * model.memory.padded_units + 1) +
                            1) +
                 2 * samples / longest_segment(options) * bytes_of(model.memory.padded_units);
    }
    return bytes_of(parameters * copies + rows) +
           options.threads * (tile * (sample + acting) + inputs);
}

double bytes_of_step(const PpoModel& model, const PpoOptions& options) {
    const ActionSpace& actions = model.actions;
    const double segment = bytes_of(model.memory.padded_units + 1);  // with its place in the order
    constexpr int numbers = 8;                                       // rewards, values and the like
    return bytes_of(model.input_row() + numbers) + bytes_of_choice(actions) + 1 +
           sizeof(FinishedEpisode) + segment / longest_segment(options);
}

double bytes_of_environment(const rddl_simulator& simulator, const PpoModel& model) {
    const ActionSpace& actions = model.actions;
    const double features = model.features(), columns = model.observations.column_count();
    // Observations as they are, the minimum and the maximum, and moments.
    double bytes = features * (3 * bytes_of(1) + sizeof(Moments)) + bytes_of(2 * columns);
    bytes +=
        bytes_of(actions.column_count + model.policy.padded_outputs() + model.memory.padded_units);
    if (model.noisy_units() > 0)
        bytes += bytes_of(model.deviation_count() + 2.0 * actions.real_count() + 1);
    bytes += 7 * sizeof(double) + 3.0 + bytes_of_distribution(simulator, actions);
    return bytes + static_cast<double>(bytes_per_environment(simulator));
}

std::string advice(const PpoMemory& memory) {
    if (memory.steps >= std::max(memory.networks + memory.files, memory.environments))
        return "try a smaller --rollout, --envs or --stack, or a larger --memory-limit";
    if (memory.environments >= memory.networks + memory.files)
        return "try a smaller --envs, or a larger --memory-limit";
    return "try smaller --hidden, --recurrent or --minibatch, fewer --threads, or a larger "
           "--memory-limit";
}

}  // namespace

PpoMemory memory_of(const rddl_simulator& simulator, const PpoModel& model,
                    const PpoOptions& options) {
    PpoMemory memory;
    const double environments = options.environments;
    memory.networks = networks(model, options);
    memory.files = bytes_of_files * static_cast<double>(parameter_count(model));
    memory.steps = environments * options.rollout * bytes_of_step(model, options);
    memory.environments = environments * bytes_of_environment(simulator, model);
    return memory;
}

void require_memory(const rddl_simulator& simulator, const PpoModel& model,
                    const PpoOptions& options) {
    const PpoMemory memory = memory_of(simulator, model, options);
    const auto limit = static_cast<double>(options.memory_limit);
    if (memory.all() <= limit) return;
    throw Failure(
        fmt::format("PPO would take about {}, more than the limit of {}: {} for the {} steps "
                    "between two updates, {} for {} environments, {} for networks of {} weights "
                    "and their files",
                    memory_text(memory.all()), memory_text(limit), memory_text(memory.steps),
                    std::int64_t{options.environments} * options.rollout,
                    memory_text(memory.environments), options.environments,
                    memory_text(memory.networks + memory.files), parameter_count(model)),
        advice(memory));
}

int fitting_rollout(const rddl_simulator& simulator, const PpoModel& model,
                    const PpoOptions& options) {
    PpoOptions fitting = options;
    const auto fits = [&] {
        return memory_of(simulator, model, fitting).all() <=
               static_cast<double>(options.memory_limit);
    };
    // An update of more, samples times weights, takes the better part of a minute.
    constexpr double most_work = 0x1p34;
    const auto is_quick = [&] {
        return static_cast<double>(parameter_count(model)) * fitting.environments *
                   fitting.rollout <=
               most_work;
    };
    const auto may_be_halved = [&] {
        return fitting.rollout >= 4 &&
               std::int64_t{fitting.environments} * (fitting.rollout / 2) >= fitting.minibatch;
    };
    while (!(fits() && is_quick()) && may_be_halved()) fitting.rollout /= 2;
    return fits() ? fitting.rollout : options.rollout;
}

}  // namespace rddlc::solvers
