#include "solvers/spaces/actions.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/spaces/observations.hpp"
#include "solvers/spaces/preconditions.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc::solvers {

namespace {

// Ints of more values are numbers, not categories.
constexpr double most_categories = 64;

bool is_category(const rddl_column& column) {
    if (column.scalar == RDDL_BOOL || column.object_count > 0) return true;
    return column.scalar == RDDL_INT && column.upper - column.lower < most_categories;
}

// The mean size of the reals in the initial state, at least 1: what an unbounded action, of which
// nothing else is known, is measured in.
double typical_size(const rddl_simulator& simulator) {
    const rddl_problem& problem = *simulator.problem;
    std::vector<std::byte> state(static_cast<std::size_t>(problem.state_size));
    if (simulator.initial_state(&simulator, state.data()) != RDDL_OK) return 1;
    double sum = 0, count = 0;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, f);
        if (fluent.role != RDDL_STATE || fluent.scalar != RDDL_REAL) continue;
        for (std::int64_t g = 0; g < fluent.count; ++g) {
            double value;
            std::memcpy(&value, state.data() + fluent.offset + g * 8, sizeof value);
            if (!std::isfinite(value)) continue;
            sum += std::abs(value);
            count += 1;
        }
    }
    return count > 0 ? std::max(1.0, sum / count) : 1;
}

// The greatest power of two by which a value may differ from its start, in `direction`, at the
// beginning of an episode; `otherwise` if there is no such limit.
double legal_size(const rddl_simulator& simulator, const ActionRecords& records,
                  const std::vector<float>& defaults, int column, double start, double direction,
                  double otherwise, const Stops& stops) {
    if (simulator.problem->precondition_count == 0 || is_stopped(&stops)) return otherwise;
    rddl_batch_options options{};
    options.thread_count = 1;
    const BatchHandle batch = create_batch(simulator, options);
    std::vector<std::byte> action(records.record_size());
    std::vector<float> values = defaults;
    double largest = 0;
    for (int exponent = -10; exponent <= 20; ++exponent) {
        values[static_cast<std::size_t>(column)] =
            static_cast<float>(start + direction * std::ldexp(1.0, exponent));
        records.write(values.data(), action.data());
        std::int32_t violated = -1;
        require_done(simulator,
                     simulator.violated_preconditions(batch.get(), action.data(), &violated));
        if (violated < 0) largest = std::ldexp(1.0, exponent);
    }
    return largest > 0 && largest < 0x1p20 ? largest : otherwise;
}

RealHead real_head(const rddl_simulator& simulator, const ActionRecords& records,
                   const ActionSpace& space, const rddl_column& column, int index,
                   const Stops& stops) {
    RealHead head;
    head.column = index;
    head.rounds = column.scalar == RDDL_INT;
    head.lower = column.lower;
    head.upper = column.upper;
    head.centre = space.defaults[static_cast<std::size_t>(index)];
    if (std::isfinite(head.lower) && std::isfinite(head.upper)) {
        head.range = RealHead::Range::Bounded;
        return head;
    }
    const auto size = [&](double start, double direction) {
        return legal_size(simulator, records, space.defaults, index, start, direction,
                          typical_size(simulator), stops);
    };
    if (std::isfinite(head.lower)) {
        head.range = RealHead::Range::AboveLower;
        head.scale = size(head.lower, 1);
    } else if (std::isfinite(head.upper)) {
        head.range = RealHead::Range::BelowUpper;
        head.scale = size(head.upper, -1);
    } else {
        // Floats are coarse near a default that is far from 0, and a step has to reach the next.
        constexpr double least_part = 0x1p-10;
        head.scale = std::max(std::min(size(head.centre, 1), size(head.centre, -1)),
                              least_part * std::abs(head.centre));
    }
    return head;
}

void add_category(ActionSpace& space, const rddl_column& column, int index) {
    CategoryHead head;
    head.column = index;
    head.first_logit = space.logit_count;
    if (column.object_count > 0) {
        head.count = column.object_count;
    } else if (column.scalar == RDDL_BOOL) {
        head.count = 2;
    } else {
        head.first_value = static_cast<std::int64_t>(std::ceil(column.lower));
        head.count = static_cast<int>(std::floor(column.upper) - std::ceil(column.lower)) + 1;
    }
    if (head.count <= 0) return;  // no int fits between the bounds: the default is left
    space.logit_count += head.count;
    space.categories.push_back(head);
}

// The column that each choice of the simulator changes, and its new value.
std::vector<Choice> simulator_choices(const rddl_simulator& simulator,
                                      const std::vector<rddl_column>& columns) {
    std::vector<Choice> choices;
    const std::int64_t count = simulator.action_choice_count(&simulator);
    int column = 0;
    for (std::int64_t c = 0; c < count; ++c) {
        rddl_choice choice{};
        simulator.action_choice(&simulator, c, nullptr, &choice);
        Choice found;
        found.of_mask = c;
        if (choice.fluent >= 0) {
            const auto is_it = [&] {
                const rddl_column& at = columns[static_cast<std::size_t>(column)];
                return at.fluent == choice.fluent && at.grounding == choice.grounding;
            };
            while (!is_it()) ++column;
            found.column = column;
            found.value = choice.value;
        }
        choices.push_back(found);
    }
    return choices;
}

void add_sub_actions(ActionSpace& space, const rddl_simulator& simulator,
                     const std::vector<rddl_column>& columns, std::int64_t limit) {
    for (const Choice& choice : simulator_choices(simulator, columns))
        if (choice.column < 0 || is_category(columns[static_cast<std::size_t>(choice.column)]))
            space.choices.push_back(choice);
    for (std::size_t r = 0; r < space.reals.size(); ++r) {
        space.reals[r].choice = static_cast<int>(space.choices.size());
        Choice choice;
        choice.column = space.reals[r].column;
        choice.real = static_cast<int>(r);
        space.choices.push_back(choice);
    }
    space.categories.clear();
    space.logit_count = static_cast<int>(space.choices.size());
    space.max_sub_actions = static_cast<int>(std::min<std::int64_t>(limit, space.column_count));
}

void add_masks_of_categories(ActionSpace& space, const rddl_simulator& simulator,
                             const std::vector<rddl_column>& columns) {
    std::vector<const CategoryHead*> head_of(columns.size());
    for (const CategoryHead& head : space.categories)
        head_of[static_cast<std::size_t>(head.column)] = &head;
    for (const Choice& choice : simulator_choices(simulator, columns)) {
        const CategoryHead* const head =
            choice.column < 0 ? nullptr : head_of[static_cast<std::size_t>(choice.column)];
        space.logit_of_mask.push_back(
            head ? head->first_logit + static_cast<int>(choice.value - head->first_value) : -1);
    }
}

// A group gets one category in place of those of its bools, at the place of the first bool's.
void add_groups(ActionSpace& space, const Groups& groups) {
    std::vector<const std::vector<int>*> group_of(static_cast<std::size_t>(space.column_count));
    for (const std::vector<int>& group : groups.columns)
        for (const int column : group) group_of[static_cast<std::size_t>(column)] = &group;
    std::vector<CategoryHead> categories;
    space.logit_count = 0;
    for (CategoryHead& head : space.categories) {
        const std::vector<int>* const group = group_of[static_cast<std::size_t>(head.column)];
        if (group && head.column != group->front()) continue;
        if (group) {
            head.group = *group;
            head.first_value = groups.may_be_none ? 0 : 1;
            head.count = static_cast<int>(group->size()) + (groups.may_be_none ? 1 : 0);
        }
        head.first_logit = space.logit_count;
        space.logit_count += head.count;
        categories.push_back(std::move(head));
    }
    space.categories = std::move(categories);
}

// Bytes of the masks of one environment in one step: rollouts keep thousands of them.
constexpr std::int64_t most_mask_bytes = 10'000'000;

bool fit_into_masks(std::int64_t sub_actions, std::int64_t choices) {
    return choices <= most_mask_bytes / std::max<std::int64_t>(sub_actions, 1);
}

// The simulator tries each choice for a mask, and checks the whole action each time.
bool may_ask_for_masks(const rddl_problem& problem, std::int64_t columns, std::int64_t choices) {
    constexpr std::int64_t most_values = 4'000'000;
    return problem.precondition_count == 0 || choices <= most_values / columns;
}

// How many values may differ from the default.
std::int64_t limit_of_changes(const rddl_problem& problem, std::int64_t columns) {
    return problem.max_nondef_actions < 0 ? columns : std::min(columns, problem.max_nondef_actions);
}

bool has_choice(const rddl_column& column) {
    if (column.object_count > 0) return column.object_count > 1;
    if (column.scalar == RDDL_INT) return std::ceil(column.lower) < std::floor(column.upper);
    return column.scalar == RDDL_BOOL || column.lower < column.upper;
}

}  // namespace

std::vector<rddl_column> action_columns(const rddl_simulator& simulator) {
    std::vector<rddl_column> columns(
        static_cast<std::size_t>(simulator.action_value_count(&simulator)));
    for (std::size_t c = 0; c < columns.size(); ++c) {
        columns[c].struct_size = sizeof(rddl_column);
        simulator.action_column(&simulator, static_cast<std::int64_t>(c), &columns[c]);
    }
    return columns;
}

void require_choices(const rddl_simulator& simulator) {
    const std::vector<rddl_column> columns = action_columns(simulator);
    const auto count = static_cast<std::int64_t>(columns.size());
    const std::int64_t limit = limit_of_changes(*simulator.problem, count);
    if (limit == 0 || std::ranges::none_of(columns, has_choice))
        throw Failure(
            "there is nothing to choose in this problem: it has no action but the default");
    const std::int64_t choices = simulator.action_choice_count(&simulator);
    if (limit < count && !fit_into_masks(limit, choices))
        throw Failure(
            fmt::format("this problem has too many choices for the learners: an action has {} "
                        "sub-actions, with {} choices each",
                        limit, choices));
}

namespace {

// Each value by itself, with the heads that it suggests.
ActionSpace space_of_columns(const rddl_simulator& simulator,
                             const std::vector<rddl_column>& columns, const ActionRecords& records,
                             const Stops& stops) {
    ActionSpace space;
    space.column_count = static_cast<int>(columns.size());
    space.defaults.resize(columns.size());
    records.read(static_cast<const std::byte*>(simulator.problem->default_action),
                 space.defaults.data());
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const auto index = static_cast<int>(c);
        space.names.push_back(grounded_name(simulator, columns[c].fluent, columns[c].grounding));
        if (is_category(columns[c]))
            add_category(space, columns[c], index);
        else
            space.reals.push_back(real_head(simulator, records, space, columns[c], index, stops));
    }
    return space;
}

}  // namespace

std::optional<Groups> groups_without_limit(const rddl_simulator& simulator, int least_bools,
                                           const Stops& stops) {
    if (simulator.problem->precondition_count == 0) return std::nullopt;
    const std::vector<rddl_column> columns = action_columns(simulator);
    const auto count = static_cast<std::int64_t>(columns.size());
    const auto bools = std::ranges::count(columns, RDDL_BOOL, &rddl_column::scalar);
    if (bools < least_bools || limit_of_changes(*simulator.problem, count) < count)
        return std::nullopt;
    const ActionRecords records(simulator);
    const ActionSpace space = space_of_columns(simulator, columns, records, stops);
    if (!preconditions_bite(simulator, space, records, stops)) return std::nullopt;
    return find_groups(simulator, columns, space, records, stops);
}

ActionSpace action_space(const rddl_simulator& simulator, const Stops& stops) {
    require_choices(simulator);
    const rddl_problem& problem = *simulator.problem;
    const std::vector<rddl_column> columns = action_columns(simulator);
    const ActionRecords records(simulator);
    ActionSpace space = space_of_columns(simulator, columns, records, stops);
    const std::int64_t limit = limit_of_changes(problem, space.column_count);
    const std::int64_t choices = simulator.action_choice_count(&simulator);
    const bool bites = preconditions_bite(simulator, space, records, stops);
    space.asks = may_ask_for_masks(problem, space.column_count, choices);
    const bool is_limited = limit < space.column_count;
    const auto groups =
        bites && limit > 1 ? find_groups(simulator, columns, space, records, stops) : std::nullopt;
    // Sub-actions also keep to limits and know what is legal; but from the default they do not find
    // actions where one bool of each group has to change.
    if (groups && !(is_limited && groups->may_be_none)) {
        add_groups(space, *groups);
    } else if (is_limited) {
        add_sub_actions(space, simulator, columns, limit);
    } else if (bites && space.asks && space.reals.empty() && space.categories.size() > 1 &&
               fit_into_masks(limit, choices)) {
        add_sub_actions(space, simulator, columns, limit);
    } else if (bites && space.asks && !space.categories.empty() && fit_into_masks(1, choices)) {
        add_masks_of_categories(space, simulator, columns);
    }
    space.masked = space.max_sub_actions > 0 || !space.logit_of_mask.empty();
    space.may_be_illegal = bites;
    return space;
}

void squash_bounded(ActionSpace& space) {
    for (RealHead& head : space.reals)
        if (head.range == RealHead::Range::Bounded) head.range = RealHead::Range::Squashed;
}

}  // namespace rddlc::solvers
