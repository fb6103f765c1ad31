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
    int width = 600, height = 400;  // pixels, from 16 to 8,192
};

// The bytes of a PNG file. Throws a Failure.
std::string picture_of(const SteppedEpisode& episode, std::size_t moment,
                       const std::string& visualizer, PictureSize size);

}  // namespace rddlc::studio
