// The values of a record: their places and types.
#pragma once

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace rddlc::planners {

struct RecordColumn {
    std::size_t offset;
    rddl_scalar scalar;
};

inline std::vector<RecordColumn> record_columns(const rddl_problem& problem, rddl_role role) {
    std::vector<RecordColumn> columns;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, f);
        if (fluent.role != role) continue;
        const std::size_t size = fluent.scalar == RDDL_BOOL ? 1 : 8;
        for (std::int64_t g = 0; g < fluent.count; ++g)
            columns.push_back(
                {static_cast<std::size_t>(fluent.offset) + static_cast<std::size_t>(g) * size,
                 fluent.scalar});
    }
    return columns;
}

inline double real_at(const std::byte* at) {
    double real = 0;
    std::memcpy(&real, at, sizeof real);
    return real;
}

}  // namespace rddlc::planners
