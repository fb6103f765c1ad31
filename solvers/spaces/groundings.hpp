// The objects of a fluent's grounding: the last parameter changes fastest.
#pragma once

#include <rddl/simulator.h>

#include <cstdint>

namespace rddlc::solvers {

inline const rddl_type& parameter_type(const rddl_problem& problem, const rddl_fluent& fluent,
                                       std::int32_t parameter) {
    return *rddl_type_at(&problem, fluent.parameter_types[parameter]);
}

// The number of the object at one of the fluent's parameters.
inline std::int64_t object_at(const rddl_problem& problem, const rddl_fluent& fluent,
                              std::int64_t grounding, std::int32_t parameter) {
    for (std::int32_t p = fluent.rank - 1; p > parameter; --p)
        grounding /= parameter_type(problem, fluent, p).object_count;
    return grounding % parameter_type(problem, fluent, parameter).object_count;
}

}  // namespace rddlc::solvers
