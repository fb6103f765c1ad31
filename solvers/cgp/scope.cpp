#include "solvers/cgp/scope.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/cgp/lifting.hpp"
#include "solvers/cgp/skdecide.hpp"
#include "solvers/policies/random_actions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rddlc::solvers {

namespace {

// Rounds numbers for display: three digits.
double rounded(double x) {
    if (x == 0 || !std::isfinite(x)) return 0;
    const double unit = std::pow(10, std::floor(std::log10(std::abs(x))) - 2);
    return std::nearbyint(x / unit) * unit;
}

void make_ground(ProgramScope& scope) {
    const ObservationSpace& space = scope.observations;
    for (const ObservationSpace::Column& column : space.columns) {
        const int features = std::max(column.object_count, 1);
        for (int k = 0; k < features; ++k) {
            ProgramInput input;
            input.name = space.features[static_cast<std::size_t>(column.first_feature + k)];
            if (column.object_count > 0)
                input.is_known = true;
            else
                scale_by_bounds(input, column.lower, column.upper);
            scope.inputs.push_back(std::move(input));
        }
    }
    if (space.time) scope.inputs.push_back({"time", 0, 1, true});
    scope.outputs = scope.actions.names;
    scope.units.push_back({});
    scope.plain = true;
}

bool is_lifted(const rddl_simulator& simulator, Lifting lifting) {
    if (lifting != Lifting::Auto) return lifting == Lifting::On;
    const rddl_problem& problem = *simulator.problem;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, f);
        if (fluent.role == RDDL_ACTION && fluent.count > 1) return true;
    }
    return false;
}

// How often each sum is read, by any unit.
std::vector<double> reads_of_sums(const ProgramScope& scope) {
    std::vector<double> reads(static_cast<std::size_t>(scope.sum_count()));
    for (const std::int32_t sum : scope.sum_of_unit) reads[static_cast<std::size_t>(sum)] += 1;
    return reads;
}

double value_of_sum(const ProgramScope& scope, std::size_t sum, const float* features) {
    double value = 0;
    for (std::size_t t = sum == 0 ? 0 : scope.sum_ends[sum - 1]; t < scope.sum_ends[sum]; ++t) {
        const ProgramScope::Term& term = scope.terms[t];
        value += term.feature < 0 ? term.factor
                                  : term.factor * static_cast<double>(features[term.feature]);
    }
    return value;
}

// The sums that input i may be.
std::pair<std::size_t, std::size_t> sums_of(const ProgramScope& scope, std::size_t i) {
    return {i == 0 ? 0 : static_cast<std::size_t>(scope.input_ends[i - 1]),
            static_cast<std::size_t>(scope.input_ends[i])};
}

// Statistics of the observed inputs.
struct Seen {
    double count = 0, sum = 0, squares = 0;

    void add(double x, double times) {
        count += times;
        sum += times * x;
        squares += times * x * x;
    }
};

void see(const ProgramScope& scope, const float* features, const std::vector<double>& reads,
         std::vector<Seen>& seen) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (scope.inputs[i].is_known) continue;
        if (scope.plain) {
            seen[i].add(static_cast<double>(features[i]), 1);
            continue;
        }
        const auto [begin, end] = sums_of(scope, i);
        for (std::size_t sum = begin; sum < end; ++sum)
            if (reads[sum] > 0) seen[i].add(value_of_sum(scope, sum, features), reads[sum]);
    }
}

// Steps that random actions make: fewer where there are very many of them to draw.
std::int64_t steps_to_watch(const rddl_problem& problem, std::int64_t values) {
    constexpr std::int64_t usual = 100, fewest = 4, most_values = 1 << 22;
    const std::int64_t longest = problem.horizon > 0 ? std::min(problem.horizon, usual) : usual;
    return std::min(longest, std::max(fewest, most_values / values));
}

// Mean and deviation of inputs without bounds, as random actions show them.
void learn_scales(const rddl_simulator& simulator, ProgramScope& scope, std::uint64_t seed,
                  const Stops& stops) {
    constexpr std::int64_t environments = 16;
    const auto is_known = [](const ProgramInput& input) {
        return input.is_known;
    };
    if (std::ranges::all_of(scope.inputs, is_known)) return;
    rddl_batch_options options{};
    options.environment_count = environments;
    options.thread_count = 1;
    options.seed = seed;
    options.autoreset = RDDL_AUTORESET_SAME_STEP;
    const BatchHandle batch = create_batch(simulator, options);
    RandomPolicy policy(*simulator.problem, seed);
    RandomActions random(simulator, policy, environments);
    random.set_stops(&stops);
    std::vector<std::byte> actions(
        static_cast<std::size_t>(environments * simulator.problem->action_size));
    const auto columns = static_cast<std::size_t>(scope.observations.column_count());
    std::vector<float> values(environments * columns);
    std::vector<float> features(static_cast<std::size_t>(scope.observations.feature_count()));
    const std::vector<double> reads = reads_of_sums(scope);
    std::vector<Seen> seen(scope.inputs.size());
    const std::int64_t steps =
        steps_to_watch(*simulator.problem, environments * scope.actions.column_count);
    for (std::int64_t t = 0; t < steps && !is_stopped(&stops); ++t) {
        require_done(simulator,
                     simulator.get_observation_values(batch.get(), RDDL_FLOAT, values.data()));
        for (std::int64_t e = 0; e < environments; ++e) {
            write_features(scope.observations,
                           values.data() + static_cast<std::size_t>(e) * columns, t, true,
                           features.data());
            see(scope, features.data(), reads, seen);
        }
        random.draw(
            batch.get(), actions.data(), [](std::size_t) { return true; },
            [](std::size_t i) { return static_cast<std::int64_t>(i); },
            [&](std::size_t) { return t; });
        rddl_transition unread{};
        require_done(simulator, simulator.step(batch.get(), actions.data(), &unread));
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
        ProgramInput& input = scope.inputs[i];
        if (input.is_known) continue;
        const double mean = seen[i].sum / seen[i].count;
        const double deviation =
            std::sqrt(std::max(seen[i].squares / seen[i].count - mean * mean, 0.0));
        // An input that hardly moves around a mean near 0 is not shifted.
        input.shift = std::abs(mean) < 0.3 * deviation ? 0 : rounded(mean);
        const bool is_spread = deviation > 1e-9 && std::isfinite(deviation);
        input.scale = is_spread ? rounded(1 / deviation) : 1;
    }
}

// The middle of the category's bins, from -1 to 1.
int bin_of(double value, int count) {
    const double place = (std::clamp(value, -1.0, 1.0) + 1) / 2 * count;
    return std::clamp(static_cast<int>(place), 0, count - 1);
}

}  // namespace

ProgramScope program_scope(const rddl_simulator& simulator, Lifting lifting, bool time,
                           std::uint64_t seed, const Stops& stops) {
    ProgramScope scope;
    ObservationOptions options;
    options.time = time ? ObservationOptions::Time::On : ObservationOptions::Time::Off;
    scope.observations = observation_space(simulator, options);
    scope.actions = action_space(simulator, stops);
    scope.lifted = is_lifted(simulator, lifting);
    scope.lifted ? lift(simulator, scope) : make_ground(scope);
    learn_scales(simulator, scope, seed, stops);
    return scope;
}

void read_inputs(const ProgramScope& scope, const float* features, const std::vector<int>& used,
                 double* sums, double* inputs, std::ptrdiff_t stride) {
    if (scope.skdecide) return read_skdecide_inputs(scope, features, used, inputs, stride);
    if (scope.plain) {
        for (const int i : used) {
            const ProgramInput& input = scope.inputs[static_cast<std::size_t>(i)];
            inputs[i * stride] = (static_cast<double>(features[i]) - input.shift) * input.scale;
        }
        return;
    }
    const std::size_t units = scope.units.size();
    for (const int i : used) {
        const auto at = static_cast<std::size_t>(i);
        const ProgramInput& input = scope.inputs[at];
        const auto [begin, end] = sums_of(scope, at);
        for (std::size_t sum = begin; sum < end; ++sum)
            sums[sum] = (value_of_sum(scope, sum, features) - input.shift) * input.scale;
        double* to = inputs + i * static_cast<std::ptrdiff_t>(units) * stride;
        for (std::size_t u = 0; u < units; ++u, to += stride)
            *to = sums[scope.sum_of_unit[at * units + u]];
    }
}

void write_outputs(const ProgramScope& scope, const double* values, std::ptrdiff_t stride,
                   float* row) {
    if (scope.skdecide) return write_skdecide_outputs(scope, values, stride, row);
    const ActionSpace& space = scope.actions;
    const auto units = static_cast<std::ptrdiff_t>(scope.units.size());
    const auto value_of = [&](int column) {
        if (!scope.lifted) return values[column * stride];
        const ProgramScope::Unit& unit = scope.units[static_cast<std::size_t>(column)];
        return values[(unit.output * units + column) * stride];
    };
    for (std::size_t r = 0; r < space.reals.size(); ++r)
        row[r] = static_cast<float>(value_of(space.reals[r].column));
    float* const logits = row + space.reals.size();
    for (const CategoryHead& head : space.categories) {
        if (!head.group.empty()) {  // the greatest number above 0 says which
            for (int l = 0; l < head.count; ++l) {
                const std::int64_t which = head.first_value + l;
                logits[head.first_logit + l] =
                    which == 0 ? 0
                               : static_cast<float>(
                                     value_of(head.group[static_cast<std::size_t>(which - 1)]));
            }
            continue;
        }
        const double value = value_of(head.column);
        const int chosen = head.count == 2 ? value > 0 : bin_of(value, head.count);
        for (int l = 0; l < head.count; ++l)
            logits[head.first_logit + l] = l == chosen ? 1.0f : 0.0f;
    }
    // Sub-actions: the greatest number above 0 comes first. A choice with several values is
    // preferred by the number's size; its value follows from the number.
    for (std::size_t c = 0; c < space.choices.size(); ++c) {
        const Choice& choice = space.choices[c];
        if (choice.column < 0) {
            logits[c] = 0;
            continue;
        }
        const double value = value_of(choice.column);
        if (choice.real >= 0)
            logits[c] = static_cast<float>(std::abs(value));
        else
            logits[c] = static_cast<float>(value);
    }
    for (std::size_t c = 1; c < space.choices.size();) {
        const int column = space.choices[c].column;
        std::size_t end = c;
        while (end < space.choices.size() && space.choices[end].column == column) ++end;
        if (end - c > 1) {
            const double value = value_of(column);
            const int chosen = bin_of(value, static_cast<int>(end - c));
            for (std::size_t k = c; k < end; ++k)
                logits[k] =
                    static_cast<int>(k - c) == chosen ? static_cast<float>(std::abs(value)) : -1.0f;
        }
        c = end;
    }
}

}  // namespace rddlc::solvers
