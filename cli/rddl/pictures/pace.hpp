// How quickly states are shown, and which of them.
#pragma once

#include "pictures/picture_options.hpp"

#include <render/moment.hpp>

#include <cstdint>

namespace rddlc::cli {

struct Pace {
    double frames_per_second = 10;
    std::int64_t stride = 1;  // every so manyth state
};

// As the options say, of an episode with that horizon; 0: none. Throws a Failure where the problem
// does not tell how long a step is, and --real-time-factor asks for it.
Pace choose_pace(const PictureOptions& options, const rddl::render::World& world,
                 std::int64_t horizon);

}  // namespace rddlc::cli
