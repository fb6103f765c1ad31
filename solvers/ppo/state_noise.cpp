#include "solvers/ppo/state_noise.hpp"

#include <span>

namespace rddlc::solvers {

StateNoise::StateNoise(const PpoModel& model, std::int64_t environments) {
    if (model.noise != Noise::Sde || model.actions.real_count() == 0) return;
    model_ = &model;
    const auto count = static_cast<std::size_t>(environments);
    const auto weights = static_cast<std::size_t>(model.deviation_count());
    variances_.resize(weights);
    normals_.resize(count * weights);
    steps_left_.resize(count);
    log_deviations_.resize(count * static_cast<std::size_t>(model.actions.real_count()));
    noise_.resize(log_deviations_.size());
}

void StateNoise::begin_episode(std::int64_t environment) {
    if (is_used()) steps_left_[static_cast<std::size_t>(environment)] = 0;
}

void StateNoise::look_at_policy() {
    weight_variances(model_->noisy_units(), model_->actions.real_count(), model_->log_deviations(),
                     variances_.data());
}

void StateNoise::make(std::int64_t environment, const float* hidden, const ChoiceKey& key) {
    const int units = model_->noisy_units(), reals = model_->actions.real_count();
    const auto e = static_cast<std::size_t>(environment);
    float* const normals = normals_.data() + e * variances_.size();
    if (steps_left_[e] == 0) {
        standard_normals(key, {normals, variances_.size()});
        steps_left_[e] = model_->noise_steps;
    }
    steps_left_[e] -= 1;
    const std::size_t row = e * static_cast<std::size_t>(reals);
    state_log_deviations(units, reals, variances_.data(), hidden, log_deviations_.data() + row);
    for (int r = 0; r < reals; ++r) {
        float sum = 0;
        for (int u = 0; u < units; ++u) {
            const int k = u * reals + r;
            sum += hidden[u] * std::sqrt(variances_[static_cast<std::size_t>(k)]) * normals[k];
        }
        noise_[row + static_cast<std::size_t>(r)] = sum;
    }
}

Deviations StateNoise::deviations() const {
    return {log_deviations_.data(), model_->actions.real_count(), noise_.data()};
}

}  // namespace rddlc::solvers
