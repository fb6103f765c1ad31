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
    value = std::clamp(value, -1e9, 1e9);  // noise may be anything, ints may not
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
    if (space.picks > 0) {
        for (int p = 0; p < space.picks && indices[p] > 0; ++p) {
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

ActionRecords::ActionRecords(const rddl_simulator& simulator)
    : record_size_(static_cast<std::size_t>(simulator.problem->action_size)) {
    const auto* const action = static_cast<const std::byte*>(simulator.problem->default_action);
    blank_.assign(action, action + record_size_);
    for (const rddl_column& column : action_columns(simulator)) {
        const rddl_fluent& fluent = *rddl_fluent_at(simulator.problem, column.fluent);
        const std::int64_t size = fluent.scalar == RDDL_BOOL ? 1 : 8;
        entries_.push_back(
            {static_cast<std::size_t>(fluent.offset + column.grounding * size), fluent.scalar});
    }
}

void ActionRecords::write(const float* values, std::byte* record) const {
    std::copy(blank_.begin(), blank_.end(), record);
    for (std::size_t c = 0; c < entries_.size(); ++c) {
        const Entry& entry = entries_[c];
        if (entry.scalar == RDDL_BOOL) {
            record[entry.offset] = static_cast<std::byte>(values[c] > 0.5f);
        } else if (entry.scalar == RDDL_INT) {
            const auto value = static_cast<std::int64_t>(std::nearbyint(values[c]));
            std::memcpy(record + entry.offset, &value, sizeof value);
        } else {
            const auto value = static_cast<double>(values[c]);
            std::memcpy(record + entry.offset, &value, sizeof value);
        }
    }
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
