// The choices of a solver that acts by changing one action value at a time (simulator.h,
// action_choice_count), derived from the description of the problem: nothing is stored.
#pragma once

#include <rddl/simulator.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl {

namespace detail {

// The values [first, first + count) that an action value may be set to.
struct ChoiceValues {
    std::int64_t first = 0;
    std::int64_t count = 0;
};

// The ints between two bounds, unless one of them is missing or they are too many.
inline ChoiceValues ints_between(double lower, double upper) {
    constexpr double exact = 0x1p53;
    const double first = std::ceil(lower);
    const double last = std::floor(upper);
    if (!(first >= -exact && last <= exact && last - first < RDDL_MOST_INT_CHOICES)) return {};
    if (last < first) return {};
    return {static_cast<std::int64_t>(first), static_cast<std::int64_t>(last - first) + 1};
}

inline ChoiceValues choice_values(const rddl_problem& problem, const rddl_fluent& fluent,
                                  std::int64_t grounding) {
    if (fluent.scalar == RDDL_BOOL) return {0, 2};
    if (fluent.range_type >= 0) return {0, problem.types[fluent.range_type].object_count};
    if (fluent.scalar != RDDL_INT || fluent.lower == nullptr || fluent.upper == nullptr) return {};
    return ints_between(fluent.lower[grounding], fluent.upper[grounding]);
}

// One bool or int of an action record, as an int.
inline std::int64_t read_choice(const rddl_fluent& fluent, const void* action,
                                std::int64_t grounding) {
    const auto* const values = static_cast<const std::byte*>(action) + fluent.offset;
    if (fluent.scalar == RDDL_BOOL) return values[grounding] != std::byte{0};
    std::int64_t value;
    std::memcpy(&value, values + grounding * 8, sizeof value);
    return value;
}

inline void write_choice(const rddl_fluent& fluent, void* action, std::int64_t grounding,
                         std::int64_t value) {
    auto* const values = static_cast<std::byte*>(action) + fluent.offset;
    if (fluent.scalar == RDDL_BOOL)
        values[grounding] = static_cast<std::byte>(value);
    else
        std::memcpy(values + grounding * 8, &value, sizeof value);
}

// visit(fluent, grounding, values, default value) for each value of the action record that has
// choices, in their order.
template <class Visit>
void for_each_choosable(const rddl_problem& problem, Visit&& visit) {
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role != RDDL_ACTION) continue;
        for (std::int64_t g = 0; g < fluent.count; ++g) {
            const ChoiceValues values = choice_values(problem, fluent, g);
            if (values.count > 0)
                visit(fluent, g, values, read_choice(fluent, problem.default_action, g));
        }
    }
}

}  // namespace detail

// The change of a choice other than choice 0: the fluent's value at the grounding.
struct Change {
    const rddl_fluent* fluent;
    std::int64_t grounding;
    std::int64_t value;
    std::int64_t default_value;  // another one

    // Sets the value in an action record; returns the old one.
    std::int64_t exchange(void* action, std::int64_t to) const {
        const std::int64_t before = detail::read_choice(*fluent, action, grounding);
        detail::write_choice(*fluent, action, grounding, to);
        return before;
    }
};

// Calls visit(choice, change) for each choice but choice 0, in order.
template <class Visit>
void for_each_choice(const rddl_problem& problem, Visit&& visit) {
    std::int64_t choice = 1;
    detail::for_each_choosable(
        problem, [&](const rddl_fluent& fluent, std::int64_t grounding, detail::ChoiceValues values,
                     std::int64_t default_value) {
            for (std::int64_t k = 0; k < values.count; ++k)
                if (values.first + k != default_value)
                    visit(choice++, Change{&fluent, grounding, values.first + k, default_value});
        });
}

inline std::int64_t choice_count(const rddl_problem& problem) {
    std::int64_t count = 1;
    detail::for_each_choosable(
        problem, [&](const rddl_fluent&, std::int64_t, detail::ChoiceValues values,
                     std::int64_t default_value) {
            const std::int64_t place = default_value - values.first;
            count += values.count - (place >= 0 && place < values.count ? 1 : 0);
        });
    return count;
}

// The change of a choice above 0 and below choice_count.
inline Change change_of(const rddl_problem& problem, std::int64_t choice) {
    Change change{};
    std::int64_t before = 1;  // choices before this value's
    detail::for_each_choosable(
        problem, [&](const rddl_fluent& fluent, std::int64_t grounding, detail::ChoiceValues values,
                     std::int64_t default_value) {
            const std::int64_t place = default_value - values.first;
            const bool skips = place >= 0 && place < values.count;
            std::int64_t k = choice - before;
            before += values.count - skips;
            if (k < 0 || choice >= before) return;
            if (skips && k >= place) ++k;
            change = {&fluent, grounding, values.first + k, default_value};
        });
    return change;
}

}  // namespace rddl
