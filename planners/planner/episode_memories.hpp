// Each planner's memory of the episodes that it acts in, from one decision to the next.
#pragma once

#include "planners/planner/planner.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::planners {

template <class Memory>
class EpisodeMemories {
  public:
    explicit EpisodeMemories(std::int64_t environments)
        : places_(static_cast<std::size_t>(environments)) {}

    // The memory of the decision's episode. It is empty where the episode begins, and where the
    // planner has not acted in this episode before: it may be asked first in the middle of one.
    std::optional<Memory>& of(const DecisionPoint& point) {
        Place& place = places_[static_cast<std::size_t>(point.place)];
        if (point.step == 0 || place.episode != point.episode) place.memory.reset();
        place.episode = point.episode;
        return place.memory;
    }

  private:
    struct Place {
        std::int64_t episode = -1;
        std::optional<Memory> memory;
    };
    std::vector<Place> places_;
};

}  // namespace rddlc::planners
