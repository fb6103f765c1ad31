#include "solvers/drp/trainer.hpp"

#include "solvers/drp/return_gradient.hpp"
#include "solvers/files/checkpoint.hpp"
#include "solvers/network/adam.hpp"
#include "solvers/spaces/refusals.hpp"
#include "support/failure.hpp"

#include <rddl/random/random.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace rddlc::solvers {

namespace {

const CheckpointKind checkpoint{"DRP", "rddl drp checkpoint", 1};

// An update makes gradients until it has so many steps.
constexpr std::int64_t steps_of_update = 20'000;
constexpr std::int64_t most_gradients_of_update = 20;
// Features that differ less, by deviations of their mean, count as if they differed so much: what
// hardly moves at first would have an enormous derivative.
constexpr double least_deviation = 0.01;

std::int64_t horizon_of(const rddl_simulator& simulator, const DrpOptions& options) {
    const std::int64_t horizon = options.horizon.value_or(simulator.problem->horizon);
    require_choices(simulator);
    require_a_gradient_to_learn(simulator, horizon);
    return horizon;
}

PpoModel model_of(const rddl_simulator& simulator, const DrpOptions& options) {
    PpoOptions network;
    network.squashes = true;  // no bound without a slope
    network.noise = Noise::White;
    network.correlation = 0;
    network.log_deviation = -1;  // of actions that are sampled by --stochastic
    network.hidden = options.hidden;
    network.activation = options.activation;
    network.seed = options.seed;
    network.stops = options.stops;
    PpoModel model = make_model(observation_space(simulator, options.observations),
                                action_space(simulator, options.stops), network);
    model.solver = "drp";
    return model;
}

std::uint64_t seed_of(std::uint64_t seed, std::int64_t gradient, std::int64_t episode) {
    const rddl::StreamKey key = rddl::stream_key(seed, static_cast<std::uint64_t>(episode),
                                                 static_cast<std::uint64_t>(gradient));
    return static_cast<std::uint64_t>(key.high) << 32 | key.low;
}

// Throws a Failure where gradients take more memory than they may.
std::unique_ptr<StepDerivatives> derivatives_of(const DerivativesSource& source,
                                                const DrpOptions& options, const PpoModel& model,
                                                std::int64_t horizon) {
    auto derivatives = source({.mode = options.relaxation, .sharpness = options.sharpness});
    const double bytes = static_cast<double>(derivatives->bytes()) +
                         ReturnGradient::bytes(model, *derivatives, horizon);
    if (bytes <= static_cast<double>(options.memory_limit)) return derivatives;
    throw Failure(
        fmt::format("gradients of {} steps would take about {}, more than the limit of {}", horizon,
                    memory_text(bytes), memory_text(static_cast<double>(options.memory_limit))),
        "try a smaller --horizon, or a larger --memory-limit");
}

}  // namespace

struct DrpTrainer::State {
    State(const rddl_simulator& its_simulator, const DrpOptions& its_options,
          const DerivativesSource& source)
        : simulator(its_simulator),
          options(its_options),
          horizon(horizon_of(simulator, options)),
          model(model_of(simulator, options)),
          derivatives(derivatives_of(source, options, model, horizon)),
          gradient_of_return(simulator, model, *derivatives, horizon, !is_soft()),
          gradient(model.policy.parameters),
          first_moments(gradient.size()),
          second_moments(gradient.size()),
          features(static_cast<std::size_t>(model.features())),
          seen(features.size()) {
        groups = (options.episodes + lanes - 1) / lanes;
    }

    bool is_soft() const {
        return options.relaxation == Relaxation::Mode::Soft && derivatives->can_be_relaxed();
    }

    // The gradient of the mean return, and the features that were seen. Returns false where `ends`
    // says so; then neither means anything, and progress is as it was.
    bool find_gradient(const Stops& ends) {
        std::ranges::fill(gradient, 0.0f);
        std::ranges::fill(seen, Moments{});
        double sum = 0, count = 0;
        std::int64_t steps = 0;
        for (int group = 0; group < groups; ++group) {
            std::array<std::uint64_t, derivative_lanes> seeds{};
            for (int k = 0; k < lanes; ++k)
                seeds[static_cast<std::size_t>(k)] =
                    seed_of(options.seed, progress.gradients, group * lanes + k);
            gradient_of_return.add(seeds, gradient, seen, ends);
            if (ends()) return false;
            steps += gradient_of_return.steps();
            for (const double each : gradient_of_return.returns()) {
                if (!std::isfinite(each)) continue;
                sum += each;
                count += 1;
            }
        }
        if (count == 0)
            throw Failure(fmt::format("no episode of gradient {} has a finite return",
                                      progress.gradients + 1),
                          "'rddl run --policy random --trace' shows what leads there");
        progress.steps += steps;
        under_way.steps += steps;
        under_way.returns.add(sum / count);
        return true;
    }

    bool has_scales() const { return features.empty() || features.front().count > 0; }

    void learn_scales() {
        for (std::size_t f = 0; f < features.size(); ++f) {
            features[f].mean = static_cast<double>(model.normaliser.means[f]);
            features[f].add(seen[f]);
            const double least = least_deviation * std::max(1.0, std::abs(features[f].mean));
            model.normaliser.means[f] = static_cast<float>(features[f].mean);
            model.normaliser.factors[f] =
                static_cast<float>(1 / std::max(least, features[f].deviation()));
        }
    }

    // Adam (Kingma and Ba, 2015) up the gradient.
    void climb() {
        const double length =
            std::sqrt(network_functions().squares(gradient.size(), gradient.data()));
        progress.gradients += 1;
        under_way.gradients += 1;
        progress.gradient_length = length;
        if (!std::isfinite(length) || length == 0) return;
        if (progress.mean_length == 0) progress.mean_length = length;
        const double most = options.clip * progress.mean_length;
        progress.mean_length += 0.05 * (std::min(length, most) - progress.mean_length);
        // The step has length 1 in the mean, so that Adam's epsilon does not depend on the size of
        // rewards.
        const double factor = -std::min(1.0, most / length) / progress.mean_length;
        adam_steps += 1;
        take(AdamStep{adam_steps, options.learning_rate, factor, 1e-8f}, gradient, first_moments,
             second_moments, model.parameters);
    }

    bool is_complete() const {
        return under_way.gradients == most_gradients_of_update ||
               (under_way.gradients > 0 && under_way.steps >= steps_of_update);
    }

    void update(const Stops& is_late) {
        const Stops ends = [&] {
            return is_stopped(&options.stops) || is_stopped(&is_late);
        };
        const auto begin = std::chrono::steady_clock::now();
        if (!has_scales() && find_gradient(ends)) learn_scales();  // and nothing else
        while (has_scales() && !is_complete() && find_gradient(ends)) {
            climb();
            learn_scales();
        }
        const Moments& returns = under_way.returns;
        if (returns.count > 0) progress.mean_return = returns.sum / returns.count;
        if (is_complete()) under_way = {};
        progress.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }

    template <class Archive>
    void archive(Archive& archive) {
        archive(progress);
        archive(under_way);
        const std::size_t size = model.parameters.size();
        archive(model.parameters);
        if (model.parameters.size() != size)
            throw Failure("it is of a run with other networks: --hidden has to be as it was");
        archive.fixed(model.normaliser.means);
        archive.fixed(model.normaliser.factors);
        archive.fixed(first_moments);
        archive.fixed(second_moments);
        archive(adam_steps);
        archive.fixed(features);
    }

    static constexpr int lanes = static_cast<int>(derivative_lanes);
    const rddl_simulator& simulator;
    const Fingerprint problem = fingerprint(simulator);
    DrpOptions options;
    std::int64_t horizon;
    PpoModel model;
    std::unique_ptr<StepDerivatives> derivatives;
    ReturnGradient gradient_of_return;
    int groups = 1;  // of lanes, for a gradient
    std::vector<float> gradient, first_moments, second_moments;
    std::int64_t adam_steps = 0;
    std::vector<RunningStatistics> features;
    std::vector<Moments> seen;
    // The part of an update that is made. A clock that stops a run divides an update; the next call
    // goes on with it, so that updates end after the same gradients as without the stop.
    struct {
        std::int64_t steps = 0, gradients = 0;
        Moments returns;  // of its gradients
    } under_way;
    DrpProgress progress;
};

DrpTrainer::DrpTrainer(const rddl_simulator& simulator, const DrpOptions& options,
                       const DerivativesSource& derivatives) {
    if (!derivatives)
        throw Failure(
            "'rddl train drp' needs the RDDL text of the problem, from which derivatives "
            "are made");
    state_ = std::make_unique<State>(simulator, options, derivatives);
}
DrpTrainer::~DrpTrainer() = default;

void DrpTrainer::update(const Stops& is_late) {
    state_->update(is_late);
}
bool DrpTrainer::done() const {
    return state_->progress.steps >= state_->options.steps && state_->under_way.steps == 0;
}
const PpoModel& DrpTrainer::model() const {
    return state_->model;
}
const DrpOptions& DrpTrainer::options() const {
    return state_->options;
}
const DrpProgress& DrpTrainer::progress() const {
    return state_->progress;
}

std::string DrpTrainer::save() const {
    SavingArchive archive;
    begin_checkpoint(archive, checkpoint, state_->problem);
    state_->archive(archive);
    return archive.bytes();
}

void DrpTrainer::load(std::string_view bytes) {
    LoadingArchive archive(bytes);
    begin_checkpoint(archive, checkpoint, state_->problem);
    state_->archive(archive);
}

}  // namespace rddlc::solvers
