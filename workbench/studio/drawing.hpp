// Pictures of the moments of an episode.
#pragma once

#include "studio/stepped_episode.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace rddlc::studio {

// The visualizers that can draw the problem, the best one first. Empty if rddl was built without
// pictures.
std::vector<std::string> visualizers_for(const rddl_simulator& simulator);

struct PictureSize {
    int width = 600, height = 400;  // pixels, from 16 to 4,096
};

// The part of an episode that a picture shows: a moment, and those before it that leave traces.
// They are copies, so that the episode may go on while they are drawn.
struct DrawnMoments {
    std::size_t first = 0;        // the number of the first one
    std::vector<Moment> moments;  // those parts of them that are drawn
};
// Throws a Failure if the episode has no such moment.
DrawnMoments drawn_moments(const SteppedEpisode& episode, std::size_t moment);

// The bytes of a PNG file. Reads only what no step changes of the episode. Throws a Failure.
std::string picture_of(const SteppedEpisode& episode, const DrawnMoments& drawn,
                       const std::string& visualizer, PictureSize size);

}  // namespace rddlc::studio
