#include "solvers/spaces/observations.hpp"

#include "solvers/spaces/groundings.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc::solvers {

namespace {

const rddl_type* type_of(const rddl_problem& problem, const rddl_fluent& fluent) {
    return fluent.range_type >= 0 ? rddl_type_at(&problem, fluent.range_type) : nullptr;
}

bool shows_time(const rddl_problem& problem, ObservationOptions::Time time) {
    if (problem.horizon <= 0 || time == ObservationOptions::Time::Off) return false;
    return time == ObservationOptions::Time::On || problem.horizon <= longest_horizon_with_time;
}

void write_frame(const ObservationSpace& space, const float* values, float* features) {
    if (!space.has_objects) {
        std::copy_n(values, space.columns.size(), features);
        return;
    }
    for (std::size_t c = 0; c < space.columns.size(); ++c) {
        const ObservationSpace::Column& column = space.columns[c];
        if (column.object_count == 0) {
            features[column.first_feature] = values[c];
            continue;
        }
        for (int object = 0; object < column.object_count; ++object)
            features[column.first_feature + object] =
                static_cast<float>(object) == values[c] ? 1.0f : 0.0f;
    }
}

}  // namespace

std::string grounded_name(const rddl_simulator& simulator, std::int32_t fluent_index,
                          std::int64_t grounding) {
    const rddl_problem& problem = *simulator.problem;
    const rddl_fluent& fluent = *rddl_fluent_at(&problem, fluent_index);
    std::string objects;
    for (std::int32_t p = 0; p < fluent.rank; ++p)
        objects += (p > 0 ? ", " : "") +
                   std::string(parameter_type(problem, fluent, p)
                                   .objects[object_at(problem, fluent, grounding, p)]);
    return objects.empty() ? fluent.name : std::string(fluent.name) + "(" + objects + ")";
}

ObservationSpace observation_space(const rddl_simulator& simulator,
                                   const ObservationOptions& options) {
    const rddl_problem& problem = *simulator.problem;
    ObservationSpace space;
    space.stack = options.stack;
    space.time = shows_time(problem, options.time);
    space.horizon = problem.horizon;
    const std::int64_t columns = simulator.observation_value_count(&simulator);
    if (columns == 0)
        throw Failure("there is nothing to observe in this problem: it has no state-fluents");
    for (std::int64_t c = 0; c < columns; ++c) {
        rddl_column description{};
        simulator.observation_column(&simulator, c, &description);
        ObservationSpace::Column column;
        column.name = grounded_name(simulator, description.fluent, description.grounding);
        column.first_feature = space.frame_size();
        column.object_count = description.object_count;
        column.scalar = description.scalar;
        column.lower = description.lower;
        column.upper = description.upper;
        const rddl_type* const type =
            type_of(problem, *rddl_fluent_at(&problem, description.fluent));
        if (column.object_count == 0) space.features.push_back(column.name);
        for (int object = 0; object < column.object_count; ++object)
            space.features.push_back(column.name + "=" + type->objects[object]);
        space.has_objects |= column.object_count > 0;
        space.columns.push_back(std::move(column));
    }
    constexpr std::int64_t most_features = 1 << 30;
    if (std::int64_t{space.stack} * space.frame_size() > most_features)
        throw Failure(fmt::format("{} observations of {} values each are more than a network takes",
                                  space.stack, space.frame_size()));
    return space;
}

void write_features(const ObservationSpace& space, const float* values, std::int64_t steps,
                    bool begins, float* features) {
    const int frame = space.frame_size(), stacked = frame * space.stack;
    if (begins)
        std::fill(features + frame, features + stacked, 0.0f);
    else
        std::copy_backward(features, features + stacked - frame, features + stacked);
    write_frame(space, values, features);
    if (space.time)
        features[stacked] = static_cast<float>(steps) / static_cast<float>(space.horizon);
}

}  // namespace rddlc::solvers
