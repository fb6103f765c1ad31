#include "solvers/drp/options.hpp"

#include "solvers/options/network_options.hpp"

namespace rddlc::solvers {

namespace {

using O = DrpOptions;
using Time = ObservationOptions::Time;

OptionTable<O> make_table() {
    using Mode = Relaxation::Mode;
    return {
        number_option<O, std::int64_t>(
            {"--steps", "steps", "N", "Steps of all episodes (5e6)", {"total_timesteps"}, false},
            [](auto& o) -> auto& { return o.steps; }, 1, 1'000'000'000'000'000),
        number_option<O, int>(
            {"--episodes", "episodes", "N",
             "Episodes of a gradient, rounded up to a multiple of 8 (8)"},
            [](auto& o) -> auto& { return o.episodes; }, 1, 1 << 20),
        number_option<O, std::int64_t>(
            {"--horizon", "horizon", "H", "Steps of an episode (the instance's)"},
            [](auto& o) -> auto& { return o.horizon; }, 1, 1'000'000),
        positive_option<O>(
            {"--lr", "learning_rate", "RATE", "Learning rate (3e-3)"},
            [](auto& o) -> auto& { return o.learning_rate; }, 10),
        positive_option<O>(
            {"--clip", "clip", "C", "Longest gradient, in mean lengths of those before (3)"},
            [](auto& o) -> auto& { return o.clip; }, 1e9),
        choice_option<O, Mode>(
            {"--relax", "relax", "HOW",
             "Relaxation of comparisons, roundings and draws of bools and ints: soft (default), "
             "straight, exact"},
            [](auto& o) -> auto& { return o.relaxation; },
            {{"soft", Mode::Soft}, {"straight", Mode::StraightThrough}, {"exact", Mode::Exact}}),
        positive_option<O>(
            {"--sharpness", "sharpness", "W", "Sharpness of relaxed comparisons (10)"},
            [](auto& o) -> auto& { return o.sharpness; }, 1e9),
        hidden_option<O>(),
        activation_option<O>(),
        choice_option<O, Time>(
            {"--time-input", "time_input", "WHEN",
             "Show the time to the policy: auto (default: horizons up to 200), on, off"},
            [](auto& o) -> auto& { return o.observations.time; },
            {{"auto", Time::Auto}, {"on", Time::On}, {"off", Time::Off}})};
}

}  // namespace

const OptionTable<DrpOptions>& drp_option_table() {
    static const OptionTable<DrpOptions> table = make_table();
    return table;
}

}  // namespace rddlc::solvers
