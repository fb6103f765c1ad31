// Finds which of the caller's values is refused, and why: called only after a check has failed
// (record_checks.hpp).
#pragma once

#include <rddl/batch/record_checks.hpp>
#include <rddl/interface/describe.hpp>
#include <rddl/interface/error_text.hpp>
#include <rddl/interface/fixed_text.hpp>
#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace rddl {

namespace detail {

// "environment 3: set-mode is 7, beyond the 2 objects of 'speed'"
template <class Value>
[[gnu::cold, gnu::noinline]] rddl_error refuse_value(const rddl_problem& problem,
                                                     const rddl_fluent& fluent,
                                                     std::int64_t environment,
                                                     std::int64_t grounding, Value value) {
    char name[256];
    FixedText text(name);
    write_grounding_name(text, problem, fluent, grounding);
    if (value != value || fluent.range_type < 0)
        return bad_argument("environment ", environment, ": ", std::string_view(name), " is ",
                            value, value != value ? ", no number" : ", beyond the ints");
    const rddl_type& type = problem.types[fluent.range_type];
    return bad_argument("environment ", environment, ": ", std::string_view(name), " is ", value,
                        ", beyond the ", type.object_count, " objects of '",
                        std::string_view(type.name), "'");
}

}  // namespace detail

// The first bad value of records of this role, of `count` environments from `begin` on.
[[gnu::cold]] inline rddl_error refuse_records(const rddl_problem& problem, rddl_role role,
                                               const std::byte* records, std::int64_t begin,
                                               std::int64_t count) {
    const bool are_actions = role == RDDL_ACTION;
    const std::int64_t size = are_actions ? problem.action_size : problem.state_size;
    const std::string_view what = are_actions ? "actions" : "states";
    if (records == nullptr) return bad_argument("the ", what, " are missing");
    for (std::int64_t i = 0; i < count; ++i)
        for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
            const rddl_fluent& fluent = problem.fluents[f];
            if (fluent.role != role || fluent.range_type < 0) continue;
            const std::int64_t objects = problem.types[fluent.range_type].object_count;
            for (std::int64_t k = 0; k < fluent.count; ++k) {
                std::int64_t value;
                std::memcpy(&value, records + i * size + fluent.offset + 8 * k, sizeof value);
                if (value < 0 || value >= objects)
                    return detail::refuse_value(problem, fluent, begin + i, k, value);
            }
        }
    return bad_argument("one of the ", what, " has an object that does not exist");
}

// The first bad number of a matrix of actions.
template <class Number>
[[gnu::cold]] rddl_error refuse_values(const rddl_problem& problem, const Number* rows,
                                       std::int64_t row_count) {
    for (std::int64_t i = 0; i < row_count; ++i)
        for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
            const rddl_fluent& fluent = problem.fluents[f];
            if (fluent.role != RDDL_ACTION) continue;
            const std::int64_t objects =
                fluent.range_type < 0 ? 0 : problem.types[fluent.range_type].object_count;
            for (std::int64_t k = 0; k < fluent.count; ++k)
                if (const Number value = *rows++; !is_valid_number(fluent.scalar, objects, value))
                    return detail::refuse_value(problem, fluent, i, k, static_cast<double>(value));
        }
    return bad_argument("one of the actions is not a number that its fluent takes");
}

}  // namespace rddl
