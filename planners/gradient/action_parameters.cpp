#include "planners/gradient/action_parameters.hpp"

#include "support/sigmoid.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::planners {

namespace {

constexpr double bool_slope = 4;   // of the sigmoid
constexpr double most_bool = 1.5;  // a probability of 0.0025
constexpr double first_bool = 0.5;
// A real beside its only bound is softplus(u) away from it, which hardly has a slope further down.
constexpr double least_beside_bound = -6, first_beside_bound = -2;

bool is_bounded(const solvers::RealHead& head) {
    return head.range == solvers::RealHead::Range::Bounded ||
           head.range == solvers::RealHead::Range::Squashed;
}

bool has_one_bound(const solvers::RealHead& head) {
    return head.range == solvers::RealHead::Range::AboveLower ||
           head.range == solvers::RealHead::Range::BelowUpper;
}

}  // namespace

ActionParameters::ActionParameters(const rddl_simulator& simulator,
                                   const solvers::ActionSpace& space)
    : default_values_(space.defaults), most_changes_(simulator.problem->max_nondef_actions) {
    const std::vector<rddl_column> columns = solvers::action_columns(simulator);
    kinds_.resize(columns.size(), Kind::Fixed);
    heads_.resize(columns.size());
    defaults_.resize(columns.size());
    std::vector<float> numbers(space.reals.size());
    std::vector<std::int32_t> indices(static_cast<std::size_t>(space.index_count()));
    solvers::read_action(space, space.defaults.data(), numbers.data(), indices.data());
    for (std::size_t r = 0; r < space.reals.size(); ++r) {
        const auto column = static_cast<std::size_t>(space.reals[r].column);
        kinds_[column] = space.reals[r].rounds ? Kind::Int : Kind::Real;
        heads_[column] = space.reals[r];
        heads_[column].rounds = false;
        defaults_[column] = static_cast<double>(numbers[r]);
        if (has_one_bound(heads_[column]))
            defaults_[column] = std::max(defaults_[column], first_beside_bound);
    }
    is_in_group_.resize(columns.size(), false);
    for (const solvers::CategoryHead& head : space.categories) {
        if (head.group.empty()) continue;
        groups_.push_back({{head.group.begin(), head.group.end()}, head.first_value == 0});
        for (const std::size_t i : groups_.back().members) is_in_group_[i] = true;
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const rddl_column& column = columns[i];
        if (kinds_[i] != Kind::Fixed || column.object_count > 0) continue;
        if (column.scalar == RDDL_BOOL) {
            kinds_[i] = Kind::Bool;
            defaults_[i] = is_true_by_default(i) ? first_bool : -first_bool;
        } else if (column.upper > column.lower && std::isfinite(column.upper - column.lower)) {
            kinds_[i] = Kind::Int;
            heads_[i].range = solvers::RealHead::Range::Bounded;
            heads_[i].lower = column.lower;
            heads_[i].upper = column.upper;
            const double middle = (column.lower + column.upper) / 2;
            defaults_[i] = (static_cast<double>(default_values_[i]) - middle) /
                           ((column.upper - column.lower) / 2);
        }
    }
    project(defaults_);
}

bool ActionParameters::any_moves() const {
    return std::ranges::any_of(kinds_, [](Kind kind) { return kind != Kind::Fixed; });
}

double ActionParameters::value(std::size_t i, double parameter) const {
    switch (kinds_[i]) {
        case Kind::Bool:
            return sigmoid(bool_slope * parameter);
        case Kind::Real:
        case Kind::Int:
            return solvers::real_value(heads_[i], parameter);
        case Kind::Fixed:
            break;
    }
    return static_cast<double>(default_values_[i]);
}

double ActionParameters::slope(std::size_t i, double parameter) const {
    if (kinds_[i] == Kind::Fixed) return 0;
    if (kinds_[i] == Kind::Bool) {
        const double p = value(i, parameter);
        return bool_slope * p * (1 - p);
    }
    if (is_bounded(heads_[i])) return (heads_[i].upper - heads_[i].lower) / 2;
    constexpr double width = 1e-3;  // they are linear, or softplus
    return (value(i, parameter + width) - value(i, parameter - width)) / (2 * width);
}

void ActionParameters::values(std::span<const double> parameters, std::span<double> values) const {
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (!is_in_group_[i]) values[i] = value(i, parameters[i]);
    for (const Group& group : groups_) {
        write_chances(group, parameters, values);
        for (const std::size_t i : group.members)
            if (is_true_by_default(i)) values[i] = 1 - values[i];
    }
}

void ActionParameters::pull_back(std::span<const double> parameters,
                                 std::span<const double> adjoint,
                                 std::span<double> gradient) const {
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (!is_in_group_[i]) gradient[i] += adjoint[i] * slope(i, parameters[i]);
    std::vector<double> chances(groups_.empty() ? 0 : parameters.size());
    for (const Group& group : groups_) {
        write_chances(group, parameters, chances);
        const auto sign = [this](std::size_t i) {
            return is_true_by_default(i) ? -1.0 : 1.0;
        };
        double mean = 0;
        for (const std::size_t i : group.members) mean += chances[i] * sign(i) * adjoint[i];
        // The adjoint of the logit, which has the sign of the change as well.
        for (const std::size_t i : group.members)
            gradient[i] += sign(i) * bool_slope * chances[i] * (sign(i) * adjoint[i] - mean);
    }
}

void ActionParameters::share_scales(std::span<double> squares) const {
    for (const Group& group : groups_) {
        double greatest = 0;
        for (const std::size_t i : group.members) greatest = std::max(greatest, squares[i]);
        for (const std::size_t i : group.members) squares[i] = greatest;
    }
}

// The softmax of a group: the chance of each change.
void ActionParameters::write_chances(const Group& group, std::span<const double> parameters,
                                     std::span<double> chances) const {
    // Logits are bounded by the projection, so that their exponentials are finite.
    double sum = group.may_be_none ? 1 : 0;
    for (const std::size_t i : group.members) {
        chances[i] = std::exp(change_logit(i, parameters[i]));
        sum += chances[i];
    }
    for (const std::size_t i : group.members) chances[i] /= sum;
}

double ActionParameters::change_logit(std::size_t i, double parameter) const {
    return is_true_by_default(i) ? -bool_slope * parameter : bool_slope * parameter;
}

void ActionParameters::project(std::span<double> parameters) const {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        if (kinds_[i] == Kind::Bool)
            parameters[i] = std::clamp(parameters[i], -most_bool, most_bool);
        else if (kinds_[i] != Kind::Fixed && is_bounded(heads_[i]))
            parameters[i] = std::clamp(parameters[i], -1.0, 1.0);
        else if (kinds_[i] != Kind::Fixed && has_one_bound(heads_[i]))
            parameters[i] = std::max(parameters[i], least_beside_bound);
    }
    limit_changes(parameters);
}

// The choice is between this change and none, also where a group has others.
double ActionParameters::chance_to_differ(std::size_t i, double parameter) const {
    return sigmoid(change_logit(i, parameter));
}

void ActionParameters::limit_changes(std::span<double> parameters) const {
    if (most_changes_ < 0) return;
    constexpr double least = 0.0025;  // of most_bool
    const auto limit = std::max(static_cast<double>(most_changes_), least);
    for (int round = 0; round < 20; ++round) {
        double sum = 0, movable = 0;
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            if (kinds_[i] != Kind::Bool || is_in_group_[i]) continue;
            const double chance = chance_to_differ(i, parameters[i]);
            sum += chance;
            movable += chance > least;
        }
        if (sum <= limit + 1e-6 || movable == 0) return;
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            if (kinds_[i] != Kind::Bool || is_in_group_[i]) continue;
            const double chance = chance_to_differ(i, parameters[i]);
            if (chance <= least) continue;
            const double less = std::max(chance - (sum - limit) / movable, least);
            const double parameter = std::log(less / (1 - less)) / bool_slope;
            parameters[i] = is_true_by_default(i) ? -parameter : parameter;
        }
    }
}

// From 0 to 1: the chance of a bool, for numbers how far they are from their default.
double ActionParameters::size_of_change(std::size_t i, double parameter) const {
    if (kinds_[i] == Kind::Bool) return chance_to_differ(i, parameter);
    const solvers::RealHead& head = heads_[i];
    const double distance = std::abs(value(i, parameter) - static_cast<double>(default_values_[i]));
    return is_bounded(head) ? distance / (head.upper - head.lower)
                            : distance / (head.scale + distance);
}

float ActionParameters::written(std::size_t i, double parameter, double threshold) const {
    switch (kinds_[i]) {
        case Kind::Bool:
            if (chance_to_differ(i, parameter) > threshold)
                return is_true_by_default(i) ? 0.0f : 1.0f;
            break;
        case Kind::Real:
            return static_cast<float>(value(i, parameter));
        case Kind::Int:
            return static_cast<float>(std::nearbyint(value(i, parameter)));
        case Kind::Fixed:
            break;
    }
    return default_values_[i];
}

// All others get their defaults. So does the likeliest one where it is unlikely and need not
// change.
void ActionParameters::keep_likeliest(const Group& group, std::span<const double> parameters,
                                      float* values) const {
    const std::size_t likeliest = *std::ranges::max_element(
        group.members, {}, [&](std::size_t i) { return change_logit(i, parameters[i]); });
    const bool changes = !group.may_be_none || values[likeliest] != default_values_[likeliest];
    for (const std::size_t i : group.members) values[i] = default_values_[i];
    if (changes) values[likeliest] = 1 - default_values_[likeliest];
}

void ActionParameters::write(std::span<const double> parameters, double threshold,
                             float* values) const {
    for (std::size_t i = 0; i < parameters.size(); ++i)
        values[i] = written(i, parameters[i], threshold);
    for (const Group& group : groups_) keep_likeliest(group, parameters, values);
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (values[i] != default_values_[i]) changed.push_back(i);
    if (most_changes_ < 0 || std::ssize(changed) <= most_changes_) return;
    std::ranges::stable_sort(changed, [&](std::size_t a, std::size_t b) {
        return size_of_change(a, parameters[a]) > size_of_change(b, parameters[b]);
    });
    for (const std::size_t i : std::span(changed).subspan(static_cast<std::size_t>(most_changes_)))
        values[i] = default_values_[i];
}

}  // namespace rddlc::planners
