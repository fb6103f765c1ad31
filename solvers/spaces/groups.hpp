// Bools of which preconditions let one change at a time, such as one item for each consumer.
#pragma once

#include <vector>

namespace rddlc::solvers {

struct Groups {
    std::vector<std::vector<int>> columns;  // of each group at least two, in ascending order
    bool may_be_none = true;                // false: one bool of each group has to change
};

}  // namespace rddlc::solvers
