// The description of a problem beyond the tables of rddl_problem: names of groundings, columns of
// matrices, values that the instance fixes.
#pragma once

#include <rddl/interface/constants.hpp>
#include <rddl/interface/fixed_text.hpp>
#include <rddl/simulator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace rddl {

// "rlevel___t1", "at___i1__n2", or just "turn".
inline void write_grounding_name(FixedText& text, const rddl_problem& problem,
                                 const rddl_fluent& fluent, std::int64_t grounding) {
    text << std::string_view(fluent.name);
    std::int64_t stride = fluent.count;
    for (std::int32_t k = 0; k < fluent.rank; ++k) {
        const rddl_type& type = problem.types[fluent.parameter_types[k]];
        stride /= type.object_count;
        text << std::string_view(k == 0 ? "___" : "__")
             << std::string_view(type.objects[grounding / stride % type.object_count]);
    }
}

// Nothing if the matrix of the role has no such column.
inline std::optional<rddl_column> column_at(const rddl_problem& problem, rddl_role role,
                                            std::int64_t column) {
    if (column < 0) return std::nullopt;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role != role) continue;
        if (column >= fluent.count) {
            column -= fluent.count;
            continue;
        }
        const std::int64_t objects =
            fluent.range_type >= 0 ? problem.types[fluent.range_type].object_count : 0;
        const bool is_limited = fluent.scalar == RDDL_BOOL || objects > 0;
        const auto last = static_cast<double>(fluent.scalar == RDDL_BOOL ? 1 : objects - 1);
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return rddl_column{.struct_size = sizeof(rddl_column),
                           .fluent = f,
                           .grounding = column,
                           .scalar = fluent.scalar,
                           .object_count = static_cast<std::int32_t>(objects),
                           .lower = is_limited                ? 0.0
                                    : fluent.lower != nullptr ? fluent.lower[column]
                                                              : -infinity,
                           .upper = is_limited                ? last
                                    : fluent.upper != nullptr ? fluent.upper[column]
                                                              : infinity};
    }
    return std::nullopt;
}

// The values [begin, begin + count) of a non-fluent.
inline void write_constants(const Constants& constants, std::int64_t begin, std::int64_t count,
                            std::byte* to) {
    std::visit(
        [&]<class T>(const ConstantValues<T>& values) {
            for (std::int64_t k = 0; k < count; ++k) {
                const T value = values.at(begin + k);
                std::memcpy(to + k * static_cast<std::int64_t>(sizeof value), &value, sizeof value);
            }
        },
        constants.values);
}

}  // namespace rddl
