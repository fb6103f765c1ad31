#include "solvers/cgp/scope.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/cgp/skdecide.hpp"
#include "solvers/policies/random_actions.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace rddlc::solvers {

namespace {

constexpr int most_inputs = 96;

// Numbers that people read: three digits.
double rounded(double x) {
    if (x == 0 || !std::isfinite(x)) return 0;
    const double unit = std::pow(10, std::floor(std::log10(std::abs(x))) - 2);
    return std::nearbyint(x / unit) * unit;
}

// A value of an observed fluent or a non-fluent with parameters.
struct Source {
    const rddl_fluent* fluent;
    std::string name;
    int first_feature = -1;         // of an observed fluent's first grounding; -1: constants
    std::vector<double> constants;  // of a non-fluent
    double lower = 0, upper = 0;    // all groundings'
};

ProgramScope::Term term_of(const Source& source, std::int64_t grounding) {
    const auto at = static_cast<std::size_t>(grounding);
    if (source.first_feature < 0) return {-1, source.constants[at]};
    return {source.first_feature + static_cast<int>(grounding), 1};
}

void widen(Source& source, double lower, double upper, bool first) {
    source.lower = first ? lower : std::min(source.lower, lower);
    source.upper = first ? upper : std::max(source.upper, upper);
}

// Observed fluents but those of objects, then non-fluents that are not the same everywhere.
std::vector<Source> sources_of(const rddl_simulator& simulator, const ObservationSpace& space) {
    const rddl_problem& problem = *simulator.problem;
    std::vector<Source> sources;
    const std::int64_t columns = simulator.observation_value_count(&simulator);
    for (std::int64_t c = 0; c < columns; ++c) {
        rddl_column column{};
        simulator.observation_column(&simulator, c, &column);
        if (column.object_count > 0) continue;
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, column.fluent);
        if (column.grounding == 0) {
            sources.push_back({&fluent,
                               fluent.name,
                               space.columns[static_cast<std::size_t>(c)].first_feature,
                               {}});
        }
        widen(sources.back(), column.lower, column.upper, column.grounding == 0);
    }
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, f);
        if (fluent.role != RDDL_NON_FLUENT || fluent.rank == 0 || fluent.range_type >= 0) continue;
        Source source{&fluent, fluent.name, -1, {}};
        const auto count = static_cast<std::size_t>(fluent.count);
        source.constants.resize(count);
        if (fluent.scalar == RDDL_BOOL) {
            std::vector<std::uint8_t> bools(count);
            simulator.get_constants(&simulator, f, 0, fluent.count, bools.data());
            std::copy(bools.begin(), bools.end(), source.constants.begin());
        } else if (fluent.scalar == RDDL_INT) {
            std::vector<std::int64_t> ints(count);
            simulator.get_constants(&simulator, f, 0, fluent.count, ints.data());
            std::copy(ints.begin(), ints.end(), source.constants.begin());
        } else {
            simulator.get_constants(&simulator, f, 0, fluent.count, source.constants.data());
        }
        const auto [least, most] =
            std::minmax_element(source.constants.begin(), source.constants.end());
        source.lower = *least;
        source.upper = *most;
        if (source.lower < source.upper) sources.push_back(std::move(source));
    }
    return sources;
}

std::vector<std::int64_t> objects_of(const rddl_problem& problem, const rddl_fluent& fluent,
                                     std::int64_t grounding) {
    std::vector<std::int64_t> objects(static_cast<std::size_t>(fluent.rank));
    for (std::int32_t p = fluent.rank; p-- > 0;) {
        const std::int64_t size = rddl_type_at(&problem, fluent.parameter_types[p])->object_count;
        objects[static_cast<std::size_t>(p)] = grounding % size;
        grounding /= size;
    }
    return objects;
}

// How the parameters of a source are bound by those of an action: the k-th of a type by the k-th of
// that type; -1: not.
std::vector<int> binding_of(const rddl_fluent& source, const rddl_fluent& action) {
    std::vector<int> binding(static_cast<std::size_t>(source.rank), -1);
    std::vector<bool> taken(static_cast<std::size_t>(action.rank));
    for (std::int32_t p = 0; p < source.rank; ++p)
        for (std::int32_t q = 0; q < action.rank; ++q)
            if (!taken[static_cast<std::size_t>(q)] &&
                source.parameter_types[p] == action.parameter_types[q]) {
                binding[static_cast<std::size_t>(p)] = q;
                taken[static_cast<std::size_t>(q)] = true;
                break;
            }
    return binding;
}

class Lifter {
  public:
    Lifter(const rddl_simulator& simulator, ProgramScope& scope)
        : problem_(*simulator.problem),
          scope_(scope),
          sources_(sources_of(simulator, scope.observations)) {}

    void lift(const rddl_simulator& simulator) {
        name_inputs();
        std::map<std::int32_t, int> outputs;  // of action-fluents
        for (int c = 0; c < scope_.actions.column_count; ++c) {
            rddl_column column{};
            simulator.action_column(&simulator, c, &column);
            const rddl_fluent& action = *rddl_fluent_at(&problem_, column.fluent);
            if (!outputs.contains(column.fluent)) {
                outputs[column.fluent] = scope_.output_count();
                scope_.outputs.push_back(text_of(action));
            }
            scope_.units.push_back({outputs[column.fluent], c, scope_.terms.size()});
            add_terms(action, objects_of(problem_, action, column.grounding));
        }
    }

  private:
    std::string text_of(const rddl_fluent& fluent) const {
        std::string parameters;
        for (std::int32_t p = 0; p < fluent.rank; ++p)
            parameters += (p > 0 ? ", ?" : "?") +
                          std::string(rddl_type_at(&problem_, fluent.parameter_types[p])->name);
        return parameters.empty() ? fluent.name : std::string(fluent.name) + "(" + parameters + ")";
    }

    // A relation between two objects, and what is counted over those that it relates.
    struct Neighbours {
        const Source *relation, *source;
        bool forward;  // relation(own, other), else relation(other, own)
    };

    void name_inputs() {
        const auto add = [&](std::string name, const Source& source) {
            ProgramInput input;
            input.name = std::move(name);
            scale_by_bounds(input, source.lower, source.upper);
            scope_.inputs.push_back(std::move(input));
        };
        for (const Source& source : sources_) add(text_of(*source.fluent), source);
        for (const Source& source : sources_)
            if (source.first_feature >= 0 && source.fluent->rank > 0)
                add("mean(" + source.name + ")", source);
        for (const Source& relation : sources_) {
            const rddl_fluent& r = *relation.fluent;
            if (relation.first_feature >= 0 || r.scalar != RDDL_BOOL || r.rank != 2) continue;
            for (const Source& source : sources_)
                for (const bool forward : {true, false}) {
                    const rddl_fluent& f = *source.fluent;
                    if (source.first_feature < 0 || f.rank != 1 ||
                        f.parameter_types[0] != r.parameter_types[forward ? 1 : 0] ||
                        static_cast<int>(scope_.inputs.size()) >= most_inputs)
                        continue;
                    neighbours_.push_back({&relation, &source, forward});
                    ProgramInput input;
                    input.name = std::string("sum[") + source.name + ": " + relation.name +
                                 (forward ? "(?, other)]" : "(other, ?)]");
                    scope_.inputs.push_back(std::move(input));
                }
        }
    }

  public:
    static void scale_by_bounds(ProgramInput& input, double lower, double upper) {
        if (!std::isfinite(lower) || !std::isfinite(upper) || !(lower < upper)) return;
        input.is_known = true;
        if (lower == 0 && upper == 1) return;  // bools, shares: as they are
        input.shift = (lower + upper) / 2;
        input.scale = 2 / (upper - lower);
    }

  private:
    void end_input() { scope_.ends.push_back(static_cast<std::uint32_t>(scope_.terms.size())); }

    void add_terms(const rddl_fluent& action, const std::vector<std::int64_t>& objects) {
        for (const Source& source : sources_) {
            add_mean(source, binding_of(*source.fluent, action), objects);
            end_input();
        }
        for (const Source& source : sources_)
            if (source.first_feature >= 0 && source.fluent->rank > 0) {
                add_mean(source,
                         std::vector<int>(static_cast<std::size_t>(source.fluent->rank), -1),
                         objects);
                end_input();
            }
        for (const Neighbours& n : neighbours_) {
            add_neighbours(n, action, objects);
            end_input();
        }
    }

    // Over all groundings that agree with what is bound.
    void add_mean(const Source& source, const std::vector<int>& binding,
                  const std::vector<std::int64_t>& objects) {
        std::vector<std::int64_t> groundings;
        for (std::int64_t g = 0; g < source.fluent->count; ++g) {
            const std::vector<std::int64_t> its = objects_of(problem_, *source.fluent, g);
            bool agrees = true;
            for (std::size_t p = 0; p < its.size(); ++p)
                agrees &= binding[p] < 0 || its[p] == objects[static_cast<std::size_t>(binding[p])];
            if (agrees) groundings.push_back(g);
        }
        for (const std::int64_t g : groundings) {
            ProgramScope::Term term = term_of(source, g);
            term.factor /= static_cast<double>(groundings.size());
            scope_.terms.push_back(term);
        }
    }

    void add_neighbours(const Neighbours& n, const rddl_fluent& action,
                        const std::vector<std::int64_t>& objects) {
        const rddl_fluent& relation = *n.relation->fluent;
        const std::int32_t own_type = relation.parameter_types[n.forward ? 0 : 1];
        for (std::int32_t q = 0; q < action.rank; ++q) {
            if (action.parameter_types[q] != own_type) continue;
            const std::int64_t own = objects[static_cast<std::size_t>(q)];
            const std::int64_t rows =
                rddl_type_at(&problem_, relation.parameter_types[0])->object_count;
            const std::int64_t columns =
                rddl_type_at(&problem_, relation.parameter_types[1])->object_count;
            for (std::int64_t other = 0; other < (n.forward ? columns : rows); ++other) {
                const std::int64_t at = n.forward ? own * columns + other : other * columns + own;
                if (n.relation->constants[static_cast<std::size_t>(at)] != 0)
                    scope_.terms.push_back(term_of(*n.source, other));
            }
            return;
        }
    }

    const rddl_problem& problem_;
    ProgramScope& scope_;
    std::vector<Source> sources_;
    std::vector<Neighbours> neighbours_;
};

void make_ground(const rddl_simulator& simulator, ProgramScope& scope) {
    const ObservationSpace& space = scope.observations;
    for (const ObservationSpace::Column& column : space.columns) {
        const int features = std::max(column.object_count, 1);
        for (int k = 0; k < features; ++k) {
            ProgramInput input;
            input.name = space.features[static_cast<std::size_t>(column.first_feature + k)];
            if (column.object_count > 0)
                input.is_known = true;
            else
                Lifter::scale_by_bounds(input, column.lower, column.upper);
            scope.inputs.push_back(std::move(input));
        }
    }
    if (space.time) scope.inputs.push_back({"time", 0, 1, true});
    scope.outputs = scope.actions.names;
    scope.units.push_back({});
    scope.plain = true;
    static_cast<void>(simulator);
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

// Mean and deviation of inputs without bounds, as random actions show them.
void learn_scales(const rddl_simulator& simulator, ProgramScope& scope, std::uint64_t seed) {
    constexpr std::int64_t environments = 16;
    std::vector<int> all;
    for (int i = 0; i < scope.input_count(); ++i)
        if (!scope.inputs[static_cast<std::size_t>(i)].is_known) all.push_back(i);
    if (all.empty()) return;
    rddl_batch_options options{};
    options.environment_count = environments;
    options.thread_count = 1;
    options.seed = seed;
    options.autoreset = RDDL_AUTORESET_SAME_STEP;
    const Batch batch = create_batch(simulator, options);
    RandomPolicy policy(*simulator.problem, seed);
    RandomActions random(simulator, policy, environments);
    std::vector<std::byte> actions(
        static_cast<std::size_t>(environments * simulator.problem->action_size));
    const auto columns = static_cast<std::size_t>(scope.observations.column_count());
    std::vector<float> values(environments * columns);
    std::vector<float> features(static_cast<std::size_t>(scope.observations.feature_count()));
    const std::size_t units = scope.units.size();
    std::vector<double> inputs(units * scope.inputs.size());
    std::vector<double> sums(scope.inputs.size()), squares(sums.size());
    double count = 0;
    const std::int64_t steps = simulator.problem->horizon > 0
                                   ? std::min<std::int64_t>(simulator.problem->horizon, 100)
                                   : 100;
    for (std::int64_t t = 0; t < steps; ++t) {
        require_done(simulator,
                     simulator.get_observation_values(batch.get(), RDDL_FLOAT, values.data()));
        for (std::int64_t e = 0; e < environments; ++e) {
            write_features(scope.observations,
                           values.data() + static_cast<std::size_t>(e) * columns, t, true,
                           features.data());
            for (ProgramInput& input : scope.inputs)
                if (!input.is_known) input.shift = 0, input.scale = 1;
            read_inputs(scope, features.data(), all, inputs.data(), 1);
            for (const int i : all)
                for (std::size_t u = 0; u < units; ++u) {
                    const double x = inputs[static_cast<std::size_t>(i) * units + u];
                    sums[static_cast<std::size_t>(i)] += x;
                    squares[static_cast<std::size_t>(i)] += x * x;
                }
            count += static_cast<double>(units);
        }
        random.draw(
            batch.get(), actions.data(), [](std::size_t) { return true; },
            [](std::size_t i) { return static_cast<std::int64_t>(i); },
            [&](std::size_t) { return t; });
        rddl_transition unread{};
        require_done(simulator, simulator.step(batch.get(), actions.data(), &unread));
    }
    for (const int i : all) {
        const auto at = static_cast<std::size_t>(i);
        const double mean = sums[at] / count;
        const double deviation = std::sqrt(std::max(squares[at] / count - mean * mean, 0.0));
        // What hardly moves about a mean that is near 0 stays as it is.
        scope.inputs[at].shift = std::abs(mean) < 0.3 * deviation ? 0 : rounded(mean);
        const bool is_spread = deviation > 1e-9 && std::isfinite(deviation);
        scope.inputs[at].scale = is_spread ? rounded(1 / deviation) : 1;
    }
}

// The middle of the category's bins, from -1 to 1.
int bin_of(double value, int count) {
    const double place = (std::clamp(value, -1.0, 1.0) + 1) / 2 * count;
    return std::clamp(static_cast<int>(place), 0, count - 1);
}

}  // namespace

ProgramScope program_scope(const rddl_simulator& simulator, Lifting lifting, bool time,
                           std::uint64_t seed) {
    ProgramScope scope;
    ObservationOptions options;
    options.time = time ? ObservationOptions::Time::On : ObservationOptions::Time::Off;
    scope.observations = observation_space(simulator, options);
    scope.actions = action_space(simulator);
    scope.lifted = is_lifted(simulator, lifting);
    scope.lifted ? Lifter(simulator, scope).lift(simulator) : make_ground(simulator, scope);
    learn_scales(simulator, scope, seed);
    return scope;
}

void read_inputs(const ProgramScope& scope, const float* features, const std::vector<int>& used,
                 double* inputs, std::ptrdiff_t stride) {
    if (scope.skdecide) return read_skdecide_inputs(scope, features, used, inputs, stride);
    if (scope.plain) {
        for (const int i : used) {
            const ProgramInput& input = scope.inputs[static_cast<std::size_t>(i)];
            inputs[i * stride] = (static_cast<double>(features[i]) - input.shift) * input.scale;
        }
        return;
    }
    const std::size_t units = scope.units.size();
    for (std::size_t u = 0; u < units; ++u)
        for (const int i : used) {
            const std::size_t row = u * scope.inputs.size() + static_cast<std::size_t>(i);
            double sum = 0;
            for (std::size_t t = row == 0 ? 0 : scope.ends[row - 1]; t < scope.ends[row]; ++t) {
                const ProgramScope::Term& term = scope.terms[t];
                sum += term.feature < 0 ? term.factor
                                        : term.factor * static_cast<double>(features[term.feature]);
            }
            const ProgramInput& input = scope.inputs[static_cast<std::size_t>(i)];
            inputs[(static_cast<std::ptrdiff_t>(i) * static_cast<std::ptrdiff_t>(units) +
                    static_cast<std::ptrdiff_t>(u)) *
                   stride] = (sum - input.shift) * input.scale;
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
        const double value = value_of(head.column);
        const int chosen = head.count == 2 ? value > 0 : bin_of(value, head.count);
        for (int l = 0; l < head.count; ++l)
            logits[head.first_logit + l] = l == chosen ? 1.0f : 0.0f;
    }
    // Picks: what has the greatest number above 0 comes first; a value of several has the size of
    // the number, and which of them it is tells the number.
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
