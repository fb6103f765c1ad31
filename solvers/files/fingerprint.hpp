// A number that tells problems apart.
#pragma once

#include <rddl/simulator.h>

#include <cstdint>

namespace rddlc::solvers {

// Of the names of domain, instance and fluents, their sizes, the horizon and the discount.
std::uint64_t fingerprint(const rddl_simulator& simulator);

}  // namespace rddlc::solvers
