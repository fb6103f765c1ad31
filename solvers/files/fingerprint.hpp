// Numbers that tell problems, or files, apart.
#pragma once

#include <rddl/simulator.h>

#include <cstdint>
#include <string_view>

namespace rddlc::solvers {

// Of the names of domain, instance and fluents, their sizes, the horizon and the discount.
std::uint64_t fingerprint(const rddl_simulator& simulator);

// Changes with any single byte. Against bad luck, not bad will.
std::uint64_t checksum(std::string_view bytes);

}  // namespace rddlc::solvers
