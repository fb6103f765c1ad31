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

    // The memory of the decision's episode. It is empty where the planner has not acted in this
    // episode before, and where the episode was set back: what is remembered is of later steps.
    std::optional<Memory>& of(const DecisionPoint& point) {
        Place& place = places_[static_cast<std::size_t>(point.place)];
        if (place.episode != point.episode || point.step <= place.step) place.memory.reset();
        place.episode = point.episode;
        place.step = point.step;
        return place.memory;
    }

  private:
    struct Place {
        std::int64_t episode = -1, step = -1;  // of the decision before
        std::optional<Memory> memory;
    };
    std::vector<Place> places_;
};

}  // namespace rddlc::planners
