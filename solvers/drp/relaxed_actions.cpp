#include "solvers/drp/relaxed_actions.hpp"

#include "support/sigmoid.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::solvers {

namespace {

// The derivative of real_value.
double real_slope(const RealHead& head, double number) {
    switch (head.range) {
        case RealHead::Range::Squashed: {
            const double t = std::tanh(number);
            return (1 - t * t) * (head.upper - head.lower) / 2;
        }
        case RealHead::Range::Bounded:
            return std::abs(number) < 1 ? (head.upper - head.lower) / 2 : 0;
        case RealHead::Range::AboveLower:
            return head.scale * sigmoid(number);
        case RealHead::Range::BelowUpper:
            return -head.scale * sigmoid(number);
        case RealHead::Range::Free:
            break;
    }
    return head.scale;
}

}  // namespace

RelaxedActions::RelaxedActions(const rddl_simulator& simulator, const ActionSpace& space)
    : space_(space),
      reals_(space.reals),
      probabilities_(static_cast<std::size_t>(space.logit_count)),
      d_probabilities_(probabilities_.size()) {
    for (RealHead& head : reals_) head.rounds = false;
    for (const rddl_column& column : action_columns(simulator))
        is_object_.push_back(column.object_count > 0);
}

void RelaxedActions::find_probabilities(const float* logits, int first, int count) {
    const float most = *std::max_element(logits + first, logits + first + count);
    double sum = 0;
    for (int l = first; l < first + count; ++l) {
        double& p = probabilities_[static_cast<std::size_t>(l)];
        p = std::exp(static_cast<double>(logits[l] - most));
        sum += p;
    }
    for (int l = first; l < first + count; ++l) probabilities_[static_cast<std::size_t>(l)] /= sum;
}

void RelaxedActions::write(const float* outputs, std::size_t lane, std::span<LaneNumbers> action) {
    for (std::size_t c = 0; c < action.size(); ++c)
        action[c][lane] = default_of(static_cast<int>(c));
    if (space_.max_sub_actions > 0) return write_sub_actions(outputs, lane, action);
    for (std::size_t r = 0; r < reals_.size(); ++r)
        action[static_cast<std::size_t>(reals_[r].column)][lane] =
            real_value(reals_[r], static_cast<double>(outputs[r]));
    const float* const logits = outputs + reals_.size();
    for (const CategoryHead& head : space_.categories) {
        find_probabilities(logits, head.first_logit, head.count);
        const double* const p = probabilities_.data() + head.first_logit;
        double& value = action[static_cast<std::size_t>(head.column)][lane];
        if (!head.group.empty()) {
            for (int k = 0; k < head.count; ++k)
                if (const auto changed = head.first_value + k; changed > 0)
                    change(head.group[static_cast<std::size_t>(changed - 1)], p[k], lane, action);
        } else if (is_object_[static_cast<std::size_t>(head.column)]) {
            value =
                static_cast<double>(head.first_value + (std::max_element(p, p + head.count) - p));
        } else {
            value = 0;
            for (int k = 0; k < head.count; ++k)
                value += p[k] * static_cast<double>(head.first_value + k);
        }
    }
}

// A bool takes its other value with this probability.
void RelaxedActions::change(int column, double chance, std::size_t lane,
                            std::span<LaneNumbers> action) const {
    const double other = 1 - default_of(column);
    double& value = action[static_cast<std::size_t>(column)][lane];
    value += chance * (other - default_of(column));
}

double RelaxedActions::chance(double p) const {
    return 1 - std::pow(1 - p, space_.max_sub_actions);
}
double RelaxedActions::chance_slope(double p) const {
    return space_.max_sub_actions * std::pow(1 - p, space_.max_sub_actions - 1);
}

// The value of a choice's column, if the choice is made.
double RelaxedActions::chosen_value(const Choice& choice, const float* outputs) const {
    if (choice.real < 0) return static_cast<double>(choice.value);
    const auto r = static_cast<std::size_t>(choice.real);
    return real_value(reals_[r], static_cast<double>(outputs[r]));
}

void RelaxedActions::write_sub_actions(const float* outputs, std::size_t lane,
                                       std::span<LaneNumbers> action) {
    find_probabilities(outputs + reals_.size(), 0, space_.logit_count);
    for (std::size_t c = 0; c < space_.choices.size(); ++c) {
        const Choice& choice = space_.choices[c];
        if (choice.column < 0 || is_object_[static_cast<std::size_t>(choice.column)]) continue;
        action[static_cast<std::size_t>(choice.column)][lane] +=
            chance(probabilities_[c]) * (chosen_value(choice, outputs) - default_of(choice.column));
    }
}

void RelaxedActions::pull_back(const float* outputs, std::span<const LaneNumbers> d_action,
                               std::size_t lane, float* d_outputs) {
    std::fill_n(d_outputs, space_.output_count(), 0.0f);
    if (space_.max_sub_actions > 0)
        return pull_back_sub_actions(outputs, d_action, lane, d_outputs);
    const auto d_of = [&](int column) {
        return d_action[static_cast<std::size_t>(column)][lane];
    };
    for (std::size_t r = 0; r < reals_.size(); ++r)
        d_outputs[r] = static_cast<float>(d_of(reals_[r].column) *
                                          real_slope(reals_[r], static_cast<double>(outputs[r])));
    const float* const logits = outputs + reals_.size();
    for (const CategoryHead& head : space_.categories) {
        const bool is_group = !head.group.empty();
        if (!is_group && is_object_[static_cast<std::size_t>(head.column)]) continue;
        find_probabilities(logits, head.first_logit, head.count);
        for (int k = 0; k < head.count; ++k) {
            const auto value = head.first_value + k;
            double& d = d_probabilities_[static_cast<std::size_t>(head.first_logit + k)];
            d = 0;
            if (!is_group) {
                d = d_of(head.column) * static_cast<double>(value);
            } else if (value > 0) {
                const int column = head.group[static_cast<std::size_t>(value - 1)];
                d = d_of(column) * (1 - 2 * default_of(column));
            }
        }
        pull_back_probabilities(head.first_logit, head.count, d_outputs + reals_.size());
    }
}

void RelaxedActions::pull_back_sub_actions(const float* outputs,
                                           std::span<const LaneNumbers> d_action, std::size_t lane,
                                           float* d_outputs) {
    find_probabilities(outputs + reals_.size(), 0, space_.logit_count);
    for (std::size_t c = 0; c < space_.choices.size(); ++c) {
        const Choice& choice = space_.choices[c];
        d_probabilities_[c] = 0;
        if (choice.column < 0 || is_object_[static_cast<std::size_t>(choice.column)]) continue;
        const double d = d_action[static_cast<std::size_t>(choice.column)][lane];
        const double p = probabilities_[c];
        d_probabilities_[c] =
            d * chance_slope(p) * (chosen_value(choice, outputs) - default_of(choice.column));
        if (choice.real < 0) continue;
        const auto r = static_cast<std::size_t>(choice.real);
        d_outputs[r] = static_cast<float>(d * chance(p) *
                                          real_slope(reals_[r], static_cast<double>(outputs[r])));
    }
    pull_back_probabilities(0, space_.logit_count, d_outputs + reals_.size());
}

void RelaxedActions::pull_back_probabilities(int first, int count, float* d_logits) const {
    double mean = 0;
    for (auto l = static_cast<std::size_t>(first); l < static_cast<std::size_t>(first + count); ++l)
        mean += probabilities_[l] * d_probabilities_[l];
    for (auto l = static_cast<std::size_t>(first); l < static_cast<std::size_t>(first + count); ++l)
        d_logits[l] = static_cast<float>(probabilities_[l] * (d_probabilities_[l] - mean));
}

}  // namespace rddlc::solvers
