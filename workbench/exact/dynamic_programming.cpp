#include "exact/dynamic_programming.hpp"

#include "support/failure.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/parallel.hpp"
#include "terminal/progress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rddlc::workbench {

namespace {

constexpr std::uint32_t no_action = std::numeric_limits<std::uint32_t>::max();
// Two actions whose values differ by less than rounding may are equally good: then the action of
// one step less stays, or else that of the smaller number.
constexpr double rounding = 1e-12;
constexpr double precision = 1e-10;  // of values without a horizon, relative
constexpr std::int64_t most_sweeps = 10'000'000;

class Sweeps {
  public:
    Sweeps(const MarkovModel& model, double discount, int threads)
        : model_(model),
          discount_(discount),
          threads_(threads),
          values_(model.states.count()),
          next_values_(model.states.count()),
          actions_(model.states.count(), no_action) {}

    // One more step is left; of the first `count` states.
    void sweep(StateNumber count) {
        give_up_if_interrupted("solving");
        constexpr std::size_t together = 4096;
        const std::size_t parts = (count + together - 1) / together;
        changes_.assign(parts, 0);
        for_each_in_parallel(parts, threads_, [&](std::size_t part) {
            const std::size_t end = std::min<std::size_t>(count, (part + 1) * together);
            for (std::size_t s = part * together; s < end; ++s) {
                improve(static_cast<StateNumber>(s));
                changes_[part] = std::max(changes_[part], std::abs(next_values_[s] - values_[s]));
            }
        });
        std::swap(values_, next_values_);
    }

    double greatest_change() const {
        return changes_.empty() ? 0 : *std::max_element(changes_.begin(), changes_.end());
    }
    double greatest_value() const {
        double greatest = 0;
        for (const double value : values_) greatest = std::max(greatest, std::abs(value));
        return greatest;
    }
    double value_of_starts() const {
        double value = 0;
        for (const MarkovModel::Start& start : model_.starts)
            value += start.probability * values_[start.state];
        return value;
    }
    std::uint32_t action(StateNumber state) const { return actions_[state]; }

  private:
    double value_of(std::uint64_t choice) const {
        double future = 0;
        for (std::uint64_t t = model_.first_transition[choice];
             t < model_.first_transition[choice + 1]; ++t)
            future += model_.probability[t] * values_[model_.to[t]];
        return model_.reward[choice] + discount_ * future;
    }

    void improve(StateNumber state) {
        double best = -HUGE_VAL, kept = -HUGE_VAL;
        std::uint32_t action = no_action;
        for (std::uint64_t c = model_.first_choice[state]; c < model_.first_choice[state + 1];
             ++c) {
            const double value = value_of(c);
            if (model_.action[c] == actions_[state]) kept = value;
            if (action == no_action || value > best + rounding * (1 + std::abs(best))) {
                best = value;
                action = model_.action[c];
            }
        }
        if (kept >= best - rounding * (1 + std::abs(best))) action = actions_[state];
        next_values_[state] = std::max(best, kept);
        actions_[state] = action;
    }

    const MarkovModel& model_;
    double discount_;
    int threads_;
    std::vector<double> values_, next_values_, changes_;
    std::vector<std::uint32_t> actions_;
};

struct Change {
    StateNumber state;
    PolicyEntry entry;
};

void write_entries(Optimum& optimum, StateNumber states, std::vector<Change> changes) {
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.state < b.state; });
    optimum.first.assign(states + std::size_t{1}, 0);
    for (const Change& change : changes) {
        ++optimum.first[change.state + std::size_t{1}];
        optimum.entries.push_back(change.entry);
    }
    std::partial_sum(optimum.first.begin(), optimum.first.end(), optimum.first.begin());
}

Optimum within_horizon(const MarkovModel& model, std::int64_t horizon, double discount,
                       int threads) {
    Sweeps sweeps(model, discount, threads);
    Progress bar("solving", horizon);
    std::vector<Change> changes;
    std::vector<std::uint32_t> before(model.states.count(), no_action);
    for (std::int64_t left = 1; left <= horizon; ++left) {
        // Only what can be reached by then.
        const auto depth = static_cast<std::size_t>(horizon - left);
        const StateNumber count = model.within[std::min(depth, model.within.size() - 1)];
        sweeps.sweep(count);
        for (StateNumber s = 0; s < count; ++s) {
            if (sweeps.action(s) == before[s]) continue;
            before[s] = sweeps.action(s);
            changes.push_back({s, {static_cast<std::uint32_t>(left), before[s]}});
        }
        bar.advance();
    }
    Optimum optimum{horizon, sweeps.value_of_starts(), 0, horizon, {}, {}};
    write_entries(optimum, model.states.count(), std::move(changes));
    return optimum;
}

Optimum without_horizon(const MarkovModel& model, double discount, int threads) {
    if (!(discount < 1))
        throw Failure(
            "the problem has no horizon, and a discount of 1: a policy may have any "
            "return",
            "give a horizon with --horizon");
    Sweeps sweeps(model, discount, threads);
    Optimum optimum;
    do {
        sweeps.sweep(model.states.count());
        // The error of values after a sweep that changed them by at most so much (Puterman, 1994).
        optimum.error = discount / (1 - discount) * sweeps.greatest_change();
    } while (++optimum.sweeps < most_sweeps &&
             optimum.error > precision * std::max(1.0, sweeps.greatest_value()));
    optimum.value = sweeps.value_of_starts();
    std::vector<Change> changes;
    for (StateNumber s = 0; s < model.states.count(); ++s)
        changes.push_back({s, {0, sweeps.action(s)}});
    write_entries(optimum, model.states.count(), std::move(changes));
    return optimum;
}

}  // namespace

Optimum optimum_of(const MarkovModel& model, std::int64_t horizon, double discount, int threads) {
    if (horizon > std::numeric_limits<std::uint32_t>::max())
        throw Failure(fmt::format("a horizon of {} steps is too long to solve", horizon));
    return horizon > 0 ? within_horizon(model, horizon, discount, threads)
                       : without_horizon(model, discount, threads);
}

}  // namespace rddlc::workbench
