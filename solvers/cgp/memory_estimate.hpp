// The memory estimate of CGP, made before any memory is allocated.
#pragma once

#include "solvers/cgp/scope.hpp"
#include "solvers/cgp/search.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>

namespace rddlc::solvers {

// Bytes.
struct CgpMemory {
    double environments = 0;  // of simulators, and what programs compute in them
    double programs = 0;      // those of a generation, and what is remembered of others
    double all() const { return environments + programs; }
};

// The estimate for so many islands. No option is "chosen here" any more.
CgpMemory memory_of(const rddl_simulator& simulator, const ProgramScope& scope,
                    const CgpOptions& options, std::int64_t islands);

// Throws a Failure with the sizes, and with what makes them smaller, where that is more than
// options.memory_limit.
void require_memory(const rddl_simulator& simulator, const ProgramScope& scope,
                    const CgpOptions& options, std::int64_t islands);

// Programs whose fitness an island remembers, at most.
std::size_t most_remembered(const CgpOptions& options);

}  // namespace rddlc::solvers
