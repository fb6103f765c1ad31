#include "planners/cem/cem_options.hpp"

#include <array>

namespace rddlc::planners {

namespace {

using O = CemOptions;
using solvers::number_option;

solvers::OptionTable<O> make_cem_table() {
    solvers::OptionTable<O> table = common_options<O>(
        "Populations of a decision",
        "Steps that are looked ahead (auto: longer until something is better than no-op)",
        "A learned policy, or another one, whose actions are among the first plans; what "
        "follows the horizon is played by it");
    solvers::OptionTable<O> own = {
        particles_option<O>(),
        number_option<O, int>(
            {"population", "population", "N", "Plans of actions at a time (256)"},
            [](auto& o) -> auto& { return o.population; }, 4, 1 << 20),
        number_option<O, int>(
            {"scenarios", "scenarios", "N",
             "Random streams that each plan is played with, the same for all (4, or 1 where "
             "nothing is drawn at random)"},
            [](auto& o) -> auto& { return o.scenarios; }, 1, 1 << 16),
        number_option<O, double>(
            {"elites", "elites", "PART", "Part of them that the next ones are drawn like (0.1)"},
            [](auto& o) -> auto& { return o.elites; }, 0.001, 1.0),
        number_option<O, double>(
            {"correlation", "correlation", "RHO",
             "Of the noise of one step and the next; below 0 (-1, the default): a mixture of 0, "
             "0.5, 0.8, 0.95 and 1"},
            [](auto& o) -> auto& { return o.correlation; }, -1.0, 1.0),
        number_option<O, double>(
            {"spread", "spread", "X",
             "Deviation of the first plans, in half widths of the bounds (1)"},
            [](auto& o) -> auto& { return o.spread; }, 0.001, 100.0),
        number_option<O, double>(
            {"memory", "memory", "PART", "Part of the distribution before that is kept (0.2)"},
            [](auto& o) -> auto& { return o.memory; }, 0.0, 0.99),
        number_option<O, int>(
            {"kept", "kept", "N", "The best plans, which come again, also in the next step (8)"},
            [](auto& o) -> auto& { return o.kept; }, 1, 1 << 16),
        solvers::choice_option<O, Weights>(
            {"weights", "weights", "HOW",
             "Of the plans, in the next distribution: elites (default), all alike; mppi: all, "
             "by the exponential of their return"},
            [](auto& o) -> auto& { return o.weights; },
            {{"elites", Weights::Elites}, {"mppi", Weights::Mppi}}),
        number_option<O, double>(
            {"temperature", "temperature", "T", "Of mppi, in deviations of the returns (0.2)"},
            [](auto& o) -> auto& { return o.temperature; }, 1e-6, 1e6),
        solvers::choice_option<O, Tail>(
            {"tail", "tail", "HOW",
             "What follows the horizon, with a policy: policy (default): it plays on when the "
             "best plans are compared; value: the values that PPO has learned"},
            [](auto& o) -> auto& { return o.tail; },
            {{"policy", Tail::Policy}, {"value", Tail::Value}}),
        number_option<O, double>(
            {"near", "near", "PART",
             "Part of the budget for plans of two steps (0.25 with more than 4096 joint actions "
             "and no reals among them, else 0)"},
            [](auto& o) -> auto& { return o.near; }, 0.0, 0.9),
    };
    table.insert(table.end(), std::make_move_iterator(own.begin()),
                 std::make_move_iterator(own.end()));
    return table;
}

}  // namespace

std::span<const double> correlations_of(const CemOptions& options) {
    static constexpr std::array<double, 5> mixture{0, 0.5, 0.8, 0.95, 1};
    if (options.correlation < 0) return mixture;
    return {&options.correlation, 1};
}

const solvers::OptionTable<CemOptions>& cem_option_table() {
    static const solvers::OptionTable<CemOptions> table = make_cem_table();
    return table;
}

}  // namespace rddlc::planners
