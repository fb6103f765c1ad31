#include "solvers/drp/return_gradient.hpp"

#include "support/failure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rddlc::solvers {

namespace {

constexpr int lanes = static_cast<int>(derivative_lanes);

BatchHandle batch_of(const rddl_simulator& simulator) {
    rddl_batch_options options{};
    options.environment_count = lanes;
    options.thread_count = 1;
    return create_batch(simulator, options);
}

std::vector<float> rows_of(int numbers) {
    return std::vector<float>(derivative_lanes * static_cast<std::size_t>(numbers));
}

}  // namespace

ReturnGradient::ReturnGradient(const rddl_simulator& simulator, const PpoModel& model,
                               StepDerivatives& derivatives, std::int64_t horizon, bool sees_ends)
    : simulator_(simulator),
      model_(model),
      derivatives_(derivatives),
      horizon_(static_cast<std::size_t>(horizon)),
      state_count_(derivatives.state_count()),
      sees_ends_(sees_ends),
      network_(make_network(model.features(), model.hidden, model.actions.output_count(),
                            model.features(), model.activation)),
      actions_(simulator, model.actions),
      starts_(batch_of(simulator)),
      start_states_(derivative_lanes * static_cast<std::size_t>(simulator.problem->state_size)),
      start_numbers_(state_count_),
      states_((horizon_ + 1) * state_count_),
      reward_weight_(horizon_),
      action_(derivatives.action_count()),
      adjoint_(state_count_),
      next_adjoint_(state_count_),
      action_adjoint_(action_.size()),
      values_(rows_of(model.observations.column_count())),
      features_(rows_of(model.features())),
      inputs_(rows_of(model.features())),
      activations_(rows_of(static_cast<int>(network_.activations))),
      scratch_(activations_.size()),
      d_outputs_(rows_of(network_.padded_outputs())),
      d_inputs_(rows_of(padded(model.features()))),
      rows_(network_.rows) {
    if (action_.size() != static_cast<std::size_t>(model.actions.column_count) ||
        state_count_ != static_cast<std::size_t>(model.observations.column_count()))
        own_mistake("derivatives and policies number the values of a problem differently");
}

double ReturnGradient::bytes(const PpoModel& model, const StepDerivatives& derivatives,
                             std::int64_t horizon) {
    const double numbers =
        static_cast<double>(derivatives.state_count() + 1) * static_cast<double>(horizon + 1);
    const double rows = 4.0 * static_cast<double>(model.policy.activations + model.features());
    return sizeof(LaneNumbers) * numbers + sizeof(float) * lanes * rows +
           sizeof(float) * 2.0 * static_cast<double>(model.policy.parameters);
}

void ReturnGradient::begin(std::span<const std::uint64_t, derivative_lanes> seeds) {
    require_done(simulator_, simulator_.set_seeds(starts_.get(), 0, lanes, seeds.data()));
    require_done(simulator_, simulator_.reset(starts_.get(), nullptr, nullptr));
    require_done(simulator_, simulator_.get_state(starts_.get(), 0, lanes, start_states_.data()));
    const auto size = static_cast<std::size_t>(simulator_.problem->state_size);
    for (std::size_t k = 0; k < derivative_lanes; ++k) {
        derivatives_.read_state(start_states_.data() + k * size, start_numbers_);
        for (std::size_t i = 0; i < state_count_; ++i) states_[i][k] = start_numbers_[i];
    }
    derivatives_.set_seeds(seeds);
    network_functions().transpose(network_, model_.parameters.data(), rows_.data());
}

// The policy's action in the states of a step.
void ReturnGradient::act(std::size_t step) {
    const auto state = state_of(step);
    const int width = model_.features();
    for (int k = 0; k < lanes; ++k) {
        float* const values = values_.data() + static_cast<std::size_t>(k) * state_count_;
        for (std::size_t i = 0; i < state_count_; ++i)
            values[i] = static_cast<float>(state[i][static_cast<std::size_t>(k)]);
        write_features(model_.observations, values, static_cast<std::int64_t>(step), true,
                       features_.data() + k * width);
        model_.normaliser.write(features_.data() + k * width, inputs_.data() + k * width);
    }
    network_functions().forward(network_, model_.parameters.data(), lanes, inputs_.data(), width,
                                activations_.data());
    const float* const outputs =
        activations_.data() + network_.layers.back().values * derivative_lanes;
    for (int k = 0; k < lanes; ++k)
        actions_.write(outputs + k * network_.padded_outputs(), static_cast<std::size_t>(k),
                       action_);
}

std::size_t ReturnGradient::play(std::span<Moments> seen, const Stops& stops) {
    reward_weight_.assign(horizon_, LaneNumbers{});
    returns_ = {};
    steps_ = 0;
    LaneNumbers alive{};
    alive.fill(1);
    double discount = 1;
    const auto width = static_cast<std::size_t>(model_.features());
    for (std::size_t t = 0; t < horizon_; ++t, discount *= simulator_.problem->discount) {
        if (is_stopped(&stops)) return t;
        act(t);
        derivatives_.step(static_cast<std::int64_t>(t), state_of(t), action_);
        derivatives_.read_next(state_of(t + 1));
        const LaneNumbers reward = derivatives_.reward();
        bool any = false;
        for (std::size_t k = 0; k < derivative_lanes; ++k) {
            for (std::size_t f = 0; f < width && alive[k] != 0; ++f)
                seen[f].add(static_cast<double>(features_[k * width + f]) -
                            static_cast<double>(model_.normaliser.means[f]));
            if (alive[k] != 0 && (derivatives_.has_failed(k) || !std::isfinite(reward[k]))) {
                alive[k] = 0;
                returns_[k] = std::numeric_limits<double>::quiet_NaN();
            }
            reward_weight_[t][k] = alive[k] * discount;
            if (alive[k] != 0) returns_[k] += discount * reward[k];
            steps_ += alive[k] != 0;
            if (sees_ends_ && derivatives_.is_over(k)) alive[k] = 0;
            any = any || alive[k] != 0;
        }
        if (!any) return t + 1;
    }
    return horizon_;
}

// Steps are computed again, so that memory holds their states alone.
void ReturnGradient::pull_back(std::size_t steps, std::span<float> gradient, const Stops& stops) {
    std::ranges::fill(next_adjoint_, LaneNumbers{});
    for (std::size_t t = steps; t-- > 0;) {
        if (is_stopped(&stops)) return;
        act(t);
        derivatives_.step(static_cast<std::int64_t>(t), state_of(t), action_);
        derivatives_.pull_back(next_adjoint_, reward_weight_[t], adjoint_, action_adjoint_);
        // An episode that was over before has no part in this.
        for (std::size_t k = 0; k < derivative_lanes; ++k) {
            if (reward_weight_[t][k] != 0) continue;
            for (LaneNumbers& adjoint : adjoint_) adjoint[k] = 0;
            for (LaneNumbers& adjoint : action_adjoint_) adjoint[k] = 0;
        }
        pull_back_policy(gradient);
        next_adjoint_.swap(adjoint_);
    }
}

// From the adjoints of the action to those of the parameters and of the state.
void ReturnGradient::pull_back_policy(std::span<float> gradient) {
    const float* const outputs =
        activations_.data() + network_.layers.back().values * derivative_lanes;
    const int row = network_.padded_outputs(), width = model_.features();
    for (int k = 0; k < lanes; ++k)
        actions_.pull_back(outputs + k * row, action_adjoint_, static_cast<std::size_t>(k),
                           d_outputs_.data() + k * row);
    // One number that is no number would spoil all weights.
    for (float& d : d_outputs_)
        if (!std::isfinite(d)) d = 0;
    std::ranges::fill(d_inputs_, 0.0f);
    network_functions().backward(network_, rows_.data(), lanes, inputs_.data(), width,
                                 activations_.data(), d_outputs_.data(), scratch_.data(),
                                 gradient.data(), d_inputs_.data());
    for (std::size_t c = 0; c < state_count_; ++c) {
        const ObservationSpace::Column& column = model_.observations.columns[c];
        if (column.object_count > 0) continue;
        const auto f = static_cast<std::size_t>(column.first_feature);
        for (int k = 0; k < lanes; ++k) {
            const auto input = inputs_[static_cast<std::size_t>(k * width) + f];
            if (std::abs(input) >= Normaliser::most) continue;
            const double d =
                static_cast<double>(d_inputs_[static_cast<std::size_t>(k * padded(width)) + f] *
                                    model_.normaliser.factors[f]);
            if (std::isfinite(d)) adjoint_[c][static_cast<std::size_t>(k)] += d;
        }
    }
}

void ReturnGradient::add(std::span<const std::uint64_t, derivative_lanes> seeds,
                         std::span<float> gradient, std::span<Moments> seen, const Stops& stops) {
    begin(seeds);
    pull_back(play(seen, stops), gradient, stops);
}

}  // namespace rddlc::solvers
