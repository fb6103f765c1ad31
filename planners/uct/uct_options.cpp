#include "planners/uct/uct_options.hpp"

namespace rddlc::planners {

namespace {

using solvers::choice_option;
using solvers::number_option;

solvers::OptionTable<UctOptions> make_uct_table() {
    solvers::OptionTable<UctOptions> table = common_options<UctOptions>(
        "Trials of a decision, rounded up to a multiple of lanes",
        "Steps that are looked ahead, to the end of the episode at most (40; 200 with "
        "initial=value)",
        "A policy whose actions are tried first, and that values new states (without it: no-op or "
        "random, whichever has the greater return from the state of the decision)");
    solvers::OptionTable<UctOptions> own = {
        particles_option<UctOptions>(),
        number_option<UctOptions, int>(
            {"lanes", "lanes", "N", "Trials side by side (32)"},
            [](auto& o) -> auto& { return o.lanes; }, 1, 1 << 16),
        number_option<UctOptions, int>(
            {"actions", "actions", "N",
             "Up to so many joint actions are all tried; others are drawn (4096)"},
            [](auto& o) -> auto& { return o.actions; }, 2, 1 << 20),
        number_option<UctOptions, double>(
            {"exploration", "exploration", "C",
             "How much actions count that were tried less, in ranges of the returns (0.5; 1.25 "
             "with initial=value)"},
            [](auto& o) -> auto& { return o.exploration; }, 0.0, 1e6),
        number_option<UctOptions, double>(
            {"outcomes", "outcomes", "K",
             "Of an action that was taken n times at most K * sqrt(n) outcomes are distinguished; "
             "0: "
             "all (4)"},
            [](auto& o) -> auto& { return o.outcomes; }, 0.0, 1e9),
        number_option<UctOptions, double>(
            {"width", "width", "K",
             "Where actions are drawn, after n trials of a node K * n^widening are tried (1)"},
            [](auto& o) -> auto& { return o.width; }, 0.01, 1e9),
        number_option<UctOptions, double>(
            {"widening", "widening", "A", "The exponent of width (0.5)"},
            [](auto& o) -> auto& { return o.widening; }, 0.0, 1.0),
        number_option<UctOptions, int>(
            {"lookahead", "lookahead", "N",
             "States that a search in the determinised problem may meet, beginning with that of "
             "the decision: it is as deep as that allows (256)"},
            [](auto& o) -> auto& { return o.lookahead; }, 1, 1 << 20),
        choice_option<UctOptions, bool>(
            {"plans", "plans", "yes|no",
             "Give a part of the budget to plans of plan:cem where the tree finds nothing better "
             "than no-op in three decisions, and prefer no-op to what is worse (yes)"},
            [](auto& o) -> auto& { return o.plans; }, {{"yes", true}, {"no", false}}),
        choice_option<UctOptions, Backup>(
            {"backup", "backup", "HOW",
             "A state is worth its best action by the outcomes that were seen (max, the default), "
             "or the mean of its trials (mean)"},
            [](auto& o) -> auto& { return o.backup; },
            {{"max", Backup::Max}, {"mean", Backup::Mean}}),
        choice_option<UctOptions, Initial>(
            {"initial", "initial", "HOW",
             "A new state is valued by a search in the determinised problem (determinised; the "
             "default without a policy), by each of its actions and the policy after it "
             "(lookahead; the default with a policy without values), by the policy alone "
             "(rollout), "
             "or by the values that PPO has learned (value; the default with such a policy)"},
            [](auto& o) -> auto& { return o.initial; },
            {{"determinised", Initial::Determinised},
             {"lookahead", Initial::Lookahead},
             {"rollout", Initial::Rollout},
             {"value", Initial::Value}}),
    };
    table.insert(table.end(), std::make_move_iterator(own.begin()),
                 std::make_move_iterator(own.end()));
    return table;
}

}  // namespace

const solvers::OptionTable<UctOptions>& uct_option_table() {
    static const solvers::OptionTable<UctOptions> table = make_uct_table();
    return table;
}

}  // namespace rddlc::planners
