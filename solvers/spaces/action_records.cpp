#include "solvers/spaces/actions.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc::solvers {

namespace {

double softplus(double x) {
    return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x)));
}

// Asked for in each step of each environment.
inline double value_of_real(const RealHead& head, double number) {
    double value = 0;
    switch (head.range) {
        case RealHead::Range::Squashed:
            number = std::tanh(number);
            [[fallthrough]];
        case RealHead::Range::Bounded:
            value =
                head.lower + (std::clamp(number, -1.0, 1.0) + 1) * 0.5 * (head.upper - head.lower);
            break;
        case RealHead::Range::AboveLower:
            value = head.lower + head.scale * softplus(number);
            break;
        case RealHead::Range::BelowUpper:
            value = head.upper - head.scale * softplus(number);
            break;
        case RealHead::Range::Free:
            value = head.centre + head.scale * number;
            break;
    }
    value = std::clamp(value, head.least(), head.most());  // noise may be anything
    return std::clamp(head.rounds ? std::nearbyint(value) : value, head.lower, head.upper);
}

}  // namespace

double real_value(const RealHead& head, double number) {
    return value_of_real(head, number);
}

void write_action(const ActionSpace& space, const float* numbers, const std::int32_t* indices,
                  float* values) {
    std::copy(space.defaults.begin(), space.defaults.end(), values);
    const auto set_real = [&](std::size_t r) {
        constexpr double most = std::numeric_limits<float>::max();
        const double value = value_of_real(space.reals[r], static_cast<double>(numbers[r]));
        if (!std::isnan(value))  // otherwise the default: simulators refuse nan in actions
            values[space.reals[r].column] = static_cast<float>(std::clamp(value, -most, most));
    };
    if (space.max_sub_actions > 0) {
        for (int p = 0; p < space.max_sub_actions && indices[p] > 0; ++p) {
            const Choice& choice = space.choices[static_cast<std::size_t>(indices[p])];
            if (choice.real >= 0)
                set_real(static_cast<std::size_t>(choice.real));
            else
                values[choice.column] = static_cast<float>(choice.value);
        }
        return;
    }
    for (std::size_t r = 0; r < space.reals.size(); ++r) set_real(r);
    for (std::size_t h = 0; h < space.categories.size(); ++h) {
        const CategoryHead& head = space.categories[h];
        const std::int64_t value = head.first_value + indices[h];
        if (head.group.empty()) {
            values[head.column] = static_cast<float>(value);
        } else if (value > 0) {
            float& changed = values[head.group[static_cast<std::size_t>(value - 1)]];
            changed = 1 - changed;
        }
    }
}

namespace {

double number_of_real(const RealHead& head, double value) {
    const auto inverse_softplus = [](double x) {
        return x > 30 ? x : std::log(std::expm1(std::max(x, 1e-12)));
    };
    switch (head.range) {
        case RealHead::Range::Squashed:
        case RealHead::Range::Bounded: {
            const double width = head.upper - head.lower;
            const double middle = width > 0 ? 2 * (value - head.lower) / width - 1 : 0;
            return head.range == RealHead::Range::Bounded
                       ? middle
                       : std::atanh(std::clamp(middle, -0.999, 0.999));
        }
        case RealHead::Range::AboveLower:
            return inverse_softplus((value - head.lower) / head.scale);
        case RealHead::Range::BelowUpper:
            return inverse_softplus((head.upper - value) / head.scale);
        case RealHead::Range::Free:
            break;
    }
    return (value - head.centre) / head.scale;
}

std::int32_t index_of_category(const ActionSpace& space, const CategoryHead& head,
                               const float* values) {
    std::int64_t value = 0;
    if (head.group.empty()) {
        value = std::llround(values[head.column]);
    } else {
        for (std::size_t g = 0; g < head.group.size(); ++g) {
            const auto column = static_cast<std::size_t>(head.group[g]);
            if (values[column] != space.defaults[column]) value = static_cast<std::int64_t>(g) + 1;
        }
    }
    return static_cast<std::int32_t>(
        std::clamp<std::int64_t>(value - head.first_value, 0, head.count - 1));
}

}  // namespace

void read_action(const ActionSpace& space, const float* values, float* numbers,
                 std::int32_t* indices) {
    for (std::size_t r = 0; r < space.reals.size(); ++r)
        numbers[r] = static_cast<float>(
            number_of_real(space.reals[r], static_cast<double>(values[space.reals[r].column])));
    if (space.max_sub_actions == 0) {
        for (std::size_t h = 0; h < space.categories.size(); ++h)
            indices[h] = index_of_category(space, space.categories[h], values);
        return;
    }
    int count = 0;
    for (std::size_t c = 1; c < space.choices.size() && count < space.max_sub_actions; ++c) {
        const Choice& choice = space.choices[c];
        const float value = values[choice.column];
        if (value == space.defaults[static_cast<std::size_t>(choice.column)]) continue;
        if (choice.real < 0 && std::llround(value) != choice.value) continue;
        indices[count++] = static_cast<std::int32_t>(c);
    }
    std::fill(indices + count, indices + space.max_sub_actions, 0);
}

ActionRecords::ActionRecords(const rddl_simulator& simulator)
    : record_size_(static_cast<std::size_t>(simulator.problem->action_size)) {
    const auto* const action = static_cast<const std::byte*>(simulator.problem->default_action);
    blank_.assign(action, action + record_size_);
    for (const rddl_column& column : action_columns(simulator)) {
        const rddl_fluent& fluent = *rddl_fluent_at(simulator.problem, column.fluent);
        const std::int64_t size = fluent.scalar == RDDL_BOOL ? 1 : 8;
        entries_.push_back({static_cast<std::size_t>(fluent.offset + column.grounding * size),
                            fluent.scalar, column.lower, column.upper});
    }
    defaults_.resize(entries_.size());
    read(blank_.data(), defaults_.data());
}

void ActionRecords::write(const float* values, std::byte* record) const {
    std::copy(blank_.begin(), blank_.end(), record);
    for (std::size_t c = 0; c < entries_.size(); ++c) {
        if (values[c] == defaults_[c]) continue;
        const Entry& entry = entries_[c];
        const auto value = static_cast<double>(values[c]);
        entry.set(entry.scalar == RDDL_INT    ? std::nearbyint(value)
                  : entry.scalar == RDDL_REAL ? std::min(std::max(value, entry.lower), entry.upper)
                                              : value,
                  record);
    }
}

double ActionRecords::default_value(int column) const {
    const Entry& at = entry(column);
    if (at.scalar == RDDL_BOOL) return blank_[at.offset] != std::byte{0} ? 1 : 0;
    if (at.scalar == RDDL_INT) {
        std::int64_t value;
        std::memcpy(&value, blank_.data() + at.offset, sizeof value);
        return static_cast<double>(value);
    }
    double value;
    std::memcpy(&value, blank_.data() + at.offset, sizeof value);
    return value;
}

void ActionRecords::read(const std::byte* record, float* values) const {
    for (std::size_t c = 0; c < entries_.size(); ++c) {
        const Entry& entry = entries_[c];
        if (entry.scalar == RDDL_BOOL) {
            values[c] = record[entry.offset] != std::byte{0} ? 1.0f : 0.0f;
        } else if (entry.scalar == RDDL_INT) {
            std::int64_t value;
            std::memcpy(&value, record + entry.offset, sizeof value);
            values[c] = static_cast<float>(value);
        } else {
            double value;
            std::memcpy(&value, record + entry.offset, sizeof value);
            values[c] = static_cast<float>(value);
        }
    }
}

}  // namespace rddlc::solvers
