#include "pictures/pace.hpp"

#include "support/failure.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::cli {

namespace {

constexpr double usual_frames_per_second = 10;
constexpr double most_frames_per_second = 50;  // that players of GIFs keep up with

// How long a step is in the problem's own time: by the names that problems use for it.
double seconds_per_step(const rddl::render::World& world) {
    const rddl_fluent* const fluent =
        world.find("DT|DELTA-T|TIME-DELTA|TIME-STEP|TIME_DELTA|TAU|Ts|DELTA|TIMESTEP");
    if (fluent && fluent->role == RDDL_NON_FLUENT && fluent->rank == 0) {
        const double seconds = world.constant(*fluent).numbers.at(0);
        if (seconds > 0 && std::isfinite(seconds)) return seconds;
    }
    throw Failure("this problem does not tell how long a step is, which --real-time-factor needs",
                  "say --fps N", usage_error);
}

}  // namespace

Pace choose_pace(const PictureOptions& options, const rddl::render::World& world,
                 std::int64_t horizon) {
    double rate = options.frames_per_second.value_or(usual_frames_per_second);
    if (options.real_time_factor) rate = *options.real_time_factor / seconds_per_step(world);
    std::int64_t stride = 1;
    if (options.most_frames && horizon >= *options.most_frames)
        stride = horizon / *options.most_frames + 1;
    stride = std::max(stride, static_cast<std::int64_t>(std::ceil(rate / most_frames_per_second)));
    return {std::max(rate / static_cast<double>(stride), 0.01), stride};
}

}  // namespace rddlc::cli
