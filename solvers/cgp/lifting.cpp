#include "solvers/cgp/lifting.hpp"

#include "solvers/spaces/groundings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::solvers {

namespace {

constexpr int most_inputs = 96;

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

// Parameters of a source that an action's parameters determine, as (source's, action's).
using SharedParameters = std::vector<std::pair<std::int32_t, std::int32_t>>;

// The k-th of a type by the k-th of that type.
SharedParameters parameters_shared_by(const rddl_fluent& source, const rddl_fluent& action) {
    SharedParameters shared;
    std::vector<bool> taken(static_cast<std::size_t>(action.rank));
    for (std::int32_t p = 0; p < source.rank; ++p)
        for (std::int32_t q = 0; q < action.rank; ++q)
            if (!taken[static_cast<std::size_t>(q)] &&
                source.parameter_types[p] == action.parameter_types[q]) {
                shared.emplace_back(p, q);
                taken[static_cast<std::size_t>(q)] = true;
                break;
            }
    return shared;
}

class Lifter {
  public:
    Lifter(const rddl_simulator& simulator, ProgramScope& scope)
        : problem_(*simulator.problem),
          scope_(scope),
          sources_(sources_of(simulator, scope.observations)) {
        for (int c = 0; c < scope_.actions.column_count; ++c) {
            rddl_column& column = columns_.emplace_back();
            simulator.action_column(&simulator, c, &column);
        }
    }

    void lift() {
        add_units();
        for (const Source& source : sources_)
            add_input(text_of(*source.fluent), source, [&](const rddl_fluent& action) {
                return parameters_shared_by(*source.fluent, action);
            });
        for (const Source& source : sources_)
            if (source.first_feature >= 0 && source.fluent->rank > 0)
                add_input("mean(" + source.name + ")", source,
                          [](const rddl_fluent&) { return SharedParameters{}; });
        for (const Source& relation : sources_) {
            const rddl_fluent& r = *relation.fluent;
            if (relation.first_feature >= 0 || r.scalar != RDDL_BOOL || r.rank != 2) continue;
            for (const Source& source : sources_)
                for (const bool forward : {true, false})
                    if (counts(relation, source, forward) && scope_.input_count() < most_inputs)
                        add_count(relation, source, forward);
        }
    }

  private:
    void add_units() {
        std::map<std::int32_t, int> outputs;  // of action-fluents
        for (int c = 0; c < scope_.actions.column_count; ++c) {
            const std::int32_t fluent = columns_[static_cast<std::size_t>(c)].fluent;
            const auto [output, is_new] = outputs.try_emplace(fluent, scope_.output_count());
            if (is_new) scope_.outputs.push_back(text_of(*rddl_fluent_at(&problem_, fluent)));
            scope_.units.push_back({output->second, c});
        }
    }

    std::string text_of(const rddl_fluent& fluent) const {
        std::string parameters;
        for (std::int32_t p = 0; p < fluent.rank; ++p)
            parameters +=
                (p > 0 ? ", ?" : "?") + std::string(parameter_type(problem_, fluent, p).name);
        return parameters.empty() ? fluent.name : std::string(fluent.name) + "(" + parameters + ")";
    }

    // Adds the means of a source over all groundings that agree with what bind(action) fixes.
    template <class Bind>
    void add_input(std::string name, const Source& source, Bind bind) {
        ProgramInput input;
        input.name = std::move(name);
        scale_by_bounds(input, source.lower, source.upper);
        scope_.inputs.push_back(std::move(input));
        std::map<SharedParameters, std::int64_t> first_sums;
        for_each_unit([&](const rddl_fluent& action, std::int64_t grounding) {
            const SharedParameters shared = bind(action);
            const auto [first, is_new] = first_sums.try_emplace(shared, scope_.sum_count());
            if (is_new) add_means(source, shared);
            return first->second + number_of(source, shared, [&](std::int32_t, std::int32_t q) {
                       return object_at(problem_, action, grounding, q);
                   });
        });
    }

    // sum_of(action, grounding) says which sum the unit reads as the input that was added last.
    template <class SumOf>
    void for_each_unit(SumOf sum_of) {
        for (const rddl_column& column : columns_)
            scope_.sum_of_unit.push_back(static_cast<std::int32_t>(
                sum_of(*rddl_fluent_at(&problem_, column.fluent), column.grounding)));
        scope_.input_ends.push_back(scope_.sum_count());
    }

    // The number of a choice of objects for the source's shared parameters, from
    // object_of(source's, action's).
    template <class ObjectOf>
    std::int64_t number_of(const Source& source, const SharedParameters& shared,
                           ObjectOf object_of) const {
        std::int64_t number = 0;
        for (const auto& [p, q] : shared)
            number =
                number * parameter_type(problem_, *source.fluent, p).object_count + object_of(p, q);
        return number;
    }

    // A mean for each choice of objects for the parameters that are shared.
    void add_means(const Source& source, const SharedParameters& shared) {
        std::int64_t count = 1;
        for (const auto& [p, q] : shared)
            count *= parameter_type(problem_, *source.fluent, p).object_count;
        std::vector<std::vector<std::int64_t>> groundings(static_cast<std::size_t>(count));
        for (std::int64_t g = 0; g < source.fluent->count; ++g) {
            const std::int64_t number =
                number_of(source, shared, [&](std::int32_t p, std::int32_t) {
                    return object_at(problem_, *source.fluent, g, p);
                });
            groundings[static_cast<std::size_t>(number)].push_back(g);
        }
        for (const std::vector<std::int64_t>& those : groundings) {
            for (const std::int64_t g : those) {
                ProgramScope::Term term = term_of(source, g);
                term.factor /= static_cast<double>(those.size());
                scope_.terms.push_back(term);
            }
            end_sum();
        }
    }

    // Whether a relation between two objects, relation(own, other) or else relation(other, own),
    // says over which others an observed fluent may be counted.
    static bool counts(const Source& relation, const Source& source, bool forward) {
        const rddl_fluent& fluent = *source.fluent;
        return source.first_feature >= 0 && fluent.rank == 1 &&
               fluent.parameter_types[0] == relation.fluent->parameter_types[forward ? 1 : 0];
    }

    void add_count(const Source& relation, const Source& source, bool forward) {
        const rddl_fluent& r = *relation.fluent;
        ProgramInput input;
        input.name = std::string("sum[") + source.name + ": " + relation.name +
                     (forward ? "(?, other)]" : "(other, ?)]");
        scope_.inputs.push_back(std::move(input));
        const std::int64_t rows = parameter_type(problem_, r, 0).object_count,
                           columns = parameter_type(problem_, r, 1).object_count;
        const std::int64_t owns = forward ? rows : columns, others = forward ? columns : rows;
        const std::int64_t first = scope_.sum_count();
        for (std::int64_t own = 0; own < owns; ++own) {
            for (std::int64_t other = 0; other < others; ++other) {
                const std::int64_t at = forward ? own * columns + other : other * columns + own;
                if (relation.constants[static_cast<std::size_t>(at)] != 0)
                    scope_.terms.push_back(term_of(source, other));
            }
            end_sum();
        }
        end_sum();  // nothing, for actions without such an object
        for_each_unit([&](const rddl_fluent& action, std::int64_t grounding) {
            for (std::int32_t q = 0; q < action.rank; ++q)
                if (action.parameter_types[q] == r.parameter_types[forward ? 0 : 1])
                    return first + object_at(problem_, action, grounding, q);
            return first + owns;
        });
    }

    void end_sum() { scope_.sum_ends.push_back(scope_.terms.size()); }

    const rddl_problem& problem_;
    ProgramScope& scope_;
    std::vector<Source> sources_;
    std::vector<rddl_column> columns_;  // of actions
};

}  // namespace

void lift(const rddl_simulator& simulator, ProgramScope& scope) {
    Lifter(simulator, scope).lift();
}

void scale_by_bounds(ProgramInput& input, double lower, double upper) {
    if (!std::isfinite(lower) || !std::isfinite(upper) || !(lower < upper)) return;
    input.is_known = true;
    if (lower == 0 && upper == 1) return;  // bools, shares: as they are
    input.shift = (lower + upper) / 2;
    input.scale = 2 / (upper - lower);
}

}  // namespace rddlc::solvers
