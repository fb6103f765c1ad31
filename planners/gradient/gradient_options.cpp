#include "planners/gradient/gradient_options.hpp"

#include <iterator>

namespace rddlc::planners {

namespace {

using solvers::number_option;

solvers::OptionTable<GradientOptions> make_gradient_table() {
    using Its = GradientOptions;
    solvers::OptionTable<Its> table = common_options<Its>(
        "Ascents of a decision: a gradient of each plan",
        "Steps of a plan (auto: 40; at first fewer where the budget of steps is small)",
        "A policy whose course is compared with the plans");
    solvers::OptionTable<Its> own = {
        number_option<Its, int>(
            {"plans", "plans", "N",
             "Plans that are improved side by side, by each relaxation (8; 2 of random problems)"},
            [](auto& o) -> auto& { return o.plans; }, 1, 1 << 16),
        number_option<Its, int>(
            {"scenarios", "scenarios", "N",
             "Draws of luck for each plan and ascent (4; 1 where nothing is drawn)"},
            [](auto& o) -> auto& { return o.scenarios; }, 1, 1 << 16),
        number_option<Its, double>(
            {"rate", "rate", "X", "Learning rate of Adam, in half widths of bounds (0.1)"},
            [](auto& o) -> auto& { return o.rate; }, 1e-6, 100.0),
        number_option<Its, double>(
            {"spread", "spread", "X",
             "Deviation of the first plans from no-op, in half widths of bounds (0.5)"},
            [](auto& o) -> auto& { return o.spread; }, 0.0, 100.0),
        number_option<Its, std::int64_t>(
            {"replan", "replan", "N", "Steps that are made by one plan before the next search (1)"},
            [](auto& o) -> auto& { return o.replan; }, 1, most_steps),
        solvers::choice_option<Its, Relaxed>(
            {"relax", "relax", "HOW",
             "Comparisons, roundings and draws of bools: soft, relaxed values and derivatives; "
             "straight, exact values; exact, no derivatives; all (default), some plans by each"},
            [](auto& o) -> auto& { return o.relaxed; },
            {{"all", Relaxed::All},
             {"soft", Relaxed::Soft},
             {"straight", Relaxed::Straight},
             {"exact", Relaxed::Exact}}),
        number_option<Its, double>(
            {"sharpness", "sharpness", "W", "Of the sigmoids that replace comparisons (10)"},
            [](auto& o) -> auto& { return o.sharpness; }, 1e-6, 1e9),
    };
    table.insert(table.end(), std::make_move_iterator(own.begin()),
                 std::make_move_iterator(own.end()));
    return table;
}

}  // namespace

const solvers::OptionTable<GradientOptions>& gradient_option_table() {
    static const solvers::OptionTable<GradientOptions> table = make_gradient_table();
    return table;
}

}  // namespace rddlc::planners
