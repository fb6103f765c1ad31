#include "pictures/pace.hpp"

#include "support/failure.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::workbench {

namespace {

constexpr double usual_frames_per_second = 10;
constexpr double most_frames_per_second = 50;         // that players of GIFs keep up with
constexpr double least_rate = 0.01, most_rate = 1e9;  // states a second

// How long a step is in the problem's own time: by the names that problems use for it.
double seconds_per_step(const rddl::render::World& world) {
    const rddl_fluent* const fluent =
        world.find("DT|DELTA-T|TIME-DELTA|TIME-STEP|TIME_DELTA|TAU|Ts|DELTA|TIMESTEP");
    if (fluent && fluent->role == RDDL_NON_FLUENT && fluent->rank == 0) {
        const double seconds = world.constant(*fluent).numbers.at(0);
        if (seconds > 0 && std::isfinite(seconds)) return seconds;
    }
    throw Failure("this problem does not say how long a step is, which --real-time-factor needs",
                  "say --fps N", usage_error);
}

// Chooses the stride so that no more than so many states of an episode are shown, the first and the
// last one among them.
std::int64_t stride_for(std::int64_t horizon, std::int64_t most_frames) {
    if (horizon < most_frames) return 1;
    const std::int64_t gaps = most_frames - 1;
    return gaps == 0 ? Pace::last_alone : (horizon - 1) / gaps + 1;
}

}  // namespace

Pace choose_pace(const PictureOptions& options, const rddl::render::World& world,
                 std::int64_t horizon) {
    if (options.frames_per_second && options.real_time_factor)
        throw Failure("--fps and --real-time-factor both say how quickly states are shown", {},
                      usage_error);
    double rate = options.frames_per_second.value_or(usual_frames_per_second);
    if (options.real_time_factor) rate = *options.real_time_factor / seconds_per_step(world);
    std::int64_t stride = options.most_frames ? stride_for(horizon, *options.most_frames) : 1;
    rate = std::clamp(rate, least_rate, most_rate);
    if (stride == Pace::last_alone) return {std::min(rate, most_frames_per_second), stride};
    stride = std::max(stride, static_cast<std::int64_t>(std::ceil(rate / most_frames_per_second)));
    return {std::max(rate / static_cast<double>(stride), least_rate), stride};
}

}  // namespace rddlc::workbench
