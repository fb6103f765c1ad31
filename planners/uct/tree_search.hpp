// The interface of the searches of plan:uct.
#pragma once

#include "planners/planner/planner.hpp"

#include <cstdint>

namespace rddlc::planners {

class TreeSearch : public Planner {
  public:
    // What the last decision found.
    struct Found {
        double value = 0;  // of the action that was taken, for `depth` steps; -inf: unknown
        std::int64_t depth = 0;
        bool is_noop = false;    // no-op was taken, since nothing that was tried is better
        bool has_choice = true;  // false: all actions are the same
    };
    const Found& found() const { return found_; }

  protected:
    Found found_;
};

}  // namespace rddlc::planners
