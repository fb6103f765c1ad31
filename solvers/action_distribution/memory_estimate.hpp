// The memory estimate of choosing, in bytes.
#pragma once

#include "solvers/action_distribution/action_distribution.hpp"

namespace rddlc::solvers {

// The bytes of a ActionDistribution for each environment.
inline double bytes_of_distribution(const rddl_simulator& simulator, const ActionSpace& space) {
    double bytes = sizeof(ChoiceKey) + 1.0 + sizeof(float) * 1.0 * space.real_count();
    if (space.masked || space.may_be_illegal)
        bytes += static_cast<double>(simulator.problem->action_size);
    if (space.masked) bytes += static_cast<double>(simulator.action_choice_count(&simulator));
    if (space.may_be_illegal)
        bytes += sizeof(float) * (2.0 * space.column_count + 1) + sizeof(RepairSearch) +
                 sizeof(RandomPolicy::Search) + sizeof(std::uint32_t) * 1.0 * space.column_count;
    return bytes;
}

// The bytes of one choice, a row of each array of Chosen.
inline double bytes_of_choice(const ActionSpace& space) {
    return sizeof(float) * (2.0 * space.real_count() + 2) +
           sizeof(std::int32_t) * 1.0 * space.index_count() + space.mask_size();
}

}  // namespace rddlc::solvers
