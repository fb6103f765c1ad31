// Options that all planners have.
#pragma once

#include "planners/simulation/budget.hpp"
#include "solvers/options/options.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace rddlc::planners {

struct CommonOptions {
    Budget budget;
    std::optional<std::int64_t> horizon;  // steps that are looked ahead
    std::string policy;                   // that roll-outs follow; "": none
    bool cheat = false;                   // sees the state of problems that hide it
    int particles = 1024;                 // possible states, where it does not
    std::uint64_t seed = 0;
    // The option that needs a policy with values, "tail=value"; NULL: no option does. Planners that
    // have such an option hide this function.
    const char* option_for_values() const { return nullptr; }
};

template <class Options>
using PlannerOption = solvers::LearnerOption<Options>;

inline constexpr std::int64_t most_steps = std::int64_t{1} << 50;
inline constexpr std::int64_t longest_lookahead = 100'000;

// A table begins with these.
template <class Options>
solvers::OptionTable<Options> common_options(const std::string& iterations,
                                             const std::string& horizon,
                                             const std::string& policy) {
    using solvers::number_option;
    PlannerOption<Options> base{{"policy", "policy", "POLICY", policy}, {}, {}};
    base.set = [](Options& o, const std::vector<std::string>& words) {
        o.policy = words.front();
    };
    base.text = [](const Options& o) {
        return o.policy.empty() ? "none" : o.policy;
    };
    return {
        number_option<Options, double>(
            {"seconds", "seconds", "S", "Time of a decision (0.1, where no budget is given)"},
            [](auto& o) -> auto& { return o.budget.seconds; }, 0.0, 1e6),
        number_option<Options, std::int64_t>(
            {"steps", "steps", "N",
             "Simulated steps of a decision; the same bytes each time, as with iterations"},
            [](auto& o) -> auto& { return o.budget.steps; }, 1, most_steps),
        number_option<Options, std::int64_t>(
            {"iterations", "iterations", "N", iterations},
            [](auto& o) -> auto& { return o.budget.iterations; }, 1, most_steps),
        number_option<Options, std::int64_t>(
            {"horizon", "horizon", "H", horizon}, [](auto& o) -> auto& { return o.horizon; }, 1,
            longest_lookahead),
        std::move(base),
        solvers::choice_option<Options, bool>(
            {"cheat", "cheat", "yes|no",
             "See the state of a problem that is observed in part (no: the planner sees what "
             "policies see)"},
            [](auto& o) -> auto& { return o.cheat; }, {{"yes", true}, {"no", false}}),
        number_option<Options, std::uint64_t>(
            {"seed", "seed", "S", "Seed of the search (that of the command)"},
            [](auto& o) -> auto& { return o.seed; }, 0, std::numeric_limits<std::uint64_t>::max()),
    };
}

// Tables of planners that can do without the state have this one.
template <class Options>
PlannerOption<Options> particles_option() {
    return solvers::number_option<Options, int>(
        {"particles", "particles", "N",
         "Possible states that are kept of an episode that is observed in part (1024)"},
        [](auto& o) -> auto& { return o.particles; }, 1, 1 << 20);
}

}  // namespace rddlc::planners
